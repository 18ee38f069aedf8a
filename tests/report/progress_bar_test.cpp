// The bar of a long run: its figures, its shape in terminals of all widths, and how often it is drawn.

#include "report/progress_bar.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon {
namespace progress_bar_test {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const ProgressState kHalf{{.done = 50, .all = 100, .failures = 2}, 12.5, 4.0};

TEST(ProgressBarState, RateAndTimeLeftAreThoseSinceTheStart) {
    ProgressBar bar("cells");
    EXPECT_EQ(bar.state({.all = 100}, 7).perSecond, 0);
    EXPECT_EQ(bar.state({.all = 100}, 9).secondsLeft, std::nullopt);
    const ProgressState state = bar.state({.done = 20, .all = 100, .failures = 1}, 17);
    EXPECT_EQ(state.progress.failures, 1u);
    EXPECT_DOUBLE_EQ(state.perSecond, 2);
    EXPECT_DOUBLE_EQ(state.secondsLeft.value(), 40);
    EXPECT_DOUBLE_EQ(bar.state({.done = 100, .all = 100}, 107).secondsLeft.value(), 0);
}

// A run that goes on from cells that are kept does not draw them at that rate.
TEST(ProgressBarState, CountsNoStepsThatWereDoneBefore) {
    ProgressBar bar("cells");
    bar.state({.done = 90, .all = 100}, 0);
    EXPECT_DOUBLE_EQ(bar.state({.done = 92, .all = 100}, 4).secondsLeft.value(), 16);
}

TEST(ProgressLine, HasBarCountRateTimeAndFailures) {
    EXPECT_EQ(progressLine(kHalf, "cells", 70),
              "[###########...........] 50 of 100 cells, 12.5/s, 0:04 left, 2 failed");
}

TEST(ProgressLine, BarsGrowWithWhatIsDone) {
    EXPECT_THAT(progressLine({{.done = 0, .all = 8}, 0, {}}, "cells", 40), StartsWith("[........"));
    EXPECT_THAT(progressLine({{.done = 8, .all = 8}, 1, 0.0}, "cells", 100),
                StartsWith(fmt::format("[{}] ", std::string(38, '#'))));
    EXPECT_THAT(progressLine({{.done = 0, .all = 0}, 0, {}}, "cells", 80), HasSubstr("#] 0 of 0"));
}

TEST(ProgressLine, TellsLongTimesInHours) {
    EXPECT_THAT(progressLine({{.done = 1, .all = 2}, 1, 59.2}, "cells", 100), HasSubstr(" 1:00 left"));
    EXPECT_THAT(progressLine({{.done = 1, .all = 2}, 1, 3725}, "cells", 100), HasSubstr(" 1:02:05 left"));
    EXPECT_THAT(progressLine({{.done = 1, .all = 2}, 1e-9, 1e99}, "cells", 100), HasSubstr("99:59:59 left"));
}

TEST(ProgressLine, LeavesOutWhatHasNoRoom) {
    EXPECT_EQ(progressLine(kHalf, "cells", 52), "50 of 100 cells, 12.5/s, 0:04 left, 2 failed");
    EXPECT_EQ(progressLine(kHalf, "cells", 44), "50 of 100 cells, 0:04 left, 2 failed");
    EXPECT_EQ(progressLine(kHalf, "cells", 30), "50 of 100 cells, 2 failed");
    EXPECT_EQ(progressLine(kHalf, "cells", 20), "50/100, 2 failed");
    EXPECT_EQ(progressLine(kHalf, "cells", 10), "50/100");
    EXPECT_EQ(progressLine(kHalf, "cells", 3), "");
}

TEST(ProgressLine, NeverFillsTheLastColumn) {
    for (std::size_t columns = 0; columns < 200; ++columns) {
        const std::size_t length = progressLine(kHalf, "cells", columns).size();
        EXPECT_LE(length, columns > 0 ? columns - 1 : 0) << columns;
    }
}

TEST(ProgressBar, IsDrawnAtMostTenTimesASecond) {
    ProgressBar bar("cells");
    int drawn = 0;
    for (std::size_t i = 0; i <= 2000; ++i)
        drawn += bar.draw({.done = i, .all = 2000}, double(i) * 0.001, 80).has_value();
    EXPECT_GE(drawn, 19);
    EXPECT_LE(drawn, 21);
}

TEST(ProgressBar, DrawsOverItselfAndIsTakenAway) {
    ProgressBar bar("cells");
    EXPECT_EQ(bar.clear(), "") << "nothing was drawn";
    const std::string text = bar.draw({.done = 1, .all = 2}, 0, 80).value();
    EXPECT_THAT(text, StartsWith("\r\x1b[K["));
    EXPECT_THAT(text, Not(HasSubstr("\n")));
    EXPECT_EQ(bar.clear(), "\r\x1b[K");
    EXPECT_EQ(bar.clear(), "");
}

TEST(ProgressBar, TakesEachNewWidthOfTheTerminal) {
    ProgressBar bar("cells");
    EXPECT_THAT(bar.draw({.done = 1, .all = 2}, 0, 80).value(), EndsWith("] 1 of 2 cells, 0 failed"));
    EXPECT_EQ(bar.draw({.done = 1, .all = 2}, 1, 16).value(), "\r\x1b[K1/2, 0 failed");
}

}  // namespace progress_bar_test
}  // namespace gnomon
