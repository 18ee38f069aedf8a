// Text tables, CSV lines, and wrapped paragraphs.

#include "report/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <sstream>

namespace gnomon {
namespace {

TEST(AlignColumns, LinesUpColumnsUnderAnUnderlinedHead) {
    EXPECT_EQ(alignColumns({{"chip", "bits"}, {"voodoo2", "16"}, {"tnt", "24 16"}}),
              "chip     bits\n"
              "-------  -----\n"
              "voodoo2  16\n"
              "tnt      24 16\n");
}

TEST(AlignColumns, LeavesNoBlanksAtLineEnds) {
    EXPECT_EQ(alignColumns({{"a", "long head"}, {"b", ""}}),
              "a  long head\n"
              "-  ---------\n"
              "b\n");
}

TEST(AlignColumns, MeasuresCharactersNotBytes) {
    EXPECT_EQ(alignColumns({{"name", "n"}, {"R\u00f6tt", "1"}, {"Crow", "2"}}),
              "name  n\n"
              "----  -\n"
              "R\u00f6tt  1\n"
              "Crow  2\n");
}

TEST(AlignColumns, TakesRowsShorterThanTheHead) {
    EXPECT_EQ(alignColumns({{"a", "b"}, {"1"}}), "a  b\n-  -\n1\n");
}

// RFC 4180, section 2: rules 1, 5, 6 and 7.
TEST(CsvLine, EndsInCrLf) {
    EXPECT_EQ(csvLine({"a", "b c", ""}), "a,b c,\r\n");
}
TEST(CsvLine, QuotesFieldsWithCommasQuotesAndLineBreaks) {
    EXPECT_EQ(csvLine({"a,b", "c\nd", "e\rf"}), "\"a,b\",\"c\nd\",\"e\rf\"\r\n");
}
TEST(CsvLine, DoublesQuotes) {
    EXPECT_EQ(csvLine({"say \"no\"", "\""}), "\"say \"\"no\"\"\",\"\"\"\"\r\n");
}
TEST(CsvLine, LeavesOtherFieldsBare) {
    EXPECT_EQ(csvLine({"1/2", "a;b", " x "}), "1/2,a;b, x \r\n");
}

TEST(WrapText, BreaksAtBlanksWithinTheWidth) {
    EXPECT_EQ(wrapText("aaa bbb ccc", 0, 7), "aaa bbb\nccc");
    EXPECT_EQ(wrapText("aaa bbb ccc", 0, 6), "aaa\nbbb\nccc");
}

TEST(WrapText, IndentsFurtherLinesAndCountsTheIndent) {
    EXPECT_EQ(wrapText("aaa bbb ccc", 4, 11), "aaa bbb\n    ccc");
}

TEST(WrapText, KeepsAWordThatIsLongerThanTheWidthWhole) {
    EXPECT_EQ(wrapText("a incomprehensible b", 2, 8), "a\n  incomprehensible\n  b");
}

TEST(WrapText, LosesNoWord) {
    const std::string text =
        "alpha blend factors dst_color one and a long tail of words that no line can hold";
    for (const std::size_t width : {10u, 20u, 40u, 200u}) {
        std::istringstream in(text), out(wrapText(text, 3, width));
        const std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
        const std::vector<std::string> wrapped{std::istream_iterator<std::string>(out), {}};
        EXPECT_EQ(wrapped, words) << width;
    }
}

}  // namespace
}  // namespace gnomon
