// Differences of pictures that are known.

#include "image/difference.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon {
namespace difference_test {

Image grey(int width, int height, std::uint8_t value) {
    return {width, height, 3, std::vector<std::uint8_t>(std::size_t(width) * height * 3, value)};
}

TEST(MeanSquaredDifference, OfTheSamePictureIsZero) {
    EXPECT_EQ(meanSquaredDifference(grey(8, 4, 77), grey(8, 4, 77)), 0);
    EXPECT_TRUE(std::isinf(psnrOf(0)));
}

TEST(MeanSquaredDifference, IsTheSquareOfAnEqualOffset) {
    EXPECT_EQ(meanSquaredDifference(grey(8, 4, 100), grey(8, 4, 90)), 100);
    EXPECT_EQ(meanSquaredDifference(grey(8, 4, 90), grey(8, 4, 100)), 100);
    // Of 10 levels: 20 log10(25.5).
    EXPECT_NEAR(psnrOf(100), 28.1308, 1e-4);
}

TEST(MeanSquaredDifference, IsTheMeanOverPixelsAndChannels) {
    Image one = grey(4, 4, 0);
    one.data[5] = 255;
    const double mean = 255.0 * 255.0 / (4 * 4 * 3);
    EXPECT_DOUBLE_EQ(meanSquaredDifference(one, grey(4, 4, 0)), mean);
    // The whole range in each value is 0 dB.
    EXPECT_NEAR(psnrOf(meanSquaredDifference(grey(4, 4, 0), grey(4, 4, 255))), 0, 1e-4);
}

TEST(MeanSquaredDifference, TakesPixelsThatAreLeftOutForTheSame) {
    Image one = grey(4, 4, 0);
    one.data[5] = 255, one.data[9] = 255;
    std::vector<bool> leftOut(16);
    leftOut[1] = true;
    const double mean = 255.0 * 255.0 / (4 * 4 * 3);
    EXPECT_DOUBLE_EQ(meanSquaredDifference(one, grey(4, 4, 0), leftOut), mean);
    leftOut[3] = true;
    EXPECT_EQ(meanSquaredDifference(one, grey(4, 4, 0), leftOut), 0);
}

}  // namespace difference_test
}  // namespace gnomon
