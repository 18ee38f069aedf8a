// `gnomon check` as a user runs it: what it holds the matrix to, and what it says and writes.

#include <fmt/format.h>

#include <cstdlib>

#include "program.h"

namespace gnomon {
namespace check_test {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// A few small cells: exact, wrong, refused.
const std::vector<std::string> kCells{"--scene",      "boxes",  "--profile", "voodoo2,tnt", "--method",
                                      "carmack,none", "--size", "64x48",     "--frames",    "0"};
constexpr const char* kChoice =
    "choice --scene boxes --profile voodoo2,tnt --method carmack,none --size 64x48 --frames 0\n";

class Check : public ProgramTest {
  protected:
    Outcome check(std::vector<std::string> more, const std::vector<std::string>& cells = {}) const {
        std::vector<std::string> arguments{"check", "--expected", pathOf("expected.txt")};
        arguments.insert(arguments.end(), cells.begin(), cells.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    /// The file of kCells, as it is.
    std::string fileOfCells() const {
        const Outcome outcome = check({"--update"}, kCells);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return contentOf(pathOf("expected.txt"));
    }
    void writeExpected(const std::string& content) const { write("expected.txt", content); }
};

/// @p text with the first @p from in it replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " in " << text;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST_F(Check, UpdateWritesAFileThatIsMetFromThenOn) {
    const std::string text = fileOfCells();
    EXPECT_THAT(text, StartsWith(kChoice));
    EXPECT_THAT(text, HasSubstr("boxes voodoo2/carmack 64x48/0 refused: stencil ; "));
    EXPECT_THAT(text, HasSubstr(": no shadow is drawn "));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
    const Outcome outcome = check({"--repeat", "2"});
    EXPECT_EQ(outcome.status, 0) << outcome.out;
    EXPECT_EQ(outcome.out, "4 cells: 4 expected, 0 unexpected, 0 improved, 0 missing, 0 flaky\n");
    EXPECT_EQ(check({"--update"}).status, 0);
    EXPECT_EQ(contentOf(pathOf("expected.txt")), text);
}

TEST_F(Check, FailsOnAnUnexpectedCellAndNamesTheCommandThatDrawsIt) {
    const std::string text = fileOfCells();
    const std::size_t line = text.find("boxes tnt/none"), end = text.find('\n', line) + 1;
    writeExpected(text.substr(0, line) + text.substr(end));
    const Outcome outcome = check({});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.out,
                HasSubstr("4 cells: 3 expected, 1 unexpected, 0 improved, 0 missing, 0 flaky\n"));
    EXPECT_THAT(outcome.out,
                HasSubstr("unexpected: boxes tnt/none 64x48/0\n  expected: exact\n  found:    wrong "));
    const std::size_t command = outcome.out.find("  gnomon matrix boxes ");
    ASSERT_NE(command, std::string::npos) << outcome.out;
    std::istringstream words(outcome.out.substr(command));
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) arguments.push_back(word);
    arguments.erase(arguments.begin());
    arguments.insert(arguments.end(), {"--format", "csv"});
    const Outcome drawn = run(arguments);
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_EQ(std::count(drawn.out.begin(), drawn.out.end(), '\n'), 2) << "a head and one cell";
    EXPECT_THAT(drawn.out, HasSubstr("tnt/none/boxes/64x48/0"));
}

TEST_F(Check, FailsOnAnImprovedCell) {
    writeExpected(fileOfCells() + "boxes tnt/carmack 64x48/0 wrong 1+1: mask clamps 2 ; once\n");
    const Outcome outcome = check({});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.out,
                HasSubstr("improved: boxes tnt/carmack 64x48/0\n  expected: wrong 1+1: mask clamps "
                          "2\n  found:    exact\n  why:      once\n"));
}

TEST_F(Check, FailsOnAMissingCellUnlessTheChoiceLeavesItOut) {
    writeExpected(fileOfCells() + "knot tnt/carmack 64x48/0 edge 1: mask clamps 1 ; gone\n");
    EXPECT_EQ(check({}).status, 1);
    EXPECT_THAT(check({}).out, HasSubstr("missing: knot tnt/carmack 64x48/0\n"));
    const Outcome part = check({"--profile", "tnt"});
    EXPECT_EQ(part.status, 0) << part.out;
    EXPECT_EQ(part.out,
              "2 cells: 2 expected, 0 unexpected, 0 improved, 0 missing, 0 flaky\n"
              "3 lines of the file outside of this choice\n");
}

