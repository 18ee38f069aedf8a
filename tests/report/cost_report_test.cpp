// A study of cost as text, JSON, CSV and plots; the figures are made up.

#include "report/cost_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon {
namespace cost_report_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Json = nlohmann::json;

CostRow row(const std::string& id, int wrong, double ratio) {
    CostRow out;
    out.setting = {.name = id, .way = {.axes = findMethod(id)->axes}, .isNamed = true};
    out.error = {.edge = wrong, .squares = {double(wrong)}};
    if (wrong) out.error.measured = 2, out.error.distanceSum = 3, out.error.largestDistance = 2;
    out.ratio = {ratio, ratio - 0.1, ratio + 0.1};
    out.ms = {ratio / 2, ratio / 2, ratio / 2};
    out.amount = {{.clear = 100, .scene = 50, .volume = 7}, 12};
    out.model = {.bytes = 3'000'000, .busBytes = 500'000, .fillMs = 1, .bandwidthMs = 4, .ms = 4.5};
    out.model.limit = Resource::Bandwidth;
    return out;
}

CostStudy someStudy() {
    CostStudy study{.profile = "ideal",
                    .scene = "roettger",
                    .width = 10,
                    .height = 10,
                    .repeats = 9,
                    .frames = {0},
                    .unshadowedMs = 0.5,
                    .framesCompared = 1};
    study.rows = {row("carmack", 0, 1.5), row("heidmann", 0, 1.25), row("williams", 30, 1.1),
                  row("roettger-half", 40, 1.75), row("eisemann", 0, 0)};
    for (const std::size_t on : {1, 2}) study.rows[on].onTimeFrontier = true;
    study.rows[4].missing = {{"stencil_bits", "no stencil", "a source"}};
    return study;
}

TEST(CostReport, FitsAHundredColumnsAndSaysWhatIsRefused) {
    CostStudy study = someStudy();
    for (CostRow& one : study.rows) one.amount.pixels.volume = 999'999;
    study.rows[3].setting.name = "heidmann per-triangle, depth 32";
    const std::string text = showCost(study, Format::Text);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
    // 100 cleared and 50 drawn of 100 pixels, and all of the volumes.
    EXPECT_THAT(text, HasSubstr("  1.00   0.50   9999.99  "));
    EXPECT_THAT(text, HasSubstr("roettger on ideal, 10x10, frame 0"));
    EXPECT_THAT(text, HasSubstr("Refused\n  eisemann: lacks no stencil\n"));
    EXPECT_THAT(text, HasSubstr("0.50 ms"));
}

TEST(CostReport, SaysSoWhereImagesCouldNotBeCompared) {
    CostStudy study = someStudy();
    EXPECT_THAT(showCost(study, Format::Text), Not(HasSubstr("0 of 1 frames")));
    study.framesCompared = 0;
    for (CostRow& one : study.rows) one.error.squares.clear();
    EXPECT_THAT(showCost(study, Format::Text), HasSubstr("0 of 1 frames"));
    EXPECT_TRUE(Json::parse(showCost(study, Format::Json))[0]["image"]["rms"].is_null());
}

TEST(CostReport, HasAnObjectPerSettingInJson) {
    const Json all = Json::parse(showCost(someStudy(), Format::Json));
    ASSERT_EQ(all.size(), 5u);
    const Json& map = all[2];
    EXPECT_EQ(map["setting"], "williams");
    EXPECT_EQ(map["wrong"]["edge"], 30);
    EXPECT_EQ(map["wrong"]["interior"], 0);
    EXPECT_EQ(map["boundary_distance"]["mean"], 1.5);
    EXPECT_EQ(map["boundary_distance"]["largest"], 2);
    EXPECT_NEAR(map["image"]["rms"], std::sqrt(30.0), 1e-12);
    EXPECT_EQ(map["touched"]["total"], 157);
    EXPECT_EQ(map["vertices"], 12);
    EXPECT_EQ(map["bytes"], 3'000'000);
    EXPECT_EQ(map["bus_bytes"], 500'000);
    EXPECT_TRUE(map["model"]["ms"].is_null());  // the chip has no rates
    EXPECT_EQ(map["ms"]["median"], 0.55);
    EXPECT_EQ(map["time_ratio"]["median"], 1.1);
    EXPECT_EQ(map["frontier"]["time"], true);
    EXPECT_EQ(map["frontier"]["touched"], false);
    // What has no distance, or an infinite ratio, is null.
    EXPECT_TRUE(all[0]["boundary_distance"]["mean"].is_null());
    EXPECT_TRUE(all[0]["image"]["psnr"].is_null());
    EXPECT_EQ(all[4]["missing"][0]["what"], "no stencil");
    EXPECT_FALSE(all[4].contains("time_ratio"));
}

TEST(CostReport, GivesTimesOfTheModelOnlyWhereTheChipHasRates) {
    CostStudy study = someStudy();
    study.rows[0].model.missing = {"no fill rate in the profile (megapixels_per_second)"};
    EXPECT_THAT(showCost(study, Format::Text), HasSubstr("williams       3.00  0.50\n"));
    EXPECT_THAT(showCost(study, Format::Text), HasSubstr("No time by the model: no fill rate"));
    EXPECT_EQ(costPlots(study).size(), 2u);
    study.hasModelRates = true;
    study.frames = {0, 1};  // all is of one frame
    study.rows[2].onModelFrontier = true;
    const std::string text = showCost(study, Format::Text);
    EXPECT_THAT(
        text, HasSubstr("williams       1.50  0.25    0.50  2.00       -          -    2.25  bandwidth  #"));
    const Json all = Json::parse(showCost(study, Format::Json));
    EXPECT_EQ(all[0]["model"]["limit"], "bandwidth");
    EXPECT_EQ(all[0]["model"]["ms"], 2.25);  // times are of one frame, counts of all
    EXPECT_EQ(all[0]["bytes"], 3'000'000);
    EXPECT_EQ(all[0]["device"], "osmesa");
    const std::vector<Plot> plots = costPlots(study);
    ASSERT_EQ(plots.size(), 3u);
    EXPECT_EQ(plots[2].series.front().points[0].x, 2.25);
}

TEST(CostReport, HasNoTablesWhereAllIsRefused) {
    CostStudy study = someStudy();
    for (CostRow& one : study.rows) one.missing = {{"stencil_bits", "no stencil", "a source"}};
    EXPECT_EQ(showCost(study, Format::Text),
              "roettger on ideal, 10x10, frame 0: what accuracy costs\n\nRefused\n"
              "  carmack; heidmann; williams; roettger-half; eisemann: lacks no stencil\n");
}

TEST(CostReport, SaysWhichFrames) {
    CostStudy study = someStudy();
    study.frames = {0, 3};
    EXPECT_THAT(showCost(study, Format::Text), HasSubstr("10x10, frames 0, 3: what"));
    study.repeats = 1;
    EXPECT_THAT(showCost(study, Format::Text), HasSubstr("1 round in each frame"));
    study.frames.clear();
    for (int frame = 0; frame < 60; frame += 2) study.frames.push_back(frame);
    EXPECT_THAT(showCost(study, Format::Text), HasSubstr("30 frames of 0 to 58"));
}

TEST(CostReport, GivesTheGpusOwnTime) {
    CostStudy study = someStudy();
    EXPECT_THAT(showCost(study, Format::Text), Not(HasSubstr("0.550")));
    study.clock = "gpu";
    EXPECT_THAT(showCost(study, Format::Text), HasSubstr("0.550"));
    EXPECT_THAT(showCost(study, Format::Text), HasSubstr("time: of this GPU"));
}

TEST(CostReport, HasAllOfJsonInCsv) {
    const std::string csv = showCost(someStudy(), Format::Csv);
    std::istringstream lines(csv);
    std::string head;
    std::getline(lines, head);
    for (const char* name :
         {"setting", "wrong_edge", "boundary_distance_mean", "image_rms", "passes_scene", "touched_total",
          "bytes", "model_limit", "device", "ms_low", "time_ratio_median", "frontier_model"})
        EXPECT_THAT("," + head, HasSubstr(std::string(",") + name)) << csv;
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(head.begin(), head.end(), ','))
            << line;
    EXPECT_EQ(count, 5);
    EXPECT_THAT(csv, HasSubstr(",no stencil,"));
}

const PlotSeries& seriesOf(const Plot& plot, const std::string& name) {
    const auto found = std::find_if(plot.series.begin(), plot.series.end(),
                                    [&](const PlotSeries& s) { return s.name == name; });
    if (found == plot.series.end()) throw std::runtime_error("no series " + name);
    return *found;
}

TEST(CostPlots, ShowEachSettingThatIsDrawnAndTheFrontierAsSteps) {
    const std::vector<Plot> plots = costPlots(someStudy());
    ASSERT_EQ(plots.size(), 2u);
    const Plot& time = plots[0];
    const PlotSeries& steps = time.series.front();
    EXPECT_TRUE(steps.stepped);
    ASSERT_EQ(steps.points.size(), 2u);
    EXPECT_EQ(steps.points[0].x, 1.1);
    EXPECT_EQ(steps.points[0].y, 30);
    EXPECT_EQ(steps.points[1].x, 1.25);
    EXPECT_EQ(steps.points[1].y, 0);

    const PlotSeries& stencil = seriesOf(time, "stencil");
    ASSERT_EQ(stencil.points.size(), 2u);
    EXPECT_EQ(stencil.points[0].x, 1.5);
    EXPECT_EQ(stencil.points[0].xLow, 1.4);
    // Of the exact ones the cheapest has a name.
    EXPECT_EQ(stencil.points[0].label, "");
    EXPECT_EQ(stencil.points[1].label, "heidmann");
    EXPECT_TRUE(stencil.points[1].marked);
    EXPECT_EQ(seriesOf(time, "smaller mask").points[0].label, "roettger-half");
    // Both axes say their units, and 0 has its place.
    EXPECT_THAT(time.x.title, HasSubstr("multiple of the frame without shadows"));
    EXPECT_THAT(time.y.title, HasSubstr("pixels"));
    EXPECT_EQ(time.y.foot, "0: exact");
    EXPECT_EQ(seriesOf(plots[1], "stencil").points[0].x, 1.57);
}

TEST(CostPlots, ShowAnAutomaticMethodAsWhatItHasChosen) {
    CostStudy study = someStudy();
    study.rows[0].setting = {.name = "auto", .way = {.axes = findMethod("auto")->axes}, .isNamed = true};
    study.rows[0].drawnBy = "screen-parity";
    const std::vector<Plot> plots = costPlots(study);
    EXPECT_EQ(seriesOf(plots[0], "colour buffer").points.size(), 1u);
    EXPECT_EQ(seriesOf(plots[0], "stencil").points.size(), 1u);
}

TEST(CostPlots, GiveAKindTheSameLookWhateverElseIsThere) {
    CostStudy study = someStudy();
    const auto before = seriesOf(costPlots(study)[0], "smaller mask").look;
    ASSERT_TRUE(before);
    study.rows = {study.rows[3]};
    EXPECT_EQ(seriesOf(costPlots(study)[0], "smaller mask").look, before);
}

TEST(CostPlots, AreMeansOfFrames) {
    CostStudy study = someStudy();
    study.frames = {0, 1};
    const std::vector<Plot> plots = costPlots(study);
    EXPECT_EQ(seriesOf(plots[0], "shadow map").points[0].y, 15);
    EXPECT_NEAR(seriesOf(plots[1], "stencil").points[0].x, 157 / 200.0, 1e-12);
}

}  // namespace cost_report_test
}  // namespace gnomon
