// The program at a pseudo-terminal: what it draws there, and nowhere else.

#include <fmt/ranges.h>

#include <csignal>
#include <regex>

#include "program.h"
#include "pseudo_terminal.h"

namespace gnomon {
namespace terminal_test {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::vector<std::string> kTwoCells{"matrix",       "boxes",    "--profile", "ideal",  "--method",
                                         "none,carmack", "--frames", "0",         "--size", "48x32"};

/// The texts of the bars that were drawn, each without the sequence that clears the line before it.
std::vector<std::string> barsOf(const std::string& text) {
    const std::string clear = "\r\x1b[K";
    std::vector<std::string> bars;
    for (std::size_t at = text.find(clear); at != std::string::npos;) {
        const std::size_t next = text.find(clear, at + 1);
        bars.push_back(
            text.substr(at + clear.size(), next == std::string::npos ? next : next - at - clear.size()));
        at = next;
    }
    return bars;
}

class Terminal : public ProgramTest {};

TEST_F(Terminal, ShowsProgressAndTakesItAway) {
    const TerminalOutcome outcome = runAtTerminal(kTwoCells, {.outputIsTerminal = false});
    EXPECT_EQ(outcome.status, 0);
    const std::vector<std::string> bars = barsOf(outcome.text);
    ASSERT_GE(bars.size(), 2u);
    EXPECT_THAT(bars.front(), StartsWith("[........"));
    EXPECT_THAT(bars.front(), EndsWith("] 0 of 2 cells, 0 failed"));
    EXPECT_EQ(bars.back(), "") << "the line is empty in the end";
    EXPECT_THAT(outcome.text, Not(HasSubstr("\n")));
}

TEST_F(Terminal, TakesProgressAwayWhenItIsInterrupted) {
    // Ctrl-C, as soon as a bar is seen.
    const TerminalOutcome outcome =
        runAtTerminal({"matrix"}, {.outputIsTerminal = false, .question = "0 of", .answer = "\x03"});
    EXPECT_EQ(outcome.status, 128 + SIGINT);
    EXPECT_EQ(barsOf(outcome.text).back(), "");
}

TEST_F(Terminal, ProgressFitsNarrowTerminalsAndThoseThatAreResized) {
    const auto widest = [](const std::string& text) {
        std::size_t most = 0;
        for (const std::string& bar : barsOf(text)) most = std::max(most, bar.size());
        return most;
    };
    for (const unsigned short columns : std::vector<unsigned short>{1, 8, 20, 40}) {
        const auto outcome = runAtTerminal(kTwoCells, {.columns = columns, .outputIsTerminal = false});
        EXPECT_EQ(outcome.status, 0);
        EXPECT_LT(widest(outcome.text), columns);
    }
    const auto outcome =
        runAtTerminal(kTwoCells, {.columns = 120, .outputIsTerminal = false, .laterColumns = 5});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(barsOf(outcome.text).back(), "");
}

TEST_F(Terminal, TablesComeAfterTheProgressWasTakenAway) {
    const TerminalOutcome outcome = runAtTerminal(kTwoCells, {});
    const std::string last = barsOf(outcome.text).back();
    EXPECT_THAT(last, StartsWith("boxes, 48x32, frame 0"));
}

TEST_F(Terminal, ShowsNoProgressOnADumbTerminalOrInAFile) {
    EXPECT_EQ(runAtTerminal(kTwoCells, {.term = "dumb", .outputIsTerminal = false}).text, "");
    EXPECT_EQ(runAtTerminal(kTwoCells, {.term = "", .outputIsTerminal = false}).text, "");
    EXPECT_EQ(run(kTwoCells).err, "");
}

// What takes long says how far it is.
TEST_F(Terminal, OtherCommandsShowProgress) {
    const auto first = [](const std::vector<std::string>& arguments) {
        return barsOf(runAtTerminal(arguments, {.outputIsTerminal = false}).text).at(0);
    };
    EXPECT_THAT(first({"advise", "boxes", "--size", "48x32"}), HasSubstr(" methods"));
    EXPECT_THAT(first({"cost", "boxes", "--size", "48x32", "--repeats", "1", "--method", "carmack"}),
                HasSubstr(" steps"));
    EXPECT_THAT(first({"reproduce", "roettger2002", "--table", "1"}), HasSubstr("0 of 8 rows"));
    EXPECT_THAT(first({"reproduce", "kolivand2011", "--scene", "boxes", "--size", "48x32", "--frames", "2",
                       "--repeats", "1"}),
                HasSubstr("0 of 2 frames"));
    EXPECT_THAT(first({"reproduce", "usta2019", "--scene", "boxes", "--size", "48x32", "--frames", "2",
                       "--repeats", "1"}),
                HasSubstr("0 of 2 frames"));
}

/// The widest line, in characters; escape sequences take none.
std::size_t widestOf(const std::string& text) {
    const std::string plain = std::regex_replace(text, std::regex("\x1b\\[[0-9;]*m|\r"), "");
    std::istringstream lines(plain);
    std::size_t widest = 0;
    for (std::string line; std::getline(lines, line);) {
        const auto isFirst = [](char c) { return (c & 0xc0) != 0x80; };
        widest = std::max(widest, std::size_t(std::count_if(line.begin(), line.end(), isFirst)));
    }
    return widest;
}

const std::vector<std::vector<std::string>> kTexts{
    {"--help"},
    {"matrix", "--help"},
    {"render", "--help"},
    {"plan", "--help"},
    {"advise", "--help"},
    {"cost", "--help"},
    {"prove", "--help"},
    {"reproduce", "--help"},
    {"mesh", "--help"},
    {"help"},
    {"profiles"},
    {"profiles", "voodoo2"},
    {"profiles", "ps2"},
    {"methods"},
    {"methods", "heidmann"},
    {"scenes"},
    {"scenes", "hard/eye-inside-one"},
    {"devices"},
    {"mesh", "knot"},
    {"mesh", "boxes"},
    {"prove", "--profile", "voodoo2,tnt,ps2"},
    {"plan"},
    {"plan", "--explain"},
    {"plan", "boxes", "--profile", "ps2", "--method", "screen-count"},
    {"render"},
    {"render", "boxes", "--profile", "ps1"},
    {"advise"},
    {"advise", "boxes", "--profile", "voodoo2"},
    {"matrix", "boxes", "--frames", "0", "--size", "64x48"},
    {"cost", "boxes", "--size", "64x48", "--repeats", "1"},
    {"reproduce", "roettger2002"},
    {"reproduce", "kolivand2011", "--scene", "boxes", "--size", "64x48", "--frames", "1", "--repeats", "1"},
    {"reproduce", "aldridge", "--scene", "boxes", "--size", "64x48", "--repeats", "1"},
    {"reproduce", "usta2019", "--scene", "boxes", "--size", "64x48", "--frames", "1", "--repeats", "1"}};

TEST_F(Terminal, TextsAreAtMost100ColumnsWideWhereThereIsNone) {
    for (const auto& arguments : kTexts) {
        const Outcome outcome = run(arguments);
        EXPECT_LE(outcome.status, 1) << outcome.err;
        EXPECT_LE(widestOf(outcome.out), 100u) << fmt::format("{}", fmt::join(arguments, " "));
        EXPECT_THAT(outcome.out, Not(HasSubstr("\x1b")));
    }
}

TEST_F(Terminal, TextsAreAsWideAsTheTerminal) {
    const auto widest = [](const std::vector<std::string>& arguments, const TerminalRun& how) {
        return widestOf(runAtTerminal(arguments, how).text);
    };
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"profiles"}, {"methods"}}) {
        EXPECT_LE(widest(arguments, {.columns = 80}), 80u);
        EXPECT_LE(widest(arguments, {.columns = 120}), 120u);
        EXPECT_GT(widest(arguments, {.columns = 120}), 100u);
        EXPECT_LE(widest(arguments, {.columns = 120, .environment = {{"COLUMNS", "90"}}}), 90u);
        EXPECT_GT(widest(arguments, {.columns = 120, .environment = {{"COLUMNS", "much"}}}), 100u)
            << "COLUMNS is no number";
        EXPECT_GT(widest(arguments, {.columns = 500}), 150u);
    }
    EXPECT_LE(widest({"matrix", "--help"}, {.columns = 80}), 80u);
}

