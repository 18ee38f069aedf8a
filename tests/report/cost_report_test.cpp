// A study of cost as text, JSON, CSV and plots; the figures are made up.

#include "report/cost_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon {
namespace {

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
    out.amount = {{.clear = 100, .scene = 50, .volume = 7}, 12};
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
    EXPECT_THAT(text, HasSubstr("(0.50 ms of it\nhere; never the chip's time)"));
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
    EXPECT_EQ(map["time_ratio"]["median"], 1.1);
    EXPECT_EQ(map["frontier"]["time"], true);
    EXPECT_EQ(map["frontier"]["touched"], false);
    // What has no distance, or an infinite ratio, is null.
    EXPECT_TRUE(all[0]["boundary_distance"]["mean"].is_null());
    EXPECT_TRUE(all[0]["image"]["psnr"].is_null());
    EXPECT_EQ(all[4]["missing"][0]["what"], "no stencil");
    EXPECT_FALSE(all[4].contains("time_ratio"));
}

TEST(CostReport, HasAsManyFieldsInEachLineOfCsv) {
    std::istringstream lines(showCost(someStudy(), Format::Csv));
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), 32) << line;
    EXPECT_EQ(count, 6);
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

TEST(CostPlots, AreMeansOfFrames) {
    CostStudy study = someStudy();
    study.frames = {0, 1};
    const std::vector<Plot> plots = costPlots(study);
    EXPECT_EQ(seriesOf(plots[0], "shadow map").points[0].y, 15);
    EXPECT_NEAR(seriesOf(plots[1], "stencil").points[0].x, 157 / 200.0, 1e-12);
}

}  // namespace
}  // namespace gnomon
