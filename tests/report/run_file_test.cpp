// Runs as they are read back, and what is said of those that can't be.

#include "report/run_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "matrix/cell_json.h"
#include "report/matrix_report.h"

namespace gnomon {
namespace run_file_test {

using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::ordered_json;

Cell drawnCell(const std::string& profile, int frame) {
    Cell c;
    c.profile = profile, c.method = "roettger-screen", c.scene = "boxes";
    c.axes = findMethod("roettger-screen")->axes;
    c.width = 32, c.height = 24, c.frame = frame, c.pixels = 768;
    c.verdict = Verdict::Wrong;
    c.causes = {{"mask clamps", 17}};
    c.passes = {2, 4, 3, 1};
    c.wrongEdge = 8, c.wrongInterior = 9;
    c.warnings = {"resolves 2 levels"};
    c.touched = {.clear = 1, .scene = 5'000'000'000};
    c.cpuMs = 1.96, c.unshadowedMs = 0.71;
    c.digest = "00ff00ff00ff00ff";
    return c;
}

std::vector<Cell> cellsOfEveryKind() {
    Cell refused = drawnCell("voodoo1", 3);
    refused.verdict = Verdict::Refused;
    refused.missing = {{"stencil_bits", "stencil", "M-TDFX; \"Napalm\" only, [1] {2}"}};
    Cell failed = drawnCell("tnt", 3);
    failed.verdict = Verdict::Failed, failed.error = "crashed: signal 11";
    Cell placed = drawnCell("ideal", 0);
    placed.fidelity = "chip", placed.dithers = true, placed.blendUnit = "gs";
    placed.view = {{"light", "1,2,3,0"}, {"near", "0.25"}};
    Cell map = drawnCell("ideal", 0);
    map.method = "williams", map.axes = findMethod("williams")->axes;
    Cell chosen = drawnCell("ideal", 0);
    chosen.method = "auto", chosen.drawnBy = "roettger-screen", chosen.effects = Effects::none();
    return {drawnCell("ideal", 0), drawnCell("ideal", 5), refused, failed, placed, map, chosen};
}

std::string whyNot(const std::string& text) {
    try {
        parseRun("run.json", text);
    } catch (const RunError& error) {
        return error.what();
    }
    return "it was read";
}

TEST(RunFile, ReadsEveryCellThatTheMatrixWrites) {
    const std::vector<Cell> cells = cellsOfEveryKind();
    const RunRecord run = parseRun("run.json", matrixJson(cells));
    EXPECT_EQ(matrixJson(run.cells), matrixJson(cells));
    EXPECT_EQ(run.lines, (std::vector<int>{1, 2, 3, 4, 5, 6, 7}));
}

TEST(RunFile, TakesAnyLayout) {
    const std::vector<Cell> cells = cellsOfEveryKind();
    const std::string pretty = Json::parse(matrixJson(cells)).dump(2);
    EXPECT_EQ(matrixJson(parseRun("run.json", "\r\n " + pretty + "\n\n").cells), matrixJson(cells));
}

// A cut at any byte is seen, and nothing is read beyond the end.
TEST(RunFile, SaysWhereACutFileEnds) {
    const std::string text = matrixJson({drawnCell("ideal", 0), drawnCell("ideal", 1)});
    for (std::size_t size = 0; size + 2 < text.size(); size += size < 40 ? 1 : 37)
        EXPECT_THAT(whyNot(text.substr(0, size)), StartsWith("run.json:")) << size;
    EXPECT_EQ(whyNot(""), "run.json:1: an empty file, no run");
    EXPECT_EQ(whyNot(text.substr(0, text.size() - 2)), "run.json:2: the file ends in the middle of a run");
}

TEST(RunFile, RefusesWhatIsNoListOfCells) {
    EXPECT_EQ(whyNot("[]\n"), "run.json:1: a run without cells");
    EXPECT_THAT(whyNot("{}"), HasSubstr("one object"));
    EXPECT_THAT(whyNot(R"({"format": 7, "cells": []})"), HasSubstr("run.json:1: a run of format 7"));
    EXPECT_THAT(whyNot("exact,wrong\n"), HasSubstr("no run"));
    EXPECT_THAT(whyNot("[1]"), HasSubstr("run.json:1: a number, not a cell"));
    EXPECT_THAT(whyNot("[\n\n{\"cell\":\n nonsense}]"), HasSubstr("run.json:4: no JSON: "));
    EXPECT_THAT(whyNot("[{}]"), HasSubstr("no 'cell'"));
    EXPECT_THAT(whyNot(matrixJson({drawnCell("ideal", 0)}) + "x"), HasSubstr("more after the end"));
    EXPECT_THAT(whyNot(std::string(100'000, '[')), StartsWith("run.json:1: "));
    EXPECT_THAT(whyNot("[" + std::string(100'000, '[') + std::string(100'000, ']') + "]"),
                HasSubstr("a list, not a cell"));
}

TEST(RunFile, RefusesTheSameCellTwice) {
    const Cell cell = drawnCell("ideal", 0);
    EXPECT_EQ(whyNot(matrixJson({cell, drawnCell("ideal", 1), cell})),
              fmt::format("run.json:3: {} a second time, first in line 1", cell.id()));
    Cell other = cell;
    other.axes.shade = Shade::Black;  // no part of the id
    EXPECT_EQ(whyNot(matrixJson({cell, other})), "it was read");
}

struct Damage {
    std::string what{};
    std::function<void(Json&)> of{};
    std::string why{};
};
void PrintTo(const Damage& damage, std::ostream* out) {
    *out << damage.what;
}

class DamagedCell : public testing::TestWithParam<Damage> {};

TEST_P(DamagedCell, IsRefusedWithItsLine) {
    Json json = toJson(drawnCell("ideal", 1));
    GetParam().of(json);
    const std::string text = "[" + toJson(drawnCell("ideal", 0)).dump() + ",\n" + json.dump() + "]\n";
    const std::string why = whyNot(text);
    EXPECT_THAT(why, StartsWith("run.json:2: "));
    EXPECT_THAT(why, HasSubstr(GetParam().why));
    EXPECT_EQ(why.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Keys, DamagedCell,
    testing::Values(
        Damage{"NoDigest", [](Json& j) { j.erase("digest"); }, "no 'digest'"},
        Damage{"NoPart", [](Json& j) { j["passes"].erase("copy"); }, "no 'passes.copy'"},
        Damage{"NoLevels", [](Json& j) { j.erase("levels"); }, "levels"},
        Damage{"Unknown", [](Json& j) { j["speed"] = 3; }, "unknown key 'speed'"},
        Damage{"UnknownPart", [](Json& j) { j["tied"]["both"] = 3; }, "unknown key 'tied.both'"},
        Damage{"TextForNumber", [](Json& j) { j["width"] = "wide"; }, "'width' is a text, not a number"},
        Damage{"Null", [](Json& j) { j["wrong"]["edge"] = nullptr; }, "'wrong.edge' is null"},
        Damage{"Negative", [](Json& j) { j["frame"] = -1; }, "'frame' can't be -1"},
        Damage{"Huge", [](Json& j) { j["height"] = 1e300; }, "'height' can't be"},
        Damage{"Fraction", [](Json& j) { j["pixels"] = 1.5; }, "'pixels' can't be 1.5"},
        Damage{"NoPixels", [](Json& j) { j["width"] = 0; }, "a window of 0x24"},
        Damage{"Scale", [](Json& j) { j["mask_scale"] = 0; }, "'mask_scale' can't be 0"},
        Damage{"Word", [](Json& j) { j["verdict"] = "good"; }, "no such word: good"},
        Damage{"Device", [](Json& j) { j["device"] = "glide"; }, "no such device 'glide'"},
        Damage{"Fidelity", [](Json& j) { j["fidelity"] = "none"; }, "no such fidelity 'none'"},
        Damage{"Effects", [](Json& j) { j["effects"] = "some"; }, "no such effects"},
        Damage{"OtherId", [](Json& j) { j["cell"] = "a/b/c/1x1/0"; }, "'cell' is"},
        Damage{"OtherMethod",
               [](Json& j) {
                   j["method"] = "no-such-method";
                   std::string id = j["cell"];
                   const std::size_t at = id.find('/') + 1;
                   j["cell"] = id.replace(at, id.find('/', at) - at, "no-such-method");
               },
               "no method 'no-such-method': the axes of this cell are those of '"},
        Damage{"Contradiction", [](Json& j) { j["store"] = "stencil"; }, "double"},
        Damage{"Cause", [](Json& j) { j["causes"]["mask clamps"] = "many"; }, "'causes.mask clamps'"},
        Damage{"StrangeCause",
               [](Json& j) {
                   j["causes"] = {{"no reason", 0}};
               },
               "no such cause 'no reason'"},
        Damage{"UncausedPixels",
               [](Json& j) {
                   j["verdict"] = "edge";
                   j["wrong"] = {{"edge", 3}, {"interior", 0}};
                   j["causes"] = {{"mask clamps", 2}};
               },
               "3 wrong pixels, but causes of 2"},
        Damage{"OtherVerdict",
               [](Json& j) {
                   j["verdict"] = "exact";
                   j["wrong"] = {{"edge", 3}, {"interior", 0}};
               },
               "the verdict is exact, but with 3 wrong pixels"},
        Damage{"Missing", [](Json& j) { j["missing"] = {3}; }, "'missing' has what is no object"},
        Damage{"Warning", [](Json& j) { j["warnings"] = {3}; }, "'warnings'"},
        Damage{"View",
               [](Json& j) {
                   j["view"] = {{"light", 3}};
               },
               "'view.light' is no text"},
        Damage{"Dither", [](Json& j) { j["dither"] = "maybe"; }, "'dither'"},
        Damage{"NewLine", [](Json& j) { j["a\nb"] = 3; }, "unknown key 'a b'"}),
    [](const auto& test) { return test.param.what; });

}  // namespace run_file_test
}  // namespace gnomon
