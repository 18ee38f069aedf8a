#include "matrix/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/commands.h"
#include "app/matrix_options.h"
#include "app/output_file.h"
#include "app/run_command.h"
#include "app/terminal.h"
#include "image/whole_file.h"
#include "report/check_report.h"

namespace gnomon {
namespace {

constexpr int kDiffers = 1;

struct CheckOptions {
    MatrixOptions choice{};
    std::vector<CLI::Option*> choiceFlags{};
    WorkerOptions workers{};
    FormatOption format{};
    std::string file{}, junit{};
    int repeat = 1;
    bool update = false;
};

std::string usualFile() {
    return (dataFolder("tests") / "expected/matrix.txt").string();
}

/// What the file says; nothing of a file that --update is to make.
Expectations expectationsOf(const CheckOptions& options) {
    const std::string file = options.file.empty() ? usualFile() : options.file;
    std::error_code none;
    if (options.update && !std::filesystem::exists(file, none)) return {.file = file};
    return readExpectations(file);
}

/// The choice that the file is about.
ChoiceWords choiceIn(const Expectations& expectations) {
    try {
        return choiceFrom(expectations.choice);
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("{}:{}: {}", expectations.file, expectations.choiceLine, error.what()));
    }
}

std::vector<std::vector<Cell>> runsOf(const MatrixRequest& request, int repeat) {
    TerminalProgress bar("cells");
    std::vector<std::vector<Cell>> runs;
    Progress before;
    for (int i = 0; i < repeat; ++i) {
        Progress last;
        runs.push_back(runMatrix(request, [&](const Progress& at) {
            last = at;
            bar.show({before.done + at.done, at.all * std::size_t(repeat), before.failures + at.failures});
        }));
        before.done += last.done, before.failures += last.failures;
    }
    return runs;
}

int run(const CheckOptions& options) {
    checkOutputFile(options.junit, {".xml"}, "a JUnit file's name ends in .xml");
    const Expectations expectations = expectationsOf(options);
    const ChoiceWords whole = choiceIn(expectations);
    const ChoiceWords choice = withWords(whole, choiceOf(options.choiceFlags));
    if (options.update) writeChosen([&] { tryWhole(expectations.file); });
    MatrixRequest request = optionsOf(choice).load();
    options.workers.applyTo(request);
    const std::vector<std::vector<Cell>> runs = runsOf(request, options.repeat);

    const CheckResult result = checkCells(expectations, runs, choice == whole);
    const RunSources sources = sourcesOf(request);
    const auto command = [&](const Cell& cell) { return commandOf({cell}, sources); };
    if (!options.junit.empty())
        writeChosen([&] { writeWhole(options.junit, checkJUnit(result, expectations.file, command)); });
    const Format format = options.format.value().format;
    fmt::print("{}", showCheck(result, format, command));
    if (!options.update) return result.isGood() ? 0 : kDiffers;
    if (result.count(CheckClass::Flaky) > 0) {
        fmt::print(stderr, "{} stays as it is: a flaky cell has no outcome to expect\n", expectations.file);
        return kDiffers;
    }
    const auto failed = std::count_if(runs.front().begin(), runs.front().end(),
                                      [](const Cell& cell) { return cell.verdict == Verdict::Failed; });
    if (failed > 0) {
        fmt::print(stderr, "{} stays as it is: {} of its cells have failed\n", expectations.file, failed);
        return kDiffers;
    }
    const Expectations after = updated(expectations, toText(choice), runs.front());
    writeChosen([&] { writeWhole(expectations.file, toText(after)); });
    fmt::print(format == Format::Text ? stdout : stderr, "{} has {} lines now\n", expectations.file,
               after.cells.size());
    return 0;
}

}  // namespace

void addCheck(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<CheckOptions>();
    CLI::App* command = app.add_subcommand(
        "check",
        "Holds the matrix to a file of what is known: a cell that stands there must come out as its line\n"
        "says, all others exact. Exit status 1 if a cell is unexpected, improved, missing or flaky.\n"
        "The file says which cells it is about; a choice here takes some of them.");
    const std::size_t before = command->get_options().size();
    options->choice.addTo(*command);
    const auto flags = command->get_options();
    options->choiceFlags.assign(flags.begin() + std::ptrdiff_t(before), flags.end());
    command
        ->add_option(
            "--expected", options->file,
            "what is known, a line for each cell that is not exact (default: tests/expected/matrix.txt)")
        ->type_name("FILE");
    command->add_flag("--update", options->update,
                      "write the file anew, of these cells; reasons stay where the causes do");
    command->add_option("--repeat", options->repeat, "draw all cells so often, and look for differences")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    command->add_option("--junit", options->junit, "write the result as JUnit's XML")->type_name("FILE.xml");
    options->format.addTo(*command);
    options->workers.addTo(*command);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
