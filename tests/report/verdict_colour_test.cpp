// Verdicts in colours, in the tables that have them.

#include "report/verdict_colour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "report/matrix_report.h"

namespace gnomon {
namespace verdict_colour_test {

using testing::HasSubstr;
using testing::Not;

TEST(InColour, HasAColourForEachVerdict) {
    EXPECT_EQ(inColour("exact", Verdict::Exact, true), "\x1b[32mexact\x1b[0m");
    EXPECT_EQ(inColour("edge", Verdict::Edge, true), "\x1b[33medge\x1b[0m");
    EXPECT_EQ(inColour("WRONG", Verdict::Wrong, true), "\x1b[31mWRONG\x1b[0m");
    EXPECT_EQ(inColour("FAILED", Verdict::Failed, true), "\x1b[31mFAILED\x1b[0m");
    EXPECT_EQ(inColour("-", Verdict::Refused, true), "\x1b[2m-\x1b[0m");
}

TEST(InColour, LeavesTextAsItIsWithoutColours) {
    for (const Verdict verdict : {Verdict::Exact, Verdict::Wrong, Verdict::Refused})
        EXPECT_EQ(inColour("text", verdict, false), "text");
}

std::vector<Cell> oneOfEachVerdict() {
    std::vector<Cell> cells;
    for (const Verdict verdict :
         {Verdict::Exact, Verdict::Edge, Verdict::Wrong, Verdict::Refused, Verdict::Failed}) {
        Cell cell;
        cell.profile = "chip", cell.scene = "boxes";
        cell.method = "method-" + name(verdict);
        cell.verdict = verdict;
        if (verdict == Verdict::Failed) cell.error = "crashed";
        if (verdict == Verdict::Refused) cell.missing = {{"stencil_bits", "stencil", "paper"}};
        cells.push_back(cell);
    }
    return cells;
}

// The colours change nothing but themselves: column widths are counted without them.
TEST(MatrixText, IsTheSameInColoursButForTheirSequences) {
    const std::string plain = matrixText(oneOfEachVerdict());
    Page page;
    page.colours = true;
    const std::string coloured = matrixText(oneOfEachVerdict(), page);
    EXPECT_THAT(plain, Not(HasSubstr("\x1b")));
    for (const char* code : {"[32mexact", "[33medge", "[31mWRONG", "[31mFAILED", "[2m-"})
        EXPECT_THAT(coloured, HasSubstr(code));
    EXPECT_EQ(std::regex_replace(coloured, std::regex("\x1b\\[[0-9]*m"), ""), plain);
}

}  // namespace verdict_colour_test
}  // namespace gnomon
