#include "report/device_listing.h"

#include <fmt/format.h>

#include "report/listings.h"

namespace gnomon {

std::string listDevices(const std::vector<DriverFacts>& devices, const Page& page) {
    std::vector<std::vector<std::string>> rows{{"device", "default", "clock", "driver"}};
    for (const DriverFacts& d : devices) {
        const bool draws = d.problem.empty();
        rows.push_back({name(d.device), d.device == defaultDevice() ? "yes" : "no",
                        draws ? name(d.clock) : "-", draws ? d.driver : fmt::format("none: {}", d.problem)});
    }
    return listing(rows, page);
}

std::string deviceText(const std::string& device) {
    if (device == name(defaultDevice())) return "";
    const bool isEgl = device == name(Device::Egl);
    return fmt::format(", on {}", title(isEgl ? Device::Egl : Device::Osmesa));
}

}  // namespace gnomon
