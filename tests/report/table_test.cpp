// Text tables, CSV lines, and wrapped paragraphs.

#include "report/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <sstream>

namespace gnomon {
namespace table_test {

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

/// The widest line of @p text.
std::size_t widestOf(const std::string& text) {
    std::istringstream lines(text);
    std::size_t widest = 0;
    for (std::string line; std::getline(lines, line);) widest = std::max(widest, textWidth(line));
    return widest;
}

TEST(AlignColumns, BreaksLongEntriesAtBlanksWhereTheTableIsTooWide) {
    EXPECT_EQ(
        alignColumns({{"chip", "what it is"}, {"tnt", "a chip of two pixel pipelines"}, {"rage", "ATI"}}, 28),
        "chip  what it is\n"
        "----  ----------------------\n"
        "tnt   a chip of two pixel\n"
        "      pipelines\n"
        "rage  ATI\n");
}

TEST(AlignColumns, MakesTheWidestColumnNarrowerFirst) {
    const std::string table =
        alignColumns({{"a", "b"}, {"one two three four five", "one two three four five six seven"}}, 50);
    EXPECT_THAT(table, testing::HasSubstr("\none two three four five  one two three four five\n"));
}

// "-22 %" in two lines would be no figure.
TEST(AlignColumns, NeverBreaksShortEntries) {
    EXPECT_THAT(
        alignColumns({{"key", "first", "second"}, {"one", "1.5 (-22 %)", "2.5 (+22 %)"}}, 20),
        testing::AllOf(testing::HasSubstr("one  1.5 (-22 %)\n"), testing::HasSubstr("one  2.5 (+22 %)\n")));
}

TEST(AlignColumns, RepeatsAllKeysInEachBlock) {
    EXPECT_EQ(
        alignColumns({{"a", "b", "first", "second"}, {"1", "1", "x", "y"}, {"1", "2", "z", "w"}}, 12, 2),
        "a  b  first\n-  -  -----\n1  1  x\n1  2  z\n\n"
        "a  b  second\n-  -  ------\n1  1  y\n1  2  w\n");
}

TEST(AlignColumns, GoesOnInBlocksWhereNoEntryCanBeBroken) {
    EXPECT_EQ(
        alignColumns({{"chip", "first", "second", "third"}, {"tnt", "1", "2", "3"}, {"rage", "4", "5", "6"}},
                     19),
        "chip  first  second\n"
        "----  -----  ------\n"
        "tnt   1      2\n"
        "rage  4      5\n"
        "\n"
        "chip  third\n"
        "----  -----\n"
        "tnt   3\n"
        "rage  6\n");
}

TEST(AlignColumns, NumbersRowsOfBlocksWhereTheirFirstEntriesAreTheSame) {
    EXPECT_EQ(alignColumns({{"chip", "first", "second"}, {"tnt", "1", "2"}, {"tnt", "3", "4"}}, 16),
              "row  chip  first\n"
              "---  ----  -----\n"
              "1    tnt   1\n"
              "2    tnt   3\n"
              "\n"
              "row  second\n"
              "---  ------\n"
              "1    2\n"
              "2    4\n");
}

// Whatever the width, all words are there, and no line is longer than it or than one word with its key.
TEST(AlignColumns, FitsEveryWidthThatItsWordsAllow) {
    const std::vector<std::vector<std::string>> rows{
        {"key", "words", "number", "more words"},
        {"one", "these are a few words", "123456", "and some more here"},
        {"two", "short", "7", "a b c d e f g h i j k l m n o p"}};
    for (std::size_t width = 1; width < 80; ++width) {
        const std::string table = alignColumns(rows, width);
        EXPECT_LE(widestOf(table), std::max<std::size_t>(width, 28)) << width;
        for (const auto& row : rows)
            for (const std::string& entry : row) {
                std::istringstream words(entry);
                for (std::string word; words >> word;) EXPECT_THAT(table, testing::HasSubstr(word)) << width;
            }
    }
    EXPECT_EQ(alignColumns(rows, 200), alignColumns(rows, std::string::npos));
}

TEST(AlignColumns, CountsNoEscapeSequences) {
    EXPECT_EQ(textWidth("\x1b[32mexact\x1b[0m 2"), 7u);
    EXPECT_EQ(alignColumns({{"a", "b"}, {"\x1b[1mx\x1b[0m", "1"}}), "a  b\n-  -\n\x1b[1mx\x1b[0m  1\n");
    EXPECT_EQ(wrapText("\x1b[32mexact\x1b[0m two", 0, 9), "\x1b[32mexact\x1b[0m two");
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

}  // namespace table_test
}  // namespace gnomon
