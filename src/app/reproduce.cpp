#include "report/reproduce.h"

#include <fmt/format.h>

#include <cstdio>

#include "app/commands.h"
#include "app/options.h"
#include "matrix/lab.h"

namespace gnomon {
namespace {

struct Options {
    std::string paper{};
    int table = 1;
    FormatOption format{};
    DeviceOption device{};
};

int run(const Options& options) {
    if (options.table != 1)
        throw UsageError(fmt::format("--table: of {} only table 1 is reproduced", options.paper));
    ProfileOption profiles;
    const Profile ideal = profiles.load({"ideal"}).front();
    SceneOption scenes;
    Lab lab(scenes.load({"roettger"}).front());
    lab.drawOn(options.device.value());
    const Size size{};
    std::vector<Comparison> rows = roettgerTable1();
    bool allAgree = true;
    for (Comparison& row : rows) {
        row.planned = countPasses(lab.plan(ideal, row.axes, size.width, size.height, 0));
        const Cell cell = lab.run(ideal, row.axes, size.width, size.height, 0);
        if (cell.verdict == Verdict::Failed) throw std::runtime_error(cell.id() + ": " + cell.error);
        row.counted = cell.passes;
        allAgree = allAgree && row.agrees();
    }
    fmt::print("{}", showComparisons(rows, options.format.value()));
    return allAgree ? 0 : 1;
}

}  // namespace

void addReproduce(CLI::App& app, int& status) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "reproduce", "Published figures beside measured ones; exit status 1 if one differs");
    command->add_option("paper", options->paper, "roettger2002")
        ->required()
        ->check(CLI::IsMember({"roettger2002"}));
    command->add_option("--table", options->table, "number of the table in the paper")->capture_default_str();
    options->device.addTo(*command);
    options->format.addTo(*command);
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gnomon
