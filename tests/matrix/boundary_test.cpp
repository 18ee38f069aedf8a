#include "matrix/boundary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace gnomon {
namespace boundary_test {

/// Lit and in shadow in blots: a pixel is as its left neighbour is, mostly.
Truth blots(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    Truth truth{.width = width, .height = height};
    for (int i = 0; i < width * height; ++i) {
        const bool changes = i == 0 || random() % 40 == 0;
        truth.shadow.push_back(changes ? Shadow(random() % 3) : truth.shadow.back());
    }
    return truth;
}

bool hasBothAround(const Truth& truth, int x, int y, int reach) {
    bool has[2]{};
    for (int v = std::max(0, y - reach); v <= std::min(truth.height - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(truth.width - 1, x + reach); ++u)
            has[truth.shadow[std::size_t(v) * truth.width + u] == Shadow::InShadow] = true;
    return has[0] && has[1];
}

// Widths on both sides of whole words; reaches of masks at scale 1, 1/2 and 1/4, and beyond a word.
TEST(Boundary, IsNearWhereBothClassesAreWithinReach) {
    int near = 0, far = 0;
    for (const int width : {1, 5, 63, 64, 65, 200}) {
        for (const int reach : {0, 1, 2, 4, 64, 150}) {
            const Truth truth = blots(width, 23, unsigned(width + reach));
            const Boundary boundary(truth, reach);
            for (int y = 0; y < truth.height; ++y) {
                for (int x = 0; x < width; ++x) {
                    const bool expected = hasBothAround(truth, x, y, reach);
                    ASSERT_EQ(boundary.isNear(x, y), expected)
                        << x << "," << y << " of " << width << " at " << reach;
                    ++(expected ? near : far);
                }
            }
        }
    }
    EXPECT_GT(near, 10000);
    EXPECT_GT(far, 5000);
}

}  // namespace boundary_test
}  // namespace gnomon
