#include <fmt/format.h>

#include <cstdio>

#include "app/commands.h"
#include "app/options.h"
#include "matrix/probe.h"
#include "report/device_listing.h"

namespace gnomon {
namespace {

int run(const FormatOption& format) {
    std::vector<DriverFacts> all;
    for (int i = 0; i < kDevices; ++i) all.push_back(probe(Device(i)));
    fmt::print("{}", listDevices(all, format.value()));
    return 0;
}

}  // namespace

void addDevices(CLI::App& app, Task& chosen) {
    const auto format = std::make_shared<FormatOption>();
    CLI::App* command =
        app.add_subcommand("devices", "What can draw here (--device), the drivers, and whose time is taken");
    format->addTo(*command);
    command->callback([format, &chosen] { chosen = [format] { return run(*format); }; });
}

}  // namespace gnomon