TEST_F(Terminal, VerdictsHaveColoursThereUnlessNobodyWantsThem) {
    const std::string green = "\x1b[32mexact\x1b[0m";
    EXPECT_THAT(runAtTerminal(kTwoCells, {}).text, HasSubstr(green));
    EXPECT_THAT(runAtTerminal(kTwoCells, {.environment = {{"NO_COLOR", ""}}}).text, HasSubstr(green));
    EXPECT_THAT(runAtTerminal(kTwoCells, {.environment = {{"NO_COLOR", "1"}}}).text,
                Not(HasSubstr("exact\x1b")));
    EXPECT_THAT(runAtTerminal(kTwoCells, {.term = "dumb"}).text, Not(HasSubstr("\x1b")));
    const auto with = [&](std::vector<std::string> arguments, const char* when) {
        arguments.insert(arguments.end(), {"--colour", when});
        return arguments;
    };
    EXPECT_THAT(runAtTerminal(with(kTwoCells, "never"), {}).text, Not(HasSubstr("exact\x1b")));
    EXPECT_THAT(run(with(kTwoCells, "always")).out, HasSubstr(green));
    EXPECT_THAT(run(with(kTwoCells, "auto")).out, Not(HasSubstr("\x1b")));
    const std::vector<std::string> small{"boxes", "--size", "48x32"};
    for (const char* command : {"render", "advise"}) {
        std::vector<std::string> arguments{command};
        arguments.insert(arguments.end(), small.begin(), small.end());
        EXPECT_THAT(run(with(arguments, "always")).out, HasSubstr(green)) << command;
    }
    expectRefused(run(with(kTwoCells, "red")), "--colour");
    // No sequence is any data.
    std::vector<std::string> json = with(kTwoCells, "always");
    json.insert(json.end(), {"--format", "json"});
    EXPECT_THAT(run(json).out, Not(HasSubstr("\x1b")));
}

