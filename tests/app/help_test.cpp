// Help, its examples, and the manual page that is made of it.

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <regex>

#include "program.h"

namespace gnomon {
namespace help_test {

using testing::HasSubstr;
using testing::Not;

class Help : public ProgramTest {
  protected:
    /// All commands that "gnomon --help" lists.
    std::vector<std::string> commands() const {
        const std::string help = run({"--help"}).out;
        std::vector<std::string> names;
        const std::size_t begin = help.find("Subcommands:");
        std::istringstream lines(help.substr(begin, help.find("exit status:") - begin));
        for (std::string line; std::getline(lines, line);)
            if (std::smatch match; std::regex_search(line, match, std::regex("^  ([a-z]+) ")))
                names.push_back(match[1]);
        return names;
    }

    /// The words after "gnomon" of each example in a command's help.
    std::vector<std::vector<std::string>> examples(const std::string& command) const {
        const std::string help = run({command, "--help"}).out;
        std::vector<std::vector<std::string>> all;
        std::istringstream lines(help.substr(help.find("Examples:")));
        for (std::string line; std::getline(lines, line);) {
            if (line.rfind("  gnomon ", 0) != 0) continue;
            std::istringstream words(line.substr(9));
            all.emplace_back();
            for (std::string word; words >> word;) all.back().push_back(word);
        }
        return all;
    }
};

TEST_F(Help, EveryCommandIsInTheReadme) {
    const std::string readme = contentOf(std::filesystem::path(GNOMON_SOURCE) / "README.md");
    ASSERT_GE(commands().size(), 10u);
    for (const std::string& command : commands())
        EXPECT_THAT(readme, HasSubstr("gnomon " + command)) << command;
}

TEST_F(Help, EveryCommandHasExamplesThatWork) {
    // The runs that the examples of report name.
    const std::string json = run({"matrix", "boxes", "--size", "32x24", "--frames", "0", "--profile", "tnt",
                                  "--method", "carmack", "--format", "json"})
                                 .out;
    for (const char* file : {"old.json", "run.json"}) std::ofstream(pathOf(file)) << json;
    // And the shards of merge's.
    for (const char* index : {"1", "2"})
        run({"matrix", "boxes", "--size", "32x24", "--frames", "0", "--profile", "tnt", "--method",
             "carmack,none", "--out", pathOf(fmt::format("shard-{}", index)), "--shard",
             fmt::format("{}/2", index)});
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(std::filesystem::path(pathOf("")));
    for (const std::string& command : commands()) {
        const auto all = examples(command);
        EXPECT_FALSE(all.empty()) << command;
        for (const auto& arguments : all) {
            const Outcome outcome = run(arguments);
            EXPECT_EQ(outcome.status, 0) << command << ": " << outcome.err;
            // What writes a file may have nothing else to say.
            const bool writes = std::find(arguments.begin(), arguments.end(), "-o") != arguments.end();
            EXPECT_TRUE(writes || !outcome.out.empty()) << command;
        }
    }
    std::filesystem::current_path(before);
}

TEST_F(Help, OfACommandIsTheSameByBothWays) {
    EXPECT_EQ(run({"help", "matrix"}).out, run({"matrix", "--help"}).out);
    EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
    expectRefused(run({"help", "nothing"}), "no such command 'nothing'");
    expectRefused(run({"help", "matrix", "--man"}), "--man: the manual is of all commands");
}

/// "-o,--output FILE" of every line of a help that tells of a flag.
std::vector<std::string> flagsOf(const std::string& help) {
    std::vector<std::string> flags;
    const std::regex flag("^  (?:-[a-z],)?(-[-a-z]+)");
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);)
        if (std::smatch match; std::regex_search(line, match, flag)) flags.push_back(match[1]);
    return flags;
}

TEST_F(Help, ManualPageHasEveryCommandFlagAndExample) {
    const std::string page = std::regex_replace(run({"help", "--man"}).out, std::regex("\\\\[-&]"), "-");
    const std::string manual = std::regex_replace(page, std::regex("-(?=--)"), "");
    std::size_t flags = 0;
    for (const std::string& command : commands()) {
        const std::size_t begin = manual.find(fmt::format(".SS gnomon {}\n", command));
        ASSERT_NE(begin, std::string::npos) << command;
        const std::string section = manual.substr(begin, manual.find("\n.S", begin + 1) - begin);
        for (const std::string& flag : flagsOf(run({command, "--help"}).out)) {
            EXPECT_THAT(section, HasSubstr(flag)) << command;
            ++flags;
        }
        EXPECT_THAT(section, HasSubstr(fmt::format("gnomon {}", command)));
    }
    EXPECT_GT(flags, 100u);
}

// Real troff, all of its warnings on.
TEST_F(Help, ManualPageIsCleanTroff) {
    if (std::system("command -v groff >/dev/null") != 0) GTEST_SKIP() << "no groff";
    const std::string page = write("gnomon.1", run({"help", "--man"}).out), shown = pathOf("shown"),
                      warnings = pathOf("warnings");
    const std::string command =
        fmt::format("groff -man -Tascii -P-c -ww '{}' >'{}' 2>'{}'", page, shown, warnings);
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(contentOf(warnings), "");
    EXPECT_THAT(contentOf(shown), HasSubstr("gnomon matrix"));
}

TEST_F(Help, UsageErrorsNameTheWordsInTheirOrder) {
    expectRefused(run({"devices", "one", "two", "three"}),
                  "The following arguments were not expected: one two three");
    expectRefused(run({"devices", "--one"}), "The following argument was not expected: --one");
}

TEST_F(Help, DoubledEffectsAreRefused) {
    expectRefused(run({"plan", "boxes", "--effects", "levels,levels"}),
                  "--effects: 'levels' stands there twice");
}

}  // namespace help_test
}  // namespace gnomon
