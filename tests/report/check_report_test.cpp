// The result of a check, for people and for test runners.

#include "report/check_report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <vector>

namespace gnomon {
namespace check_report_test {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

CheckedCell checkedCell(CheckClass what, const std::string& scene = "boxes") {
    CheckedCell cell{.what = what,
                     .place = fmt::format("{} tnt/none 320x240/0", scene),
                     .expected = "exact",
                     .found = "edge 2: mask clamps 2"};
    cell.cell.profile = "tnt", cell.cell.cpuMs = 1.5, cell.cell.unshadowedMs = 0.5;
    return cell;
}

std::string commandOf(const Cell& cell) {
    return fmt::format("gnomon matrix --profile {} <a & b>", cell.profile);
}

/// The elements that are opened in @p text; each must be closed in its turn.
std::vector<std::string> elementsOf(const std::string& text) {
    std::vector<std::string> all, open;
    const std::regex tag("<([/?]?)([a-z]+)((?: [a-z]+=\"[^\"<]*\")*)([/?]?)>");
    std::string rest = text;
    for (std::smatch match; std::regex_search(rest, match, tag); rest = match.suffix()) {
        EXPECT_THAT(match.prefix().str(), Not(HasSubstr("<")));
        EXPECT_THAT(match.prefix().str(), Not(HasSubstr(">")));
        if (match[1] == "?") continue;
        if (match[1] == "/") {
            EXPECT_FALSE(open.empty());
            if (open.empty()) return all;
            EXPECT_EQ(open.back(), match[2]);
            open.pop_back();
            continue;
        }
        all.push_back(match[2]);
        if (match[4] != "/") open.push_back(match[2]);
    }
    EXPECT_THAT(open, IsEmpty());
    EXPECT_EQ(rest, "\n");
    return all;
}

TEST(CheckText, CountsAllClassesAndNamesWhatIsNotAsExpected) {
    CheckResult result{.cells = {checkedCell(CheckClass::Expected), checkedCell(CheckClass::Unexpected)},
                       .outside = 3};
    result.cells[1].why = "my reason";
    EXPECT_EQ(showCheck(result, Format::Text, commandOf),
              "2 cells: 1 expected, 1 unexpected, 0 improved, 0 missing, 0 flaky\n"
              "3 lines of the file outside of this choice\n"
              "\n"
              "unexpected: boxes tnt/none 320x240/0\n"
              "  expected: exact\n"
              "  found:    edge 2: mask clamps 2\n"
              "  why:      my reason\n"
              "  gnomon matrix --profile tnt <a & b>\n");
}

// A cell that is not there can't be drawn.
TEST(CheckText, HasNoCommandForWhatIsMissing) {
    const CheckResult result{.cells = {checkedCell(CheckClass::Missing)}};
    EXPECT_THAT(showCheck(result, Format::Text, commandOf), EndsWith("  found:    edge 2: mask clamps 2\n"));
}

TEST(CheckText, StaysShort) {
    const CheckResult result{.cells = std::vector<CheckedCell>(50, checkedCell(CheckClass::Flaky))};
    EXPECT_THAT(showCheck(result, Format::Text, commandOf),
                EndsWith("\nand 30 more (--format json has all)\n"));
}

TEST(CheckRows, HaveEveryCell) {
    const CheckResult result{.cells = {checkedCell(CheckClass::Expected), checkedCell(CheckClass::Missing)}};
    const auto json = nlohmann::ordered_json::parse(showCheck(result, Format::Json, commandOf));
    ASSERT_EQ(json.size(), 2u);
    EXPECT_EQ(json[0].at("class"), "expected");
    EXPECT_EQ(json[0].at("place"), "boxes tnt/none 320x240/0");
    EXPECT_EQ(json[0].at("found"), "edge 2: mask clamps 2");
    EXPECT_EQ(json[0].at("command"), "gnomon matrix --profile tnt <a & b>");
    EXPECT_EQ(json[1].at("class"), "missing");
    EXPECT_EQ(json[1].at("command"), "");
    const std::string csv = showCheck(result, Format::Csv, commandOf);
    EXPECT_THAT(csv, testing::StartsWith("class,place,cell,expected,found,why,command\r\n"));
    EXPECT_THAT(csv, HasSubstr("\r\nmissing,boxes tnt/none 320x240/0,,exact,edge 2: mask clamps 2,,\r\n"));
}

TEST(CheckJUnit, HasASuiteForEachSceneAndACaseForEachCell) {
    const CheckResult result{
        .cells = {checkedCell(CheckClass::Expected), checkedCell(CheckClass::Improved, "knot"),
                  checkedCell(CheckClass::Expected, "knot"), checkedCell(CheckClass::Missing)}};
    const std::string xml = checkJUnit(result, "a<b>&\"c\".txt", commandOf);
    EXPECT_THAT(elementsOf(xml), ElementsAre("testsuites", "testsuite", "testcase", "testcase", "failure",
                                             "testsuite", "testcase", "failure", "testcase"));
    EXPECT_THAT(
        xml, HasSubstr("<testsuites name=\"a&lt;b&gt;&amp;&quot;c&quot;.txt\" tests=\"4\" failures=\"2\""));
    EXPECT_THAT(xml, HasSubstr("<testsuite name=\"boxes\" tests=\"2\" failures=\"1\""));
    EXPECT_THAT(xml,
                HasSubstr("<testcase classname=\"boxes.tnt/none\" name=\"320x240/0\" time=\"0.002000\"/>"));
    EXPECT_THAT(xml, HasSubstr("<failure type=\"improved\" message=\"improved: expected exact, found edge 2: "
                               "mask clamps 2\">"));
    EXPECT_THAT(xml, HasSubstr("gnomon matrix --profile tnt &lt;a &amp; b&gt;"));
}

// What a crash says may hold anything; XML has no such characters.
TEST(CheckJUnit, HasNoControlCharacters) {
    CheckResult result{.cells = {checkedCell(CheckClass::Unexpected)}};
    result.cells[0].found = "failed: \x01\x1b[0m";
    const std::string xml = checkJUnit(result, "file", commandOf);
    EXPECT_THAT(xml, HasSubstr("failed: ??[0m"));
    elementsOf(xml);
}

}  // namespace check_report_test
}  // namespace gnomon
