// Figure 4 of Usta et al. 2019: its lines, and what is said of them.

#include "report/reproduce_usta2019.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gnomon {
namespace reproduce_usta2019_test {

using testing::AllOf;
using testing::HasSubstr;

/// Two frames of a scene; AtomicZP takes @p atomic times as long as Z-Pass by the same shader.
UstaRun runOf(double atomic) {
    UstaScene scene{.scene = "boxes", .triangles = 350};
    scene.lines = {
        {.method = "heidmann",
         .called = "Z-Pass",
         .ms = {1, 2},
         .ratios = {1, 1},
         .wrong = 9,
         .framesWrong = 1},
        {.method = "carmack", .called = "Z-Fail", .ms = {2, 4}, .ratios = {2, 2}},
        {.method = "heidmann", .called = "Z-Pass", .byShader = true, .ms = {10, 10}, .ratios = {1, 1}},
        {.method = "eisemann", .called = "++ZP", .byShader = true, .ms = {12, 12}, .ratios = {1.2, 1.2}},
        {.method = "atomiczp",
         .called = "AtomicZP",
         .byShader = true,
         .ms = {10 * atomic, 10 * atomic},
         .ratios = {atomic, atomic}}};
    return {.width = 64, .height = 48, .frames = 2, .repeats = 3, .device = "a device", .scenes = {scene}};
}

TEST(ShowUsta, ConfirmsOrRefutesThatAtomiczpIsAsFast) {
    EXPECT_THAT(showUsta(runOf(1.04), Format::Text),
                HasSubstr("AtomicZP is as fast as Z-Pass (by the same shader, within 5 %): confirmed, 1.04"));
    EXPECT_THAT(showUsta(runOf(1.06), Format::Text), HasSubstr("within 5 %): refuted, 1.06"));
}

TEST(ShowUsta, GivesOrderAndOverheads) {
    EXPECT_THAT(showUsta(runOf(1.1), Format::Text),
                AllOf(HasSubstr("volumes by the host: Z-Pass < Z-Fail\n"),
                      HasSubstr("volumes by the shader: Z-Pass < AtomicZP < ++ZP\n"),
                      HasSubstr("++ZP is slower than Z-Pass (by the same shader): confirmed, 1.20"),
                      HasSubstr("Z-Fail is slower than Z-Pass (volumes by the host): confirmed, 2.00")));
}

TEST(ShowUsta, CallsEqualWhatNoiseOrders) {
    UstaRun run = runOf(1.1);
    run.scenes[0].lines[4].ms = {9, 11};  // atomiczp, once quicker and once slower than Z-Pass
    EXPECT_THAT(showUsta(run, Format::Text), HasSubstr("by the shader: Z-Pass = AtomicZP < ++ZP\n"));
}

TEST(ShowUsta, AsCsvHasALinePerMethodAndFrame) {
    const std::string csv = showUsta(runOf(1), Format::Csv);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 5 * 2);
    EXPECT_THAT(csv, HasSubstr("boxes,carmack,host,1,4.0000,2.0000"));
}

TEST(ShowUsta, AsJsonHasEveryLine) {
    const auto all = nlohmann::json::parse(showUsta(runOf(1), Format::Json));
    const auto& lines = all[0]["scenes"][0]["lines"];
    ASSERT_EQ(lines.size(), 5u);
    EXPECT_EQ(lines[0]["frames_wrong"], 1);
    EXPECT_EQ(lines[1]["ratio"]["median"], 2);
    EXPECT_EQ(lines[4]["volumes"], "shader");
}

TEST(UstaPlots, HaveAPanelPerBuilderAndOneLinePerMethod) {
    UstaRun run = runOf(1);
    run.scenes[0].scene = "folder/level.glb";
    const auto plots = ustaPlots(run);
    ASSERT_EQ(plots.size(), 2u);
    EXPECT_EQ(plots[0].title, "Making the stencil mask of level.glb, volumes by the host");
    EXPECT_EQ(plots[0].series.size(), 2u);
    ASSERT_EQ(plots[1].series.size(), 3u);
    EXPECT_EQ(plots[1].series[2].points[1].y, 10);
}

}  // namespace reproduce_usta2019_test
}  // namespace gnomon
