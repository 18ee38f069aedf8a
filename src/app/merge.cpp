#include "matrix/merge.h"

#include <fmt/format.h>

#include "app/commands.h"
#include "app/options.h"

namespace gnomon {
namespace {

struct MergeOptions {
    std::vector<std::string> shards{};
    std::string folder{};
};

int run(const MergeOptions& options) {
    const CellStore whole = mergedShards({options.shards.begin(), options.shards.end()}, options.folder);
    std::string verdicts;
    const auto counts = whole.countByVerdict();
    for (int v = 0; v < kVerdicts; ++v)
        if (const auto at = counts.find(name(Verdict(v))); at != counts.end())
            verdicts += fmt::format("{}{} {}", verdicts.empty() ? "" : ", ", at->second, at->first);
    fmt::print("{}: {} cells of {} shard{}: {}; digest {}\n", options.folder, whole.count(),
               options.shards.size(), options.shards.size() == 1 ? "" : "s", verdicts, whole.digest());
    return counts.contains(name(Verdict::Failed)) ? 3 : 0;
}

}  // namespace

void addMerge(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<MergeOptions>();
    CLI::App* command = app.add_subcommand(
        "merge",
        "Puts the shards of a run together as one run: what gnomon matrix --shard I/N --out "
        "DIR has kept,\n"
        "for all I. gnomon report makes a page of it, and gnomon matrix with the same choice "
        "prints it.");
    command->add_option("shards", options->shards, "the folders of all shards, in any order")
        ->required()
        ->type_name("DIR");
    command->add_option("--out", options->folder, "where the whole run goes")->required()->type_name("DIR");
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
