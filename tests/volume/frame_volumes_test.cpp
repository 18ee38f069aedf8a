#include "volume/frame_volumes.h"

#include <gmock/gmock.h>

#include <cmath>

#include "coverage.h"
#include "cut_lists.h"
#include "shapes.h"

namespace gnomon {
namespace frame_volumes_test {

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

TEST(FrameVolumes, LeaveOpenGlNothingToClip) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        const RandomWorld world = randomWorld(seed);
        const FrameVolumes volumes =
            frameVolumes(world.scene, casterOf(world), world.light, world.view, kAllParts);
        for (int part = 0; part < kParts; ++part) {
            for (const glm::vec4& p : volumes.all(Part(part))) {
                ASSERT_LE(std::abs(p.x), p.w) << seed;
                ASSERT_LE(std::abs(p.y), p.w) << seed;
                ASSERT_LE(std::abs(p.z), p.w) << seed;
            }
        }
    }
}

TEST(FrameVolumes, CoverInTheWindowWhatTheUncutFacesCover) {
    int compared = 0, covered = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const RandomWorld world = randomWorld(seed);
        const auto lit = casterOf(world);
        const FrameVolumes cut = frameVolumes(world.scene, lit, world.light, world.view, kAllParts);
        const CutLists uncut = listsOf(world.scene, lit.at(0), world.light, world.view);
        for (int i = 0; i < 64; ++i) {
            // Pixel centres: the window is cut half way between the outermost of them and its edge.
            const double x = (2 * (i % 8) * 22 + 1) / 160.0 - 1, y = (2 * (i / 8) * 17 + 1) / 120.0 - 1;
            for (int part = 0; part < kParts; ++part) {
                // A near cap that misses the window is left out, and misses these points.
                const auto whole = coverage(uncut[Part(part)], x, y);
                const auto inWindow = coverage(cut.all(Part(part)), x, y);
                if (!whole || !inWindow) continue;
                ASSERT_EQ(*inWindow, *whole) << seed << ": " << x << " " << y << ", part " << part;
                ++compared;
                covered += *whole != 0;
            }
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
    EXPECT_EQ(frameVolumes(scene, lit, light, towards, Part::Sides | Part::FarCap).size(), 1u);
    EXPECT_EQ(frameVolumes(scene, lit, light, away, Part::Sides | Part::FarCap).size(), 0u);
}

TEST(FrameVolumes, OfSingleTrianglesAreOnePerLitTriangle) {
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    const glm::vec4 light(3, 4, 20, 1);
    const View view = viewOf({.eye = {2, 3, 30}, .target = {0, 0, 0}}, 64, 64);
    EXPECT_EQ(frameVolumes(scene, litCasters(scene, light, Silhouette::PerTriangle), light, view,
                           Part::Sides | Part::FarCap)
                  .size(),
              6u);
}

}  // namespace frame_volumes_test
}  // namespace gnomon
