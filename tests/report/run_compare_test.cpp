// What has changed from one run to another.

#include "report/run_compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace gnomon {
namespace run_compare_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Cell cellOf(const std::string& profile, int frame = 0) {
    Cell c;
    c.profile = profile, c.method = "roettger-screen", c.scene = "boxes";
    c.width = 320, c.height = 240, c.frame = frame;
    c.verdict = Verdict::Edge;
    c.wrongEdge = 5;
    c.causes = {{"mask clamps", 5}};
    c.passes = {2, 4, 3, 0};
    c.digest = "1";
    return c;
}

std::vector<std::string> causesOf(const std::vector<ChangeGroup>& groups) {
    std::vector<std::string> causes;
    for (const ChangeGroup& group : groups) causes.push_back(group.cause);
    return causes;
}

template <class Change>
std::vector<std::string> causesAfter(const Change& change) {
    Cell after = cellOf("tnt");
    change(after);
    return causesOf(changesBetween({cellOf("tnt")}, {after}));
}

TEST(RunCompare, FindsNothingInTheSameRunNorInTimes) {
    EXPECT_THAT(causesAfter([](Cell&) {}), IsEmpty());
    EXPECT_THAT(causesAfter([](Cell& c) { c.cpuMs = 9, c.unshadowedMs = 3; }), IsEmpty());
    EXPECT_THAT(causesAfter([](Cell& c) { c.device = "egl", c.clock = "gpu"; }), IsEmpty());
}

TEST(RunCompare, NamesTheGravestChangeOfACell) {
    EXPECT_THAT(causesAfter([](Cell& c) { c.verdict = Verdict::Exact, c.wrongEdge = 0, c.causes = {}; }),
                ElementsAre("verdict: edge -> exact (mask clamps)"));
    EXPECT_THAT(causesAfter([](Cell& c) { c.wrongEdge = 6, c.digest = "2"; }),
                ElementsAre("more wrong pixels"));
    EXPECT_THAT(causesAfter([](Cell& c) { c.wrongEdge = 4; }), ElementsAre("fewer wrong pixels"));
    EXPECT_THAT(causesAfter([](Cell& c) { c.wrongEdge = 4, c.wrongInterior = 1; }),
                ElementsAre("wrong pixels elsewhere"));
    EXPECT_THAT(causesAfter([](Cell& c) {
                    c.causes = {{"mask wraps", 5}};
                }),
                ElementsAre("causes: mask clamps -> mask wraps"));
    EXPECT_THAT(causesAfter([](Cell& c) {
                    c.causes = {{"mask clamps", 4}};
                }),
                ElementsAre("causes of other numbers of pixels"));
    EXPECT_THAT(causesAfter([](Cell& c) { c.unpredicted = 1; }), ElementsAre("unpredicted pixels"));
    EXPECT_THAT(causesAfter([](Cell& c) { c.passes.rectangle = 2; }),
                ElementsAre("passes: 2/4/3/0 -> 2/4/2/0"));
    EXPECT_THAT(causesAfter([](Cell& c) { c.digest = "2"; }),
                ElementsAre("picture or mask, as right as before"));
    EXPECT_THAT(causesAfter([](Cell& c) { c.tiedCount = 2; }), ElementsAre("tied pixels"));
    EXPECT_THAT(causesAfter([](Cell& c) { c.touched.scene = 2, c.touched.volume = 3, c.vertices = 1; }),
                ElementsAre("other touched, vertices"));
    EXPECT_THAT(causesAfter([](Cell& c) {
                    c.missing = {{"stencil_bits", "stencil", "M"}};
                }),
                ElementsAre("limits: none -> stencil"));
}

