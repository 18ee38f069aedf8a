#include <fmt/format.h>

#include <cstdio>

#include "app/commands.h"
#include "app/options.h"
#include "matrix/probe.h"
#include "report/device_listing.h"

namespace gnomon {

void addDevices(CLI::App& app, int& status) {
    const auto format = std::make_shared<FormatOption>();
    CLI::App* command =
        app.add_subcommand("devices", "What can draw here (--device), the drivers, and whose time is taken");
    format->addTo(*command);
    command->callback([format, &status] {
        std::vector<DriverFacts> all;
        for (int i = 0; i < kDevices; ++i) all.push_back(probe(Device(i)));
        fmt::print("{}", listDevices(all, format->value()));
        status = 0;
    });
}

}  // namespace gnomon
