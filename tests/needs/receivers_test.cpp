#include "needs/receivers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "random_scenes.h"

namespace gnomon {
namespace receivers_test {

/// An affine function over the window through three of a patch's corners.
struct Over {
    glm::dvec3 normal{};
    glm::dvec3 base{};

    Over(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
        : normal(glm::cross(b - a, c - a)), base(a) {}
    double at(double x, double y) const {
        return base.z - (normal.x * (x - base.x) + normal.y * (y - base.y)) / normal.z;
    }
};

glm::dvec2 windowOf(const View& view, const glm::dvec3& direction) {
    return {(glm::dot(direction, view.right) / view.tanHalfX + 1) / 2 * view.width,
            (glm::dot(direction, view.up) / view.tanHalfY + 1) / 2 * view.height};
}

/// Whether the patch holds the point of the ray through (x, y) at 1 / @p inverse.
bool holds(const View& view, std::span<const Receivers::Corner> corners, double x, double y, double inverse) {
    std::vector<glm::dvec3> nearer;
    double farthest = corners[0].farther;
    for (const Receivers::Corner& c : corners) {
        nearer.emplace_back(windowOf(view, c.direction), c.nearer);
        farthest = std::min(farthest, c.farther);
    }
    const std::size_t n = nearer.size();
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec3 &a = nearer[i], &b = nearer[(i + 1) % n];
        if ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) < 0) return false;
    }
    return inverse <= Over(nearer[0], nearer[n / 3], nearer[2 * n / 3]).at(x, y) && inverse >= farthest;
}

TEST(Receivers, HoldAllThatMayBeSeen) {
    RandomScenes scenes(3);
    int several = 0, points = 0;
    for (int i = 0; i < 200; ++i) {
        const Scene scene = scenes.next();
        const View view = viewOf(scene.frames.front(), 44, 30);
        const SeenWindow window(scene, view, depthTies(24));
        const Receivers receivers(window);
        ASSERT_EQ(receivers.columns(), 6);
        ASSERT_EQ(receivers.rows(), 4);
        ASSERT_EQ(receivers.blocks().size(), 24u);
        for (int y = 0; y < view.height; ++y) {
            for (int x = 0; x < view.width; ++x) {
                const auto& block =
                    receivers.blocks()[std::size_t(y / Receivers::kBlock * 6 + x / Receivers::kBlock)];
                ASSERT_TRUE(block.pixels.holds(x, y));
                const auto all = window.at(std::size_t((view.height - 1 - y) * view.width + x));
                for (const Seen& seen : all) {
                    if (!seen.face) {
                        ASSERT_TRUE(block.seesBackground);
                        continue;
                    }
                    ASSERT_TRUE(block.seesSurface);
                    if (!seen.holds) continue;  // a possibility; the point itself may lie off its face
                    ++points;
                    // Where a rasteriser may see it instead, too.
                    for (const glm::dvec2 by : {glm::dvec2(0), glm::dvec2(1), glm::dvec2(1, -1)}) {
                        const glm::dvec2 beside = by * kSubpixel;
                        const double inverse = seen.inverse - glm::dot(seen.slope, beside) / view.nearPlane;
                        const double px = x + 0.5 + beside.x, py = y + 0.5 + beside.y;
                        const bool isHeld =
                            std::any_of(receivers.patches().begin(), receivers.patches().end(),
                                        [&](const Receivers::Patch& patch) {
                                            return patch.pixels.holds(x, y) &&
                                                   holds(view, receivers.corners(patch), px, py, inverse);
                                        });
                        // Off its face by less than the subpixel it may be nearer than the near plane.
                        ASSERT_TRUE(isHeld || inverse * view.nearPlane > 1) << i << ": " << x << " " << y;
                    }
                    const glm::dvec3 point = view.eye + rayDirection(view, x + 0.5, y + 0.5) / seen.inverse;
                    for (int k = 0; k < 3; ++k) {
                        ASSERT_GE(point[k], block.low[k]);
                        ASSERT_LE(point[k], block.high[k]);
                    }
                }
                several += all.size() > 1;
            }
        }
    }
    EXPECT_GT(points, 100'000);
    EXPECT_GT(several, 100);
}

TEST(Receivers, AreNearInOnePlaneThatIsNotBeforeTheNearPlane) {
    RandomScenes scenes(4);
    for (int i = 0; i < 200; ++i) {
        const Scene scene = scenes.next();
        const View view = viewOf(scene.frames.front(), 44, 30);
        const Receivers receivers{SeenWindow(scene, view, depthTies(16))};
        for (const Receivers::Patch& patch : receivers.patches()) {
            const auto corners = receivers.corners(patch);
            const std::size_t n = corners.size();
            ASSERT_GE(n, 4u);
            const auto at = [&](std::size_t k) {
                return glm::dvec3(windowOf(view, corners[k].direction), corners[k].nearer);
            };
            const Over plane(at(0), at(n / 3), at(2 * n / 3));
            for (std::size_t k = 0; k < n; ++k) {
                ASSERT_NEAR(plane.at(at(k).x, at(k).y), corners[k].nearer, 1e-9 * corners[k].nearer);
                ASSERT_LE(corners[k].nearer * view.nearPlane, 1 + 1e-15);
                ASSERT_LT(corners[k].farther, corners[k].nearer);
                ASSERT_GE(corners[k].farther, 0);
            }
        }
    }
}

TEST(Receivers, HaveAFlatBoxOnAFloorAndNoneOnTheBackground) {
    Scene scene;
    scene.objects = {floorOf(4)};
    scene.frames = {{.eye = {0.3f, 10, 0.2f}, .target = {0.3f, 0, 0.2f}, .up = {0, 0, -1}, .nearPlane = 1}};
    const View view = viewOf(scene.frames.front(), 64, 64);  // 0.129 units each
    const Receivers receivers{SeenWindow(scene, view, depthTies(24))};
    const Receivers::Block& middle = receivers.blocks()[4 * 8 + 4];
    EXPECT_TRUE(middle.seesSurface);
    EXPECT_NEAR(middle.low.y, 0, 1e-6);
    EXPECT_NEAR(middle.high.y, 0, 1e-6);
    // From its first pixel's centre to its last one's, and a little more.
    EXPECT_NEAR(middle.low.x, 0.3 + 0.5 * 0.1294, 0.003);
    EXPECT_NEAR(middle.high.x, 0.3 + 7.5 * 0.1294, 0.003);
    scene.objects.clear();
    const Receivers none{SeenWindow(scene, view, depthTies(24))};
    EXPECT_THAT(none.patches(), testing::IsEmpty());
    for (const Receivers::Block& block : none.blocks()) {
        EXPECT_FALSE(block.seesSurface);
        EXPECT_TRUE(block.seesBackground);
    }
}

}  // namespace receivers_test
}  // namespace gnomon
