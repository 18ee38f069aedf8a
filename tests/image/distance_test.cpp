// Exact Euclidean distances against the definition.

#include "image/distance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace gnomon {
namespace distance_test {

using testing::Each;
using testing::ElementsAre;

/// The definition: the least over all pixels.
std::vector<std::int64_t> bruteForce(const std::vector<bool>& isIn, int width, int height) {
    std::vector<std::int64_t> all(isIn.size(), kNoDistance);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int v = 0; v < height; ++v)
                for (int u = 0; u < width; ++u)
                    if (isIn[std::size_t(v * width + u)]) {
                        auto& least = all[std::size_t(y * width + x)];
                        least = std::min<std::int64_t>(least, (x - u) * (x - u) + (y - v) * (y - v));
                    }
    return all;
}

TEST(SquaredDistances, AreThoseOfTheDefinition) {
    std::mt19937 random(7);
    for (int round = 0; round < 300; ++round) {
        const int width = 1 + int(random() % 23), height = 1 + int(random() % 23);
        // From a few pixels to half of them; in some rounds whole columns have none.
        const auto oneIn = 1 + random() % 60;
        std::vector<bool> isIn(std::size_t(width) * height);
        for (std::size_t i = 0; i < isIn.size(); ++i) isIn[i] = random() % oneIn == 0;
        ASSERT_EQ(squaredDistances(isIn, width, height), bruteForce(isIn, width, height)) << round;
    }
}

TEST(SquaredDistances, OfOnePixelAreThoseToIt) {
    EXPECT_THAT(squaredDistances({false, false, false, false, true, false}, 3, 2),
                ElementsAre(2, 1, 2, 1, 0, 1));
}

TEST(SquaredDistances, AreNoneToNothing) {
    EXPECT_THAT(squaredDistances(std::vector<bool>(12), 4, 3), Each(kNoDistance));
}

TEST(SquaredDistances, DoNotOverflowAlongAWideRow) {
    std::vector<bool> isIn(100'000);
    isIn[0] = true;
    EXPECT_EQ(squaredDistances(isIn, 100'000, 1).back(), std::int64_t(99'999) * 99'999);
    EXPECT_EQ(squaredDistances(isIn, 1, 100'000).back(), std::int64_t(99'999) * 99'999);
}

}  // namespace distance_test
}  // namespace gnomon
