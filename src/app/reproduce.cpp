// Only which paper and which table: each paper has a file of its own.

#include "app/reproduce.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/commands.h"
#include "app/options.h"

namespace gnomon {
namespace {

const std::vector<ReproducedPaper>& papers() {
    static const std::vector<ReproducedPaper> kPapers{
        {"roettger2002", {1, 2}, reproduceRoettger2002},
    };
    return kPapers;
}

struct Options {
    std::string paper{};
    std::optional<int> table{};
    FormatOption format{};
    bool measures = false;
};

int run(const Options& options) {
    const auto paper = std::find_if(papers().begin(), papers().end(),
                                    [&](const ReproducedPaper& p) { return p.id == options.paper; });
    const auto& tables = paper->tables;
    if (options.table && std::find(tables.begin(), tables.end(), *options.table) == tables.end())
        throw UsageError(tables.empty() ? fmt::format("--table: {} is reproduced as a whole", paper->id)
                                        : fmt::format("--table: of {} only table {} is reproduced", paper->id,
                                                      fmt::join(tables, " and ")));
    return paper->run(
        {.table = options.table, .format = options.format.value(), .measures = options.measures});
}

}  // namespace

void addReproduce(CLI::App& app, int& status) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "reproduce", "Published figures beside measured ones; exit status 1 if one that must agree differs");
    std::vector<std::string> ids;
    for (const ReproducedPaper& paper : papers()) ids.push_back(paper.id);
    command->add_option("paper", options->paper, fmt::format("{}", fmt::join(ids, ", ")))
        ->required()
        ->check(CLI::IsMember(ids));
    command->add_option("--table", options->table, "number of the table in the paper (default: all)");
    command->add_flag("--measure", options->measures,
                      "roettger2002's table 2: also time its frames on this machine");
    options->format.addTo(*command);
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gnomon
