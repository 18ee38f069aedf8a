#include "app/help.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "report/table.h"

namespace gnomon {
namespace {

constexpr std::size_t kTextColumn = 30;  ///< where what a flag does begins
constexpr std::size_t kFewest = 60;      ///< columns below which help is not made narrower

/// CLI11's help, with descriptions broken to the width.
class HelpFormatter : public CLI::Formatter {
  public:
    explicit HelpFormatter(std::size_t columns) : m_columns(std::max(columns, kFewest)) {
        column_width(kTextColumn);
    }

    std::string make_option(const CLI::Option* option, bool isPositional) const override {
        return entry(make_option_name(option, isPositional) + make_option_opts(option),
                     make_option_desc(option));
    }
    std::string make_subcommand(const CLI::App* command) const override {
        return entry(command->get_display_name(true), command->get_description());
    }
    std::string make_description(const CLI::App* app) const override {
        return wrapText(app->get_description(), 0, m_columns) + "\n";
    }

  private:
    std::size_t m_columns = kPageColumns;

    std::string entry(const std::string& name, const std::string& what) const {
        // A name that is too long has a line of its own.
        const bool fits = name.size() + 3 <= kTextColumn;
        return fmt::format("  {:<{}}{}{}\n", name, fits ? kTextColumn - 2 : 0,
                           fits ? "" : fmt::format("\n{:{}}", "", kTextColumn),
                           wrapText(what, kTextColumn, m_columns));
    }
};

const std::map<std::string, std::vector<Example>>& allExamples() {
    static const std::map<std::string, std::vector<Example>> kExamples{
        {"matrix",
         {{"gnomon matrix boxes --frames 0 --profile voodoo2,tnt", "two chips, one frame, all methods"},
          {"gnomon matrix knot --frames 0 --store alpha --silhouette per-triangle",
           "volumes of single triangles, which mend doubling"},
          {"gnomon matrix boxes --frames 0 --profile voodoo2,tnt --report boxes.html", "the same as a page"},
          {"gnomon matrix boxes --frames 0 --profile voodoo2,tnt --out run",
           "kept in a folder; the same command goes on with it when it was broken off"},
          {"gnomon matrix boxes --frames 0 --profile voodoo2,tnt --out half --shard 1/2", "half of it"}}},
        {"merge",
         {{"gnomon merge shard-1 shard-2 --out whole", "both shards of a run as one"},
          {"gnomon report whole -o whole.html", "and as a page"}}},
        {"slurm", {{"gnomon slurm boxes --shards 4 --out run", "the script, to go to a file and to sbatch"}}},
        {"check",
         {{"gnomon check --profile tnt --method carmack", "some cells of tests/expected/matrix.txt"},
          {"gnomon check boxes --frames 0 --profile tnt --expected tnt.txt --update",
           "a file of expectations of one's own"},
          {"gnomon check --expected tnt.txt --repeat 2 --junit tnt.xml",
           "held to it, all cells twice, for a test runner too"}}},
        {"report",
         {{"gnomon report run.json -o run.html",
           "a page of a run, as gnomon matrix --format json has written it"},
          {"gnomon report old.json run.json", "what has changed between two runs"}}},
        {"render",
         {{"gnomon render boxes --profile voodoo2 -o boxes.png --mask mask.png", "the image and its shadows"},
          {"gnomon render boxes --show blocks", "the image in the terminal"},
          {"gnomon render boxes --profile voodoo2 --steps steps", "the buffer after every pass"}}},
        {"plan",
         {{"gnomon plan boxes --profile ps2", "the passes that a PlayStation 2 can draw"},
          {"gnomon plan boxes --method carmack --explain", "only what this frame calls for, and why"}}},
        {"advise", {{"gnomon advise boxes --profile tnt", "what to do on a TNT, with the OpenGL calls"}}},
        {"cost",
         {{"gnomon cost boxes --repeats 1 --method carmack,roettger-alpha,williams -o cost.svg",
           "three methods, error against time as a plot"}}},
        {"prove",
         {{"gnomon prove --profile voodoo2", "every mask value that its own rounding reaches"},
          {"gnomon prove --profile tnt --order fronts-first --levels 2", "where two levels fail"}}},
        {"reproduce", {{"gnomon reproduce roettger2002 --table 1", "a paper's pass counts, counted again"}}},
        {"profiles",
         {{"gnomon profiles", "all chips"}, {"gnomon profiles voodoo2", "all facts of one, with sources"}}},
        {"methods",
         {{"gnomon methods", "all methods and the axes' values"}, {"gnomon methods carmack", "one"}}},
        {"scenes",
         {{"gnomon scenes", "all scenes and hard cases"},
          {"gnomon scenes hard/eye-inside-one", "what must be wrong there, and what exact"}}},
        {"mesh", {{"gnomon mesh knot", "which silhouettes can take it, and what its volumes cost"}}},
        {"devices", {{"gnomon devices", "which OpenGL draws, and its drivers"}}},
        {"help",
         {{"gnomon help matrix", "the same as gnomon matrix --help"},
          {"gnomon help --man", "the manual page; man -l shows it"}}},
    };
    return kExamples;
}

}  // namespace

const std::vector<Example>& examplesOf(const std::string& command) {
    static const std::vector<Example> kNone{};
    const auto found = allExamples().find(command);
    return found == allExamples().end() ? kNone : found->second;
}

std::string exitStatusText() {
    return "exit status: 0 as expected, 1 a result or a published figure differs, or the chip can't, 2 bad "
           "arguments or files, 3 our own fault, 128 + signal when interrupted";
}

void setHelp(CLI::App& app, std::size_t columns) {
    const auto formatter = std::make_shared<HelpFormatter>(columns);
    const std::string status = wrapText(exitStatusText(), 2, std::max(columns, kFewest));
    app.formatter(formatter);
    app.footer(status);
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        std::string examples;
        for (const Example& example : examplesOf(command->get_name()))
            examples += fmt::format("  {}\n      {}\n", example.line, example.what);
        command->formatter(formatter);
        command->footer(fmt::format("Examples:\n{}\n{}", examples, status));
    }
}

}  // namespace gnomon
