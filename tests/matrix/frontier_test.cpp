// What accuracy costs: the settings that are compared, their errors, and which of them nothing beats.

#include "matrix/frontier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "scenes.h"

namespace gnomon {
namespace frontier_test {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

/// The definition: nothing has less of one and no more of the other.
std::vector<bool> bruteForce(const std::vector<Bargain>& all) {
    std::vector<bool> isOn;
    for (const Bargain& one : all)
        isOn.push_back(std::none_of(all.begin(), all.end(), [&](const Bargain& other) {
            return other.error <= one.error && other.cost <= one.cost &&
                   (other.error < one.error || other.cost < one.cost);
        }));
    return isOn;
}

TEST(OnFrontier, IsWhatNothingBeatsInBoth) {
    std::mt19937 random(11);
    for (int round = 0; round < 500; ++round) {
        // Few values, so that many are equal in one or in both.
        std::vector<Bargain> all(random() % 30);
        for (Bargain& one : all) one = {double(random() % 8), double(random() % 8)};
        ASSERT_EQ(onFrontier(all), bruteForce(all)) << round;
    }
}

TEST(OnFrontier, HasBothOfTwoThatAreAlike) {
    EXPECT_THAT(onFrontier(std::vector<Bargain>{{0, 2}, {0, 2}, {5, 1}, {5, 3}}),
                ElementsAre(true, true, true, false));
}

TEST(SettingName, SaysWhatDiffersFromANamedMethod) {
    EXPECT_EQ(settingName(method("carmack")), "carmack");
    EXPECT_EQ(settingName(method("auto")), "auto");
    EXPECT_EQ(settingName(with(method("heidmann"), Silhouette::PerTriangle)), "heidmann per-triangle");
    Axes axes = method("roettger-alpha");
    axes.levels = 4;
    EXPECT_EQ(settingName(axes), "roettger-alpha levels 4");
    axes.shade = Shade::Black;
    EXPECT_EQ(settingName(axes), "roettger-alpha levels 4, black");
    axes = method("williams");
    axes.mapSize = 256;
    EXPECT_EQ(settingName(axes), "williams map 256");
    axes.mapBias = 0.5f;
    EXPECT_EQ(settingName(axes), methodId(axes));
}

std::vector<std::string> namesOf(const std::vector<CostSetting>& settings) {
    std::vector<std::string> names;
    for (const CostSetting& setting : settings) names.push_back(setting.name);
    return names;
}

TEST(CostSweep, HasAllNamedMethodsAndNoTwoAlike) {
    for (const char* id : {"ideal", "g400", "voodoo2", "ps2"}) {
        const auto names = namesOf(costSweep(chip(id), Shade::Attenuated, {}, {}));
        EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size()) << id;
        for (const NamedMethod& row : namedMethods()) EXPECT_THAT(names, Contains(row.id)) << id;
        for (const char* swept : {"roettger-screen levels 1", "roettger-alpha levels 4", "heidmann manifold",
                                  "williams map 2048"})
            EXPECT_THAT(names, Contains(swept)) << id;
    }
}

TEST(CostSweep, HasTheChipsOwnArithmeticAndDepthsWhereItHasThem) {
    const auto ideal = namesOf(costSweep(chip("ideal"), Shade::Attenuated, {}, {}));
    EXPECT_THAT(ideal, Not(Contains("roettger-screen, chip")));
    EXPECT_THAT(ideal, Not(Contains(testing::HasSubstr("depth"))));
    const auto ps2 = namesOf(costSweep(chip("ps2"), Shade::Attenuated, {}, {}));
    EXPECT_THAT(ps2, Contains("roettger-screen, chip"));
    EXPECT_THAT(ps2, Contains("carmack, depth 32"));
    EXPECT_THAT(ps2, Contains("carmack, depth 16"));
    // One that is asked for is the only one.
    EXPECT_THAT(namesOf(costSweep(chip("ps2"), Shade::Attenuated, {FidelityChoice{}}, {})),
                Not(Contains("roettger-screen, chip")));
}

CostRequest requestOf(const std::string& profile, const std::vector<std::string>& methods) {
    CostRequest request{.profile = chip(profile), .reference = chip("ideal"), .width = 96, .height = 72};
    std::vector<Axes> axes;
    for (const std::string& id : methods) axes.push_back(method(id));
    request.settings = costSettings(request.profile, axes, {{}}, {});
    request.repeats = 1;
    return request;
}

const CostRow& rowOf(const CostStudy& study, const std::string& name) {
    const auto found = std::find_if(study.rows.begin(), study.rows.end(),
                                    [&](const CostRow& row) { return row.setting.name == name; });
    if (found == study.rows.end()) throw std::runtime_error("no row " + name);
    return *found;
}

TEST(CostStudy, HasExactMethodsFirstWithoutAnyErrorAndOneOnTheFrontier) {
    Lab lab(shippedScene("roettger"));
    const CostStudy study = costStudy(
        lab, requestOf("ideal", {"none", "williams", "carmack", "roettger-half", "heidmann", "auto"}));
    EXPECT_EQ(study.framesCompared, 1);
    for (const char* id : {"carmack", "heidmann", "auto"}) {
        const CostRow& row = rowOf(study, id);
        EXPECT_EQ(row.error.wrong(), 0) << id;
        EXPECT_EQ(row.error.rms(), 0) << id;
        EXPECT_EQ(row.error.measured, 0) << id;
    }
    EXPECT_EQ(rowOf(study, "auto").drawnBy, "heidmann");
    const CostRow& first = study.rows.front();
    EXPECT_EQ(first.error.wrong(), 0);
    EXPECT_TRUE(first.onTimeFrontier);
    // The minimal plan touches less than the full ones, and no shadows less than any.
    EXPECT_TRUE(rowOf(study, "auto").onTouchedFrontier);
    EXPECT_TRUE(rowOf(study, "none").onTouchedFrontier);
    EXPECT_FALSE(rowOf(study, "carmack").onTouchedFrontier);
    for (std::size_t i = 1; i < study.rows.size(); ++i)
        EXPECT_LE(study.rows[i - 1].error.wrong(), study.rows[i].error.wrong());
}

TEST(CostStudy, CountsAndTimesAreThoseOfTheFrame) {
    Lab lab(shippedScene("roettger"));
    const CostStudy study = costStudy(lab, requestOf("ideal", {"none", "roettger-half"}));
    lab.simulate({});
    const Cell cell = lab.run(chip("ideal"), method("roettger-half"), 96, 72, 0);
    const CostRow& half = rowOf(study, "roettger-half");
    EXPECT_EQ(half.error.edge, cell.wrongEdge);
    EXPECT_EQ(half.error.interior, cell.wrongInterior);
    EXPECT_EQ(half.passes, cell.passes);
    EXPECT_EQ(half.amount.pixels, cell.touched);
    EXPECT_EQ(half.amount.vertices, cell.vertices);
    EXPECT_EQ(half.ratios.size(), 1u);
    EXPECT_GT(half.ratio.median, 0);
    EXPECT_GT(study.unshadowedMs, 0);
}

TEST(CostStudy, HasTheModelsCostOfWhatIsDrawn) {
    Lab lab(shippedScene("roettger"));
    const CostStudy study = costStudy(lab, requestOf("voodoo2", {"none", "roettger-screen", "auto"}));
    ASSERT_TRUE(study.hasModelRates);
    lab.simulate({});
    const FrameCost full = lab.fullCost(chip("voodoo2"), method("roettger-screen"), 96, 72, 0);
    const ModelSum& screen = rowOf(study, "roettger-screen").model;
    EXPECT_EQ(screen.bytes, full.bytes());
    EXPECT_EQ(screen.ms, full.ms());
    EXPECT_EQ(screen.limit, full.limit());
    // What is chosen is drawn with what the frame calls for, which takes less than the whole method.
    EXPECT_LT(rowOf(study, "auto").model.bytes, screen.bytes);
    EXPECT_LT(rowOf(study, "none").model.ms, screen.ms);
    EXPECT_TRUE(rowOf(study, "none").onModelFrontier);
}

TEST(CostRequest, HasAsManyRoundsInAllFramesAsInOne) {
    EXPECT_EQ(defaultRepeats(1), 9);
    EXPECT_EQ(defaultRepeats(2), 5);
    EXPECT_EQ(defaultRepeats(9), 1);
    EXPECT_EQ(defaultRepeats(60), 1);
}

TEST(ModelSum, AddsFramesAndHasTheLimitOfTheLongest) {
    FrameCost fill, bandwidth;
    fill.passes = {{.traffic = {.depthRead = 3, .busBytes = 5}, .fillMs = 2, .bandwidthMs = 1}};
    bandwidth.passes = {{.traffic = {.colourWritten = 4}, .fillMs = 2, .bandwidthMs = 7}};
    bandwidth.missing = {"no triangle rate"};
    ModelSum sum;
    for (const FrameCost& frame : {fill, bandwidth, fill}) sum.add(frame);
    EXPECT_EQ(sum.bytes, 10);
    EXPECT_EQ(sum.busBytes, 10);
    EXPECT_EQ(sum.fillMs, 6);
    EXPECT_EQ(sum.bandwidthMs, 9);
    EXPECT_EQ(sum.ms, 11);
    EXPECT_EQ(sum.limit, Resource::Bandwidth);
    EXPECT_EQ(sum.missing, std::vector<std::string>{"no triangle rate"});
}

TEST(CostStudy, MeasuresHowFarErrorsAreFromTheBoundary) {
    Lab lab(shippedScene("roettger"));
    CostRequest request = requestOf("ideal", {"none", "roettger-half", "roettger-quarter"});
    request.width = 320, request.height = 240;
    const CostStudy study = costStudy(lab, request);
    // All of the shadow is wrong without any; a coarse mask errs by about one of its pixels at most, which is
    // two or four of the window's, and never by less than one.
    const ErrorSum &none = rowOf(study, "none").error, &half = rowOf(study, "roettger-half").error,
                   &quarter = rowOf(study, "roettger-quarter").error;
    EXPECT_EQ(none.measured, none.wrong());
    EXPECT_GT(none.largestDistance, 8);
    for (const ErrorSum* error : {&half, &quarter}) {
        EXPECT_GE(error->meanDistance(), 1);
        EXPECT_GE(error->largestDistance, error->meanDistance());
        EXPECT_LT(error->largestDistance, 4 * std::sqrt(2.0));
    }
    // The image says the same: the more pixels are wrong, the larger the difference.
    EXPECT_LT(0, *half.rms());
    EXPECT_LT(*half.rms(), *quarter.rms());
    EXPECT_LT(*quarter.rms(), *none.rms());
    EXPECT_GT(*half.psnr(), *quarter.psnr());
}

TEST(CostStudy, SumsErrorsAndAmountsOverFrames) {
    Lab lab(shippedScene("roettger"));
    CostRequest request = requestOf("ideal", {"roettger-quarter"});
    int edge = 0;
    std::int64_t touched = 0;
    for (const int frame : {3, 20}) {
        request.frames = {frame};
        const CostRow row = costStudy(lab, request).rows.front();
        edge += row.error.edge, touched += row.amount.pixels.total();
    }
    request.frames = {3, 20};
    const CostStudy both = costStudy(lab, request);
    EXPECT_EQ(both.rows.front().error.edge, edge);
    EXPECT_EQ(both.rows.front().amount.pixels.total(), touched);
    EXPECT_EQ(both.rows.front().ratios.size(), 2u);
    EXPECT_EQ(both.rows.front().error.squares.size(), 2u);
}

TEST(CostStudy, SaysWhatAChipLacksInsteadOfDrawing) {
    Lab lab(shippedScene("roettger"));
    const CostStudy study = costStudy(lab, requestOf("voodoo2", {"carmack", "roettger-screen"}));
    EXPECT_THAT(rowOf(study, "carmack").missing, Not(IsEmpty()));
    EXPECT_THAT(rowOf(study, "carmack").ratios, IsEmpty());
    EXPECT_THAT(rowOf(study, "roettger-screen").missing, IsEmpty());
    // In 16 bits of colour, against what truth gives in 16 bits.
    EXPECT_LT(*rowOf(study, "roettger-screen").error.rms(), 5);
    EXPECT_EQ(study.rows.back().setting.name, "carmack");
}

}  // namespace frontier_test
}  // namespace gnomon
