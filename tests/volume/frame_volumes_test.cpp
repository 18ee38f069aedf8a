#include "volume/frame_volumes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "shapes.h"
#include "volume/near_cap.h"

namespace gnomon {
namespace {

/// A random caster, light and view; the eye is inside the volume in some, and most volumes leave the window.
struct RandomWorld {
    Scene scene;
    glm::vec4 light;
    View view;
};

RandomWorld randomWorld(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-4, 4);
    const auto point = [&] { return glm::vec3(place(random), place(random), place(random)); };
    RandomWorld world{.scene = sceneOf(blob(point(), 1.5f, 5, 7, 0.4f, seed)), .light = {}, .view = {}};
    world.light = seed % 3 == 0 ? glm::vec4(glm::normalize(point()), 0) : glm::vec4(2.0f * point(), 1);
    world.view =
        viewOf({.eye = 1.5f * point(), .target = point(), .fovDegrees = 60, .nearPlane = 0.3f}, 160, 120);
    return world;
}

std::vector<LitCaster> casterOf(const RandomWorld& world) {
    return litCasters(world.scene, world.light, Silhouette::Winding);
}

/// Triangles that cover the point (x, y) of the window (-1 to 1), those that are counter-clockwise as +1,
/// others as -1; nothing if an edge passes too close to the point to be sure.
std::optional<int> coverage(std::span<const glm::vec4> triangles, double x, double y) {
    int sum = 0;
    for (std::size_t i = 0; i + 3 <= triangles.size(); i += 3) {
        int inside = 0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec4 a = triangles[i + k], b = triangles[i + (k + 1) % 3];
            // (a x b) . (x, y, 1) in homogeneous window coordinates; each factor is at most of this size.
            const glm::dvec3 p(a.x, a.y, a.w), q(b.x, b.y, b.w), at(x, y, 1);
            const double value = glm::dot(glm::cross(p, q), at);
            if (std::abs(value) < 1e-5 * glm::length(p) * glm::length(q)) return std::nullopt;
            inside += value > 0 ? 1 : -1;
        }
        if (std::abs(inside) == 3) sum += inside / 3;
    }
    return sum;
}

TEST(FrameVolumes, LeaveOpenGlNothingToClip) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        const RandomWorld world = randomWorld(seed);
        for (const glm::vec4& p :
             frameVolumes(world.scene, casterOf(world), world.light, world.view, true).vertices) {
            ASSERT_LT(std::abs(p.x), p.w) << seed;
            ASSERT_LT(std::abs(p.y), p.w) << seed;
            ASSERT_LE(std::abs(p.z), p.w) << seed;
        }
    }
}

TEST(FrameVolumes, CoverInTheWindowWhatTheUncutFacesCover) {
    int compared = 0, covered = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const RandomWorld world = randomWorld(seed);
        const auto lit = casterOf(world);
        const FrameVolumes cut = frameVolumes(world.scene, lit, world.light, world.view, false);
        const NearCut uncut = cutAtNearPlane(world.scene, lit.at(0), world.light, world.view);
        for (int i = 0; i < 64; ++i) {
            // Pixel centres: the window is cut half way between the outermost of them and its edge.
            const double x = (2 * (i % 8) * 22 + 1) / 160.0 - 1, y = (2 * (i / 8) * 17 + 1) / 120.0 - 1;
            const auto before = coverage(uncut.fronts, x, y), behind = coverage(uncut.backs, x, y);
            const auto all = coverage(cut.vertices, x, y);
            if (!before || !behind || !all) continue;
            ASSERT_EQ(*all, *before + *behind) << seed << ": " << x << " " << y;
            ++compared;
            covered += *all != 0;
        }
    }
    EXPECT_GT(compared, 5000);
    EXPECT_GT(covered, 500);
}

TEST(FrameVolumes, HaveNoVolumeThatMissesTheWindow) {
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    const glm::vec4 light(0, 0, 20, 1);
    const auto lit = litCasters(scene, light, Silhouette::Winding);
    const View towards = viewOf({.eye = {6, 0, -5}, .target = {0, 0, -5}}, 64, 64);
    const View away = viewOf({.eye = {6, 0, -5}, .target = {12, 0, -5}}, 64, 64);
    EXPECT_EQ(frameVolumes(scene, lit, light, towards, false).size(), 1u);
    EXPECT_EQ(frameVolumes(scene, lit, light, away, false).size(), 0u);
}

TEST(FrameVolumes, OfSingleTrianglesAreOnePerLitTriangle) {
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    const glm::vec4 light(3, 4, 20, 1);
    const View view = viewOf({.eye = {2, 3, 30}, .target = {0, 0, 0}}, 64, 64);
    EXPECT_EQ(
        frameVolumes(scene, litCasters(scene, light, Silhouette::PerTriangle), light, view, false).size(),
        6u);
}

}  // namespace
}  // namespace gnomon
