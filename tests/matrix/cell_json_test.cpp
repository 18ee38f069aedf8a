// The JSON object of a cell, as the design fixes it.

#include "matrix/cell_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon {
namespace cell_json_test {

using testing::ElementsAreArray;
using Json = nlohmann::ordered_json;

/// A cell in which no value is its default, nor equal to its neighbour.
Cell fullCell() {
    Cell c;
    c.profile = "voodoo2", c.method = "roettger-screen", c.scene = "models/cow, \"brown\".ply";
    c.axes = {.store = Store::Screen,
              .arithmetic = Arithmetic::Double,
              .levels = 3,
              .count = Count::ZpassCap,
              .silhouette = Silhouette::PerTriangle,
              .maskDivisor = 4,
              .apply = Apply::Texture,
              .shade = Shade::Ambient};
    c.width = 512, c.height = 384, c.frame = 7;
    c.fidelity = "gl", c.device = "egl", c.clock = "gpu";
    c.verdict = Verdict::Wrong;
    c.chosen = true;
    c.missing = {{"stencil_bits", "stencil", "M-TDFX"}, {"blend_equations", "blend equation max", "MAME"}};
    c.causes = {{"mask clamps", 17}, {"unexplained", 2}};
    c.passes = {2, 4, 3, 1};
    c.pixels = 196608;
    c.tiedTruth = 12, c.tiedCount = 5;
    c.wrongEdge = 8, c.wrongInterior = 11, c.unpredicted = 5;
    c.nesting = {.fronts = 6, .overlap = 3, .levels = 4};
    c.warnings = {"resolves 3 levels; up to 4 volumes or fronts may nest"};
    c.cpuMs = 1.96, c.unshadowedMs = 0.71;
    c.digest = "00ff00ff00ff00ff";
    return c;
}

std::vector<std::string> keysOf(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& item : object.items()) keys.push_back(item.key());
    return keys;
}

// Beside the design's list, "chosen" marks the path of a chip, and "nesting" and "warnings" tell what a mask
// must hold.
TEST(CellJson, HasTheFieldsOfTheDesignInItsOrder) {
    const std::vector<std::string> fields{
        "cell",     "profile",  "method",     "scene",      "store",         "arithmetic",
        "levels",   "count",    "silhouette", "mask_scale", "apply",         "shade",
        "width",    "height",   "frame",      "lights",     "fidelity",      "device",
        "effects",  "verdict",  "chosen",     "missing",    "causes",        "passes",
        "touched",  "pixels",   "tied",       "wrong",      "unpredicted",   "nesting",
        "warnings", "vertices", "clock",      "cpu_ms",     "unshadowed_ms", "digest"};
    const Json json = toJson(fullCell());
    EXPECT_THAT(keysOf(json), ElementsAreArray(fields));
    EXPECT_THAT(keysOf(json["passes"]), ElementsAreArray({"scene", "volume", "rectangle", "copy"}));
    EXPECT_THAT(keysOf(json["tied"]), ElementsAreArray({"truth", "count"}));
    EXPECT_THAT(keysOf(json["wrong"]), ElementsAreArray({"edge", "interior"}));
    EXPECT_THAT(keysOf(json["nesting"]), ElementsAreArray({"fronts", "overlap", "levels"}));
}

TEST(CellJson, PutsEachValueUnderItsName) {
    const Json json = toJson(fullCell());
    EXPECT_EQ(json["cell"], "voodoo2/roettger-screen/models/cow, \"brown\".ply/512x384/7");
    EXPECT_EQ(json["count"], "zpass-cap");
    EXPECT_EQ(json["silhouette"], "per-triangle");
    EXPECT_EQ(json["passes"].dump(), R"({"scene":2,"volume":4,"rectangle":3,"copy":1})");
    EXPECT_EQ(json["tied"].dump(), R"({"truth":12,"count":5})");
    EXPECT_EQ(json["wrong"].dump(), R"({"edge":8,"interior":11})");
    EXPECT_EQ(json["causes"].dump(), R"({"mask clamps":17,"unexplained":2})");
    EXPECT_EQ(json["missing"][0].dump(),
              R"({"capability":"stencil_bits","what":"stencil","source":"M-TDFX"})");
    EXPECT_EQ(json["nesting"].dump(), R"({"fronts":6,"overlap":3,"levels":4})");
    EXPECT_EQ(json["warnings"].dump(), R"(["resolves 3 levels; up to 4 volumes or fronts may nest"])");
    EXPECT_EQ(json["device"], "egl");
    EXPECT_EQ(json["clock"], "gpu");
    EXPECT_EQ(json["cpu_ms"], 1.96);
    EXPECT_EQ(json["unshadowed_ms"], 0.71);
}

TEST(CellJson, KeepsEmptyListsAndObjects) {
    const Json json = toJson(Cell{});
    EXPECT_EQ(json["missing"].dump(), "[]");
    EXPECT_EQ(json["causes"].dump(), "{}");
    EXPECT_EQ(json["warnings"].dump(), "[]");
}

TEST(CellJson, WritesMaskScaleAsANumber) {
    Cell cell = fullCell();
    for (const auto& [divisor, text] : {std::pair(1, "1"), {2, "0.5"}, {4, "0.25"}}) {
        cell.axes.maskDivisor = divisor;
        EXPECT_EQ(toJson(cell)["mask_scale"].dump(), text);
    }
}