TEST_F(Check, UpdateKeepsReasonsAndComments) {
    const std::string text = fileOfCells();
    const std::size_t why = text.find(" ; ", text.find("boxes tnt/none")), end = text.find('\n', why);
    const std::string mine =
        fmt::format("# mine\n{} ; my own words{}", text.substr(0, why), text.substr(end));
    writeExpected(mine);
    EXPECT_EQ(check({"--update"}).status, 0);
    EXPECT_EQ(contentOf(pathOf("expected.txt")), mine);
}

TEST_F(Check, RefusesABadFileWithItsLine) {
    const std::string file = pathOf("expected.txt");
    expectRefused(check({}), file + ": no such file (--update writes it)");
    const std::string text = fileOfCells();
    writeExpected(replaced(text, "--scene boxes", "--scene nothing"));
    expectRefused(check({}), "nothing: neither a file nor a scene");
    writeExpected(replaced(text, "--scene", "--secne"));
    expectRefused(check({}), file + ":1: The following argument");
    writeExpected(text + "boxes\n");
    expectRefused(check({}), file + ":5: no 'SCENE CHIP/METHOD WxH/FRAME OUTCOME ; WHY'");
    expectRefused(check({"--update"}), file + ":5: ");
    EXPECT_EQ(contentOf(file), text + "boxes\n");
}

TEST_F(Check, RefusesPlacesWhereItCantWriteBeforeItDraws) {
    writeExpected(kChoice);
    expectRefused(check({"--junit", pathOf("no/file.xml")}), "no folder ");
    expectRefused(check({"--junit", pathOf("file.txt")}), "a JUnit file's name ends in .xml");
    expectRefused(run({"check", "--update", "--expected", pathOf("no/expected.txt")}), "expected.txt: ");
}

TEST_F(Check, RefusesLimitsThatAreNone) {
    writeExpected(kChoice);
    for (const char* flag : {"--timeout", "--memory", "--jobs", "--repeat"})
        for (const char* word : {"0", "-1", "x", "nan"}) expectRefused(check({flag, word}), flag);
}

// A run of no time at all: each cell fails, which nobody expects.
TEST_F(Check, FailsOnCellsThatTakeTooLong) {
    writeExpected(kChoice);
    const Outcome outcome = check({"--timeout", "0.000001"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.out, HasSubstr("found:    failed: timed out after 1e-06 s"));
}

TEST_F(Check, JUnitIsXmlWithACaseForEveryCell) {
    const std::string text = fileOfCells();
    writeExpected(replaced(text, "refused: stencil", "refused: depth"));
    const std::string junit = pathOf("junit.xml");
    EXPECT_EQ(check({"--junit", junit}).status, 1);
    const std::string xml = contentOf(junit);
    EXPECT_THAT(xml, StartsWith("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites "));
    EXPECT_THAT(xml, HasSubstr("tests=\"4\" failures=\"1\""));
    EXPECT_THAT(xml, HasSubstr("<testcase classname=\"boxes.tnt/carmack\" name=\"64x48/0\" time=\"0."));
    EXPECT_THAT(xml, EndsWith("</testsuites>\n"));
    if (std::system("command -v xmllint >/dev/null") == 0) {
        EXPECT_EQ(std::system(fmt::format("xmllint --noout '{}'", junit).c_str()), 0);
    }
}

// A machine that is too slow, or a driver that crashes, is nothing to expect.
TEST_F(Check, UpdateKeepsTheFileWhereCellsHaveFailed) {
    const std::string text = fileOfCells();
    const Outcome outcome = check({"--update", "--timeout", "1e-6"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("expected.txt stays as it is: 4 of its cells have failed"));
    EXPECT_EQ(contentOf(pathOf("expected.txt")), text);
}

}  // namespace check_test
}  // namespace gnomon