const std::vector<std::string> kPicture{"render", "boxes", "--method", "carmack",
                                        "--size", "64x48", "--show"};

std::vector<std::string> pictureBy(const std::string& how) {
    std::vector<std::string> arguments = kPicture;
    arguments.push_back(how);
    return arguments;
}

TEST_F(Terminal, PicturesAreHalfBlocksOrSixelsAsAsked) {
    const std::string blocks = run(pictureBy("blocks")).out;
    EXPECT_THAT(blocks, HasSubstr("\u2580"));
    const std::string picture = blocks.substr(0, blocks.rfind("\x1b[0m\n") + 5);
    EXPECT_EQ(std::count(picture.begin(), picture.end(), '\n'), 24) << "a line for every two rows";
    EXPECT_THAT(run(pictureBy("sixel")).out, StartsWith("\x1bP0;1q\"1;1;64;48"));
    EXPECT_THAT(run(pictureBy("ascii")).out, Not(HasSubstr("\x1b")));
    const std::string letters = run(pictureBy("ascii")).out;
    EXPECT_EQ(run(pictureBy("auto")).out.substr(0, letters.find("ideal/")),
              letters.substr(0, letters.find("ideal/")))
        << "no terminal to ask";
    expectRefused(run(pictureBy("photo")), "--show");
    std::vector<std::string> json = pictureBy("blocks");
    json.insert(json.end(), {"--format", "json"});
    expectRefused(run(json), "--show: goes with --format text only");
}

// The question is "ESC [ c"; the number 4 in the answer says sixel.
TEST_F(Terminal, AsksTheTerminalWhetherItHasSixels) {
    const auto shown = [](const std::string& answer) {
        return runAtTerminal(pictureBy("auto"), {.question = "\x1b[c", .answer = answer}).text;
    };
    EXPECT_THAT(shown("\x1b[?62;4;22c"), HasSubstr("\x1bP0;1q"));
    EXPECT_THAT(shown("\x1b[?62;4c"), HasSubstr("\x1bP0;1q"));
    for (const char* none : {"\x1b[?62;22c", "\x1b[?4;22c", "\x1b[?62;14;44c", "\x1b[?62;4", "", "nonsense"})
        EXPECT_THAT(shown(none), AllOf(HasSubstr("\u2580"), Not(HasSubstr("\x1bP")))) << none;
}

TEST_F(Terminal, PicturesFitTheTerminal) {
    std::vector<std::string> large = pictureBy("blocks");
    large[5] = "320x240";
    EXPECT_EQ(widestOf(runAtTerminal(large, {.columns = 50}).text), 50u);
    large.back() = "ascii";
    EXPECT_LE(widestOf(run(large).out), 100u);
}

TEST_F(Terminal, PlansAreShownWithTheirMaskBeside) {
    const std::string both =
        run({"plan", "boxes", "--method", "carmack", "--size", "64x48", "--show", "sixel"}).out;
    EXPECT_THAT(both, StartsWith("\x1bP0;1q\"1;1;136;48")) << "8 pixels between";
    EXPECT_THAT(both, HasSubstr("carmack (attenuated) on ideal"));
    const std::string refused = run({"plan", "boxes", "--profile", "ps1", "--method", "carmack", "--size",
                                     "64x48", "--show", "sixel"})
                                    .out;
    EXPECT_THAT(refused, StartsWith("carmack (attenuated) on ps1"));
}

}  // namespace terminal_test
}  // namespace gnomon
