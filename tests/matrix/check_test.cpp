// Expectations: the file's lines, and which class a cell is of when it is held to them.

#include "matrix/check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "matrix/cause_reason.h"

namespace gnomon {
namespace check_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Cell exactCell(int frame = 0) {
    Cell cell;
    cell.profile = "tnt", cell.method = "heidmann", cell.scene = "boxes";
    cell.width = 320, cell.height = 240, cell.frame = frame;
    cell.verdict = Verdict::Exact, cell.digest = "0123456789abcdef";
    return cell;
}

Cell wrongCell(int edge, int interior, int frame = 0) {
    Cell cell = exactCell(frame);
    cell.verdict = interior ? Verdict::Wrong : Verdict::Edge;
    cell.wrongEdge = edge, cell.wrongInterior = interior;
    cell.causes = {{"mask clamps", edge + interior}};
    return cell;
}

Cell refusedCell() {
    Cell cell = exactCell();
    cell.verdict = Verdict::Refused;
    cell.missing = {{"stencil_bits", "stencil", "a data sheet; page 4"}};
    return cell;
}

Cell failedCell() {
    Cell cell = exactCell();
    cell.verdict = Verdict::Failed, cell.error = "crashed: signal 11";
    return cell;
}

/// Expectations that @p cell meets.
Expectations knownTo(const Cell& cell) {
    return updated({}, "", {cell});
}

CheckedCell checkedOnly(const Expectations& expectations, const std::vector<std::vector<Cell>>& runs) {
    const CheckResult result = checkCells(expectations, runs, true);
    EXPECT_EQ(result.cells.size(), 1u);
    EXPECT_EQ(result.isGood(), result.cells.front().what == CheckClass::Expected);
    return result.cells.front();
}

CheckClass classOf(const Cell& expected, const Cell& found) {
    return checkedOnly(knownTo(expected), {{found}}).what;
}

TEST(CheckCells, TellsBetterFromWorse) {
    const std::vector<Cell> fromBest{exactCell(),     wrongCell(2, 0), wrongCell(3, 0),
                                     wrongCell(1, 3), wrongCell(1, 4), failedCell()};
    for (std::size_t e = 0; e < fromBest.size(); ++e)
        for (std::size_t f = 0; f < fromBest.size(); ++f)
            EXPECT_EQ(classOf(fromBest[e], fromBest[f]), f == e  ? CheckClass::Expected
                                                         : f < e ? CheckClass::Improved
                                                                 : CheckClass::Unexpected)
                << outcomeOf(fromBest[f]) << " where there was " << outcomeOf(fromBest[e]);
}

TEST(CheckCells, FindsRefusalsThatCameAndWent) {
    EXPECT_EQ(classOf(refusedCell(), refusedCell()), CheckClass::Expected);
    EXPECT_EQ(classOf(exactCell(), refusedCell()), CheckClass::Unexpected);
    EXPECT_EQ(classOf(wrongCell(1, 1), refusedCell()), CheckClass::Unexpected);
    EXPECT_EQ(classOf(refusedCell(), exactCell()), CheckClass::Improved);
    EXPECT_EQ(classOf(refusedCell(), wrongCell(0, 1)), CheckClass::Unexpected);
    Cell other = refusedCell();
    other.missing[0].what = "depth";
    EXPECT_EQ(classOf(refusedCell(), other), CheckClass::Unexpected);
}

TEST(CheckCells, FindsOtherCausesOfAsManyPixels) {
    Cell other = wrongCell(1, 3);
    other.causes = {{"mask wraps", 4}};
    EXPECT_EQ(classOf(wrongCell(1, 3), other), CheckClass::Unexpected);
}

// Pixels that are not as predicted are a fault, whatever else the cell shows.
TEST(CheckCells, CallsNothingImprovedThatIsNotPredicted) {
    Cell odd = exactCell();
    odd.unpredicted = 1;
    EXPECT_EQ(outcomeOf(odd), "exact unpredicted 1");
    EXPECT_EQ(classOf(exactCell(), odd), CheckClass::Unexpected);
    EXPECT_EQ(classOf(wrongCell(1, 3), odd), CheckClass::Unexpected);
}

TEST(CheckCells, FindsWhatDiffersBetweenRepetitions) {
    EXPECT_EQ(checkedOnly({}, {{exactCell()}, {exactCell()}}).what, CheckClass::Expected);
    const CheckedCell flaky = checkedOnly({}, {{exactCell()}, {wrongCell(0, 2)}, {exactCell()}});
    EXPECT_EQ(flaky.what, CheckClass::Flaky);
    EXPECT_EQ(flaky.found, "exact / wrong 0+2: mask clamps 2");
    Cell image = exactCell();
    image.digest = "fedcba9876543210";
    EXPECT_EQ(checkedOnly({}, {{exactCell()}, {image}}).found,
              "exact of digest 0123456789abcdef / exact of digest fedcba9876543210");
}

TEST(CheckCells, TakesTimesForNoDifference) {
    Cell slow = exactCell();
    slow.cpuMs = 7, slow.unshadowedMs = 3;
    EXPECT_EQ(checkedOnly({}, {{exactCell()}, {slow}}).what, CheckClass::Expected);
}

TEST(CheckCells, MissesLinesOfTheWholeChoiceOnly) {
    const Expectations two = updated({}, "", {wrongCell(1, 1, 0), wrongCell(1, 1, 5)});
    const CheckResult whole = checkCells(two, {{wrongCell(1, 1, 0)}}, true);
    EXPECT_EQ(whole.count(CheckClass::Missing), 1u);
    EXPECT_EQ(whole.cells.back().place, "boxes tnt/heidmann 320x240/5");
    EXPECT_FALSE(whole.isGood());
    const CheckResult part = checkCells(two, {{wrongCell(1, 1, 0)}}, false);
    EXPECT_TRUE(part.isGood());
    EXPECT_EQ(part.outside, 1u);
}

TEST(PlaceOf, HasThreeWordsWhateverIsAskedFor) {
    EXPECT_EQ(placeOf(exactCell(3)), "boxes tnt/heidmann 320x240/3");
    Cell cell = exactCell();
    cell.axes.shade = Shade::Ambient, cell.fidelity = "chip", cell.dithers = true;
    cell.scene = "my scene#1.ply", cell.view = {{"eye", "1,2,3"}};
    EXPECT_EQ(placeOf(cell), "my%20scene%231.ply tnt/heidmann 320x240/0/ambient/chip/dither/eye/1,2,3");
}

/// A file with this content, removed afterwards.
class ExpectationFile : public testing::Test {
  protected:
    ~ExpectationFile() override { std::filesystem::remove(m_file); }
    Expectations read(const std::string& content) const {
        std::ofstream(m_file) << content;
        return readExpectations(m_file);
    }
    std::string faultOf(const std::string& content) const {
        try {
            read(content);
        } catch (const ExpectationError& error) {
            const std::string what = error.what(), name = m_file.string();
            EXPECT_EQ(what.substr(0, name.size()), name);
            return what.substr(name.size());
        }
        return "";
    }
    std::filesystem::path m_file =
        std::filesystem::temp_directory_path() / fmt::format("gnomon-expected-{}.txt", getpid());
};

TEST_F(ExpectationFile, ComesBackAsItWasWritten) {
    const Expectations head = read("# about\n\nchoice --scene boxes --frames 0,5\n");
    EXPECT_THAT(head.comments, ElementsAre("# about", ""));
    EXPECT_EQ(head.choice, "--scene boxes --frames 0,5");
    EXPECT_EQ(head.choiceLine, 3);
    const std::string text = toText(
        updated(head, head.choice, {wrongCell(2, 7), exactCell(1), wrongCell(2, 0, 2), refusedCell()}));
    EXPECT_EQ(toText(read(text)), text);
}

TEST_F(ExpectationFile, HasALineForWhatIsNotExactWithItsReason) {
    Cell failed = failedCell();
    failed.frame = 1;
    Cell refused = refusedCell();
    refused.frame = 2;
    EXPECT_EQ(
        toText(updated({}, "--frames 0-3", {wrongCell(2, 7), failed, refused, exactCell(3)})),
        "choice --frames 0-3\n"
        "boxes tnt/heidmann 320x240/0 wrong 2+7: mask clamps 9 ; more volumes nest than the mask's largest "
        "value tells apart\n"
        "boxes tnt/heidmann 320x240/1 failed: crashed: signal 11 ; nobody has looked at it yet\n"
        "boxes tnt/heidmann 320x240/2 refused: stencil ; a data sheet, page 4\n");
}

TEST_F(ExpectationFile, KeepsAReasonAsLongAsTheCauseStays) {
    const std::string line = "boxes tnt/heidmann 320x240/0 wrong 2+7: mask clamps 9 ; my own words\n";
    const Expectations before = read(line);
    const auto whyOf = [&](const Cell& cell) {
        return updated(before, "", {cell}).cells.begin()->second.why;
    };
    EXPECT_EQ(whyOf(wrongCell(3, 9)), "my own words");
    Cell other = wrongCell(2, 7);
    other.causes = {{"mask wraps", 9}};
    EXPECT_EQ(whyOf(other), reasonOf(Cause::MaskWraps));
}

TEST_F(ExpectationFile, NamesTheLineOfEachFault) {
    EXPECT_EQ(faultOf("choice\nboxes\n"), ":2: no 'SCENE CHIP/METHOD WxH/FRAME OUTCOME ; WHY'");
    EXPECT_EQ(faultOf("boxes tnt 3x4/0 exact ; why\n"), ":1: no 'SCENE CHIP/METHOD WxH/FRAME OUTCOME ; WHY'");
    EXPECT_EQ(faultOf("# c\n\nboxes tnt/none 3x4/0 bad 7 ; why\n"),
              ":3: no outcome 'bad 7' (exact, edge, wrong, refused, failed)");
    EXPECT_EQ(faultOf("boxes tnt/none 3x4/0 edge 7: x 7\n"), ":1: no reason: the line ends in '; WHY'");
    EXPECT_EQ(faultOf("boxes tnt/none 3x4/0 edge 7 ;  \n"), ":1: no reason: the line ends in '; WHY'");
    EXPECT_EQ(faultOf("a b/c 3x4/0 edge 7 ; w\n#\na b/c 3x4/0 edge 8 ; w\n"),
              ":3: a b/c 3x4/0 a second time, first in line 1");
    EXPECT_EQ(faultOf("choice a\nchoice b\n"), ":2: the choice stands once, before all cells");
}

TEST_F(ExpectationFile, ThatIsNotThereIsNamed) {
    EXPECT_THAT([] { readExpectations("/nowhere/x.txt"); },
                ThrowsMessage<ExpectationError>("/nowhere/x.txt: no such file (--update writes it)"));
    EXPECT_THAT([] { readExpectations("/"); }, ThrowsMessage<ExpectationError>("/: can't be read"));
}

TEST(ReasonOf, IsThereForEveryCause) {
    for (int i = 0; i < kCauses; ++i) {
        const bool isCause = Cause(i) != Cause::None && Cause(i) != Cause::Unexplained;
        EXPECT_EQ(!reasonOf(Cause(i)).empty(), isCause) << name(Cause(i));
    }
    EXPECT_THAT(reasonOf(Cause::MaskResolution), HasSubstr("fewer pixels"));
    EXPECT_THAT(reasonOf(Cause::DitherDrift), HasSubstr("dither"));
    EXPECT_THAT(reasonOf(Cause::NearPlaneCuts), HasSubstr("near plane"));
}

}  // namespace check_test
}  // namespace gnomon