TEST(CellJson, GivesLevelsForDoubleOnly) {
    Cell cell = fullCell();
    EXPECT_EQ(toJson(cell)["levels"], 3);
    cell.axes.arithmetic = Arithmetic::Halve;
    EXPECT_FALSE(toJson(cell).contains("levels"));
    cell.axes.arithmetic = Arithmetic::Count;
    EXPECT_FALSE(toJson(cell).contains("levels"));
}

TEST(CellJson, GivesAnErrorForFailedCellsOnly) {
    Cell cell = fullCell();
    EXPECT_FALSE(toJson(cell).contains("error"));
    cell.verdict = Verdict::Failed, cell.error = "crashed: signal 11";
    EXPECT_EQ(toJson(cell)["error"], "crashed: signal 11");
}

// Compared as text: toJson() is held to the fields by the tests above.
TEST(CellJson, ComesBackAsItWas) {
    for (const Verdict verdict :
         {Verdict::Exact, Verdict::Edge, Verdict::Wrong, Verdict::Refused, Verdict::Failed}) {
        Cell cell = fullCell();
        cell.verdict = verdict;
        if (verdict == Verdict::Failed) cell.error = "timed out";
        const Cell back = cellFromJson(Json::parse(toJson(cell).dump()));
        EXPECT_EQ(toJson(back).dump(), toJson(cell).dump());
        EXPECT_EQ(back.axes, cell.axes);
        EXPECT_EQ(back.missing, cell.missing);
        EXPECT_EQ(back.error, cell.error);
        EXPECT_EQ(back.nesting, cell.nesting);
        EXPECT_EQ(back.warnings, cell.warnings);
    }
}

TEST(CellJson, ComesBackForEveryNamedMethodAndShade) {
    for (const NamedMethod& method : namedMethods()) {
        for (const Shade shade : {Shade::Black, Shade::Ambient, Shade::Attenuated}) {
            Cell cell = fullCell();
            cell.axes = method.axes;
            cell.axes.shade = shade;
            cell.method = methodId(cell.axes);
            EXPECT_EQ(cellFromJson(toJson(cell)).axes, cell.axes) << method.id;
        }
    }
}

TEST(CellJson, ComesBackWithEachOptionAndWithoutThoseThatAreAsUsual) {
    Cell cell = fullCell();
    for (const char* key : {"start", "overflow", "caps", "clip", "offset", "map_size", "map_bias"})
        EXPECT_FALSE(toJson(cell).contains(key)) << key;
    cell.lights = 3;
    cell.axes.start = Start::Middle, cell.axes.overflow = Overflow::Saturate;
    cell.axes.capFaces = CapFaces::Away, cell.axes.clip = Clip::Eye, cell.axes.offset = 0.125f;
    const Cell back = cellFromJson(Json::parse(toJson(cell).dump()));
    EXPECT_EQ(back.axes, cell.axes);
    EXPECT_EQ(back.lights, 3);
    cell.axes = {.store = Store::DepthMap, .levels = 0, .mapSize = 512, .mapBias = 0.004f};
    EXPECT_EQ(cellFromJson(Json::parse(toJson(cell).dump())).axes, cell.axes);
}

TEST(CellJson, KeepsWhatElseWasAskedFor) {
    Cell cell = fullCell();
    for (const char* key : {"dither", "blend_unit", "view"}) EXPECT_FALSE(toJson(cell).contains(key)) << key;
    cell.fidelity = "chip", cell.dithers = true, cell.blendUnit = "voodoo_86box";
    cell.view = {{"light", "1,2,3,0"}, {"near", "0.25"}};
    const Cell back = cellFromJson(Json::parse(toJson(cell).dump()));
    EXPECT_TRUE(back.dithers);
    EXPECT_EQ(back.blendUnit, "voodoo_86box");
    EXPECT_EQ(back.view, cell.view);
}

TEST(CellQuestion, TellsCellsOfOneIdApart) {
    const Cell cell = fullCell();
    const auto differs = [&](auto change) {
        Cell other = cell;
        change(other);
        EXPECT_EQ(other.id(), cell.id());
        return other.question() != cell.question();
    };
    EXPECT_TRUE(differs([](Cell& c) { c.axes.shade = Shade::Black; }));
    EXPECT_TRUE(differs([](Cell& c) { c.fidelity = "chip"; }));
    EXPECT_TRUE(differs([](Cell& c) { c.dithers = true; }));
    EXPECT_TRUE(differs([](Cell& c) { c.blendUnit = "gs"; }));
    EXPECT_TRUE(differs([](Cell& c) { c.effects = Effects::none(); }));
    EXPECT_TRUE(differs([](Cell& c) { c.view = {{"near", "1"}}; }));
    EXPECT_FALSE(differs([](Cell& c) { c.verdict = Verdict::Exact, c.digest = "", c.cpuMs = 3; }));
    EXPECT_FALSE(differs([](Cell& c) { c.device = "osmesa"; }));
}

TEST(CellJson, RefusesWhatIsNoCell) {
    EXPECT_THROW(cellFromJson(Json::object()), nlohmann::json::exception);
    EXPECT_THROW(cellFromJson(Json::array()), nlohmann::json::exception);
    Json json = toJson(fullCell());
    json["width"] = "wide";
    EXPECT_THROW(cellFromJson(json), nlohmann::json::exception);
}

}  // namespace cell_json_test
}  // namespace gnomon
