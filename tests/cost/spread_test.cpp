#include "cost/spread.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace spread_test {

TEST(Spread, OfOddManyFiguresIsTheOnesInTheirPlaces) {
    const Spread s = spreadOf({5, 1, 4, 2, 3});
    EXPECT_EQ(s.median, 3);
    EXPECT_EQ(s.low, 2);
    EXPECT_EQ(s.high, 4);
}

TEST(Spread, IsInterpolatedBetweenTwo) {
    const Spread s = spreadOf({1, 2, 3, 4});
    EXPECT_EQ(s.median, 2.5);
    EXPECT_EQ(s.low, 1.75);
    EXPECT_EQ(s.high, 3.25);
}

TEST(Spread, OfOneFigureIsThatFigureAndOfNoneNothing) {
    EXPECT_EQ(spreadOf({7}).low, 7);
    EXPECT_EQ(spreadOf({7}).high, 7);
    EXPECT_EQ(spreadOf({}).median, 0);
}

TEST(Ratios, AreOfTheSameRound) {
    EXPECT_EQ(ratios(std::vector<double>{2, 9}, std::vector<double>{1, 3}), (std::vector<double>{2, 3}));
}

}  // namespace spread_test
}  // namespace gnomon