TEST(RunCompare, GroupsCellsAndPutsTheGravestGroupFirst) {
    std::vector<Cell> before, after;
    for (int frame = 0; frame < 6; ++frame) {
        before.push_back(cellOf("tnt", frame));
        after.push_back(cellOf("tnt", frame));
        if (frame != 5) after.back().passes.copy = 1;
    }
    after[5].verdict = Verdict::Wrong;
    before.push_back(cellOf("gone")), after.push_back(cellOf("new"));
    const auto groups = changesBetween(before, after);
    EXPECT_THAT(causesOf(groups),
                ElementsAre("verdict: edge -> wrong (mask clamps)", "passes: 2/4/3/0 -> 2/4/3/1",
                            "only in the old run", "only in the new run"));
    EXPECT_EQ(groups[1].cells.size(), 5u);
    EXPECT_EQ(groups[1].cells[2].before.dump(), R"({"passes.copy":0})");
    EXPECT_EQ(groups[1].cells[2].after.dump(), R"({"passes.copy":1})");
    EXPECT_TRUE(groups[2].cells[0].after.is_null());
    EXPECT_TRUE(groups[3].cells[0].before.is_null());

    const std::string text = showChanges(groups, 7, 7, Format::Text);
    EXPECT_THAT(text, HasSubstr("7 cells before, 7 after: 8 differ\n"));
    EXPECT_THAT(text, HasSubstr("passes: 2/4/3/0 -> 2/4/3/1 (5 cells)\n"));
    EXPECT_THAT(text, HasSubstr("  tnt/roettger-screen/boxes/320x240/0: passes.copy 0 -> 1\n"));
    EXPECT_THAT(text, HasSubstr("  and 1 more\n"));
    EXPECT_THAT(text, HasSubstr("  gone/roettger-screen/boxes/320x240/0: edge\n"));
    EXPECT_THAT(showChanges(groups, 7, 7, Format::Csv),
                HasSubstr("passes: 2/4/3/0 -> 2/4/3/1,tnt/roettger-screen/boxes/320x240/4,passes.copy,0,1"));
    EXPECT_THAT(showChanges(groups, 7, 7, Format::Csv),
                HasSubstr("only in the old run,gone/roettger-screen/boxes/320x240/0,verdict,edge,\r\n"
                          "only in the new run,new/roettger-screen/boxes/320x240/0,verdict,,edge\r\n"));
    const auto json = nlohmann::ordered_json::parse(showChanges(groups, 7, 7, Format::Json));
    EXPECT_EQ(json["changes"].size(), 4u);
    EXPECT_EQ(json["changes"][1]["cells"].size(), 5u);
}

TEST(RunCompare, SaysInWordsWhatAChipLacksAndFitsItsPage) {
    Cell before = cellOf("tnt"), after = cellOf("tnt");
    after.verdict = Verdict::Refused;
    after.causes = {};
    after.missing = {{"stencil_bits", "a stencil buffer", "manual, page 3"}};
    Page narrow;
    narrow.width = 40;
    const std::string text = showChanges(changesBetween({before}, {after}), 1, 1, narrow);
    EXPECT_THAT(text, HasSubstr("verdict \"edge\" -> \"refused\"; missing\n"));
    EXPECT_THAT(text, HasSubstr("none -> a stencil buffer; causes\n"));
    EXPECT_THAT(text, HasSubstr("mask clamps (5) -> none\n"));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 40u) << line;
}

TEST(RunCompare, SaysWhatIsAskedOfCellsOfOneRunOnly) {
    Cell chip = cellOf("tnt");
    chip.fidelity = "chip";
    const std::string text = showChanges(changesBetween({cellOf("tnt")}, {chip}), 1, 1, Format::Text);
    EXPECT_THAT(text,
                HasSubstr("only in the old run (1 cell)\n  tnt/roettger-screen/boxes/320x240/0: edge\n"));
    EXPECT_THAT(text, HasSubstr("tnt/roettger-screen/boxes/320x240/0: edge; fidelity chip\n"));
}

// One id stands for cells of several shades; each is compared with its own.
TEST(RunCompare, TellsCellsOfOneIdApart) {
    Cell black = cellOf("tnt"), half = cellOf("tnt");
    black.axes.shade = Shade::Black, black.wrongEdge = 50;
    EXPECT_THAT(changesBetween({black, half}, {half, black}), IsEmpty());
}

}  // namespace run_compare_test
}  // namespace gnomon
