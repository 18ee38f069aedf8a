// What is told of a frame's cost by the model.

#include "report/cost_notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon {
namespace cost_notes_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// 4 ms of fill and 1 of the bus.
FrameCost fiveMs() {
    return {.passes = {{.kind = PassKind::Volume, .traffic = {.fragments = 7, .depthRead = 28}, .fillMs = 4},
                       {.kind = PassKind::Copy, .traffic = {.busBytes = 9}, .busMs = 1}}};
}

TEST(CostText, TellsTimeRateLimitAndTheirSources) {
    CostNotes notes{fiveMs(), {.passes = {{.fillMs = 8}}}, {"fill 50 Mpixel/s [SHEET]"}};
    const std::string text = costText(notes);
    EXPECT_THAT(text, AllOf(HasSubstr("not measured: at least 5.00 ms, at most 200.0 frames per second"),
                            HasSubstr("by fill; the full plan at least 8.00 ms"),
                            HasSubstr("rates: fill 50 Mpixel/s [SHEET]"), HasSubstr("--host-ms"),
                            Not(HasSubstr("no bus rate"))));
    notes.minimal.missing = {"no bus rate in the profile (bus_megabytes_per_second)"};
    EXPECT_THAT(costText(notes),
                HasSubstr("left out: no bus rate in the profile (bus_megabytes_per_second)"));
    notes.minimal.hostMs = 20;
    EXPECT_THAT(costText(notes),
                AllOf(HasSubstr("by host; the full"), HasSubstr("takes 20.00 ms for the frame")));
}

TEST(CostText, TellsNoTimeWhereTheChipHasNoRates) {
    const CostNotes notes{{.passes = {{}}, .missing = {"no fill rate in the profile (x)"}}, {}, {}};
    EXPECT_FALSE(notes.hasTimes());
    EXPECT_EQ(costText(notes), "No time by the model: no fill rate in the profile (x).\n");
    const auto json = toJson(notes);
    EXPECT_TRUE(json["ms"].is_null() && json["frames_per_second"].is_null() && json["limit"].is_null());
}

TEST(CostJson, HasTheTimesOfEachResource) {
    const auto pass = toJson(fiveMs().passes[0]);
    EXPECT_EQ(pass["ms"], 4.0);
    EXPECT_EQ(pass["limit"], "fill");
    EXPECT_EQ(pass["bytes"], 28);
    const auto frame = toJson(fiveMs());
    EXPECT_EQ(frame["ms"], 5.0);
    EXPECT_EQ(frame["frames_per_second"], 200.0);
    EXPECT_EQ(frame["limit"], "fill");
    EXPECT_EQ(frame["bytes"], 28);
}

TEST(MsText, IsADashForNoTime) {
    EXPECT_EQ(msText(0), "-");
    EXPECT_EQ(msText(0.126), "0.13");
    EXPECT_EQ(limitText({}), "-");
}

}  // namespace cost_notes_test
}  // namespace gnomon
