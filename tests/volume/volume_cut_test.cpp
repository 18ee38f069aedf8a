// The parts of volumes: closed to the bit, counting what hides the eye, and lying on their surfaces.

#include "volume/volume_cut.h"

#include <gmock/gmock.h>

#include "balance.h"
#include "coverage.h"
#include "cut_lists.h"
#include "shapes.h"
#include "volume/blockers.h"
#include "volume/frame_volumes.h"
#include "volume/surface_cut.h"

namespace gnomon {
namespace volume_cut_test {

struct World {
    Scene scene{};
    glm::vec4 light{};
    View view{};
    std::vector<LitCaster> lit{};
};

/// A random closed mesh around or near the eye: the eye is in its volume in some, the mesh itself crosses the
/// near plane in some.
World randomWorld(unsigned seed, Silhouette silhouette = Silhouette::Winding, CapFaces caps = CapFaces::Lit) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    const auto point = [&] { return glm::vec3(coordinate(random), coordinate(random), coordinate(random)); };
    World w;
    w.scene = sceneOf(blob(0.9f * point(), 0.6f, 5, 6, 0.4f, seed));
    w.scene.objects[0].twoSided = seed % 5 == 0;
    w.light = seed % 3 == 0 ? glm::vec4(glm::normalize(point()), 0) : glm::vec4(2.0f * point(), 1);
    w.view =
        viewOf({.eye = point(), .target = 0.5f * point(), .fovDegrees = 70, .nearPlane = 0.2f}, 320, 240);
    w.lit = litCasters(w.scene, w.light, silhouette, caps);
    return w;
}

TEST(CutVolume, IsClosedToTheBitByItsFourParts) {
    int cut = 0;
    for (unsigned seed = 0; seed < 600; ++seed) {
        const World w = randomWorld(seed, seed % 7 ? Silhouette::Winding : Silhouette::PerTriangle,
                                    seed % 7 && seed % 2 ? CapFaces::Away : CapFaces::Lit);
        for (const LitCaster& caster : w.lit) {
            const CutLists lists = listsOf(w.scene, caster, w.light, w.view);
            Balance balance;
            for (const Part part : {Part::Sides, Part::FarCap, Part::NearCap, Part::LightCap})
                balance.add(lists[part]);
            ASSERT_EQ(balance.open([](const glm::vec4&) { return true; }), 0) << seed;
            cut += !lists[Part::NearCap].empty();
        }
    }
    EXPECT_GT(cut, 200);
}

TEST(CutVolume, NearFacesGoOnWhereTheOthersWereCut) {
    int cut = 0;
    for (unsigned seed = 0; seed < 300; ++seed) {
        const World w = randomWorld(seed);
        const CutLists lists = listsOf(w.scene, w.lit.at(0), w.light, w.view, kAllParts, {.flatten = false});
        Balance balance;
        for (const Part part : {Part::Sides, Part::LightCap, Part::NearFaces}) balance.add(lists[part]);
        ASSERT_EQ(balance.open([](const glm::vec4& p) { return p.w > 0 && p.z == -p.w; }), 0) << seed;
        for (const glm::vec4& p : lists[Part::NearFaces]) {
            ASSERT_GE(p.w, 0) << seed;
            ASSERT_LE(p.z, -p.w + 1e-6f) << seed;  // a cut next to infinity has z and w near 0
        }
        cut += !lists[Part::NearFaces].empty();
    }
    EXPECT_GT(cut, 100);
}

TEST(CutVolume, FlattensNearFacesOntoTheNearPlane) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        const World w = randomWorld(seed);
        const CutLists lists = listsOf(w.scene, w.lit.at(0), w.light, w.view);
        for (const glm::vec4& p : lists[Part::NearFaces]) ASSERT_EQ(p.z, -p.w) << seed;
    }
}

TEST(CutVolume, NearFacesLeadFromTheEyesCountToTheNearPlanes) {
    int compared = 0, inside = 0;
    for (unsigned seed = 0; seed < 400; ++seed) {
        const World w = randomWorld(seed);
        const int atEye = holdingEye(w.scene, w.lit, w.light, w.view.eye);
        const FrameVolumes volumes = frameVolumes(w.scene, w.lit, w.light, w.view, kAllParts);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> coordinate(-0.99, 0.99);
        for (int i = 0; i < 20; ++i) {
            const double x = coordinate(random), y = coordinate(random);
            const auto near = coverage(volumes.all(Part::NearFaces), x, y);
            const auto cap = coverage(volumes.all(Part::NearCap), x, y);
            if (!near || !cap) continue;
            ASSERT_EQ(atEye + *near, *cap) << seed << ": " << x << " " << y << " light " << w.light.w
                                           << " at eye " << atEye << " near " << *near;
            ++compared;
            inside += atEye != 0 && *near != 0;
        }
    }
    EXPECT_GT(compared, 5000);
    EXPECT_GT(inside, 50);
}

TEST(EyeBlockers, CoverTheirPixelAsOftenAsVolumesHoldTheEye) {
    int held = 0;
    for (unsigned seed = 0; seed < 500; ++seed) {
        const World w = randomWorld(seed, seed % 2 ? Silhouette::Winding : Silhouette::PerTriangle);
        const int expected = holdingEye(w.scene, w.lit, w.light, w.view.eye);
        const auto seen = coverage(eyeBlockers(w.scene, w.lit, w.light, w.view.eye), 0.11, 0.07);
        if (!seen) continue;
        // Any point of the pixel is as good, and no diagonal of a square passes through this one. The view
        // from the light sees lit triangles from their front, the window's y grows to either side.
        ASSERT_EQ(std::abs(*seen), expected) << seed;
        held += expected;
    }
    EXPECT_GT(held, 50);
}

// A directional light gives the view no length of its own: its pixel must shrink with the scene, or all
// casters fall into it. Powers of two leave every bit of the arithmetic as it is.
TEST(EyeBlockers, OfADirectionalLightAreTheSameAtAnyScale) {
    int held = 0;
    for (unsigned seed = 0; seed < 600; seed += 3) {
        const World w = randomWorld(seed);
        ASSERT_EQ(w.light.w, 0);
        const auto expected = eyeBlockers(w.scene, w.lit, w.light, w.view.eye);
        for (const float scale : {0x1p-30f, 0x1p30f}) {
            Scene scaled = w.scene;
            for (glm::vec3& p : scaled.objects[0].mesh.positions) p *= scale;
            const auto lit = litCasters(scaled, w.light, Silhouette::Winding);
            const glm::dvec3 eye = double(scale) * w.view.eye;
            ASSERT_TRUE(eyeBlockers(scaled, lit, w.light, eye) == expected) << seed << " times " << scale;
            ASSERT_EQ(holdingEye(scaled, lit, w.light, eye), holdingEye(w.scene, w.lit, w.light, w.view.eye))
                << seed << " times " << scale;
        }
        held += !expected.empty();
    }
    EXPECT_GT(held, 20);
}

TEST(EyeBlockers, AreNoneForAnEyeAtTheLight) {
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    const glm::vec4 light(3, 0, 0, 1);
    const auto lit = litCasters(scene, light, Silhouette::Winding);
    EXPECT_THAT(eyeBlockers(scene, lit, light, {3, 0, 0}), testing::IsEmpty());
    EXPECT_EQ(holdingEye(scene, lit, light, {3, 0, 0}), 0);
}

TEST(HoldingEye, CountsATriangleOnceWhereTheSegmentMeetsTheEdgeOfTwo) {
    // The segment from the eye to the light passes through the diagonal of the cube's lit face.
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    const glm::vec4 light(9, 0, 0, 1);
    const auto lit = litCasters(scene, light, Silhouette::Winding);
    EXPECT_EQ(holdingEye(scene, lit, light, {-9, 0, 0}), 1);
    // Through one of its corners, and past it.
    const glm::vec3 corner = scene.objects[0].mesh.positions[lit.at(0).lit.at(0).x];
    const glm::dvec3 behind = glm::dvec3(corner) + (glm::dvec3(corner) - glm::dvec3(light));
    EXPECT_LE(holdingEye(scene, lit, light, behind), 1);
    EXPECT_EQ(holdingEye(scene, lit, light, {-9, 9, 0}), 0);
}

TEST(OnVolumeFace, IsAnEyeInACapOrASideAndNoOther) {
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    const glm::vec4 light(0, 9, 0, 1);
    const auto lit = litCasters(scene, light, Silhouette::Winding);
    float top = -9, right = -9;
    for (const glm::vec3& p : scene.objects[0].mesh.positions) {
        top = std::max(top, p.y);
        right = std::max(right, p.x);
    }
    const auto isOn = [&](const glm::dvec3& eye) { return onVolumeFace(scene, lit, light, eye); };
    EXPECT_TRUE(isOn({0.1, top, 0.2}));
    EXPECT_FALSE(isOn({0.1, top + 0.01, 0.2}));
    EXPECT_FALSE(isOn({0.11, top - 0.01, 0.2}));
    // On the ray from the light through an edge of the lit face.
    EXPECT_TRUE(isOn(glm::dvec3(0, 9, 0) + 2.0 * (glm::dvec3(right, top, 0.25) - glm::dvec3(0, 9, 0))));
}

TEST(CutVolume, LightCapsAreTheirSurfacesToTheBit) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        const World w = randomWorld(seed);
        SurfaceCut surface(w.scene.objects[0].mesh, w.view);
        const FrameVolumes volumes = frameVolumes(w.scene, w.lit, w.light, w.view, Part::LightCap);
        std::vector<glm::vec4> expected;
        for (const LitCaster& caster : w.lit)
            for (const glm::uvec3& t : caster.lit)
                for (const SurfacePoint& p : surface.triangles(t)) expected.push_back(p.position);
        ASSERT_EQ(
            std::vector<glm::vec4>(volumes.all(Part::LightCap).begin(), volumes.all(Part::LightCap).end()),
            expected)
            << seed;
    }
}

TEST(SurfaceCut, WeightsGiveThePositionsBack) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        const World w = randomWorld(seed);
        const Mesh& mesh = w.scene.objects[0].mesh;
        const glm::dmat4 clip = clipFromEye(w.view) * eyeFromWorld(w.view);
        SurfaceCut surface(mesh, w.view);
        for (const glm::uvec3& t : mesh.triangles) {
            for (const SurfacePoint& p : surface.triangles(t)) {
                glm::dvec3 world(0);
                for (int k = 0; k < 3; ++k) world += p.weights[k] * glm::dvec3(mesh.positions[t[k]]);
                const glm::dvec4 at = clip * glm::dvec4(world, 1);
                ASSERT_NEAR(at.x, p.position.x, 1e-5);
                ASSERT_NEAR(at.y, p.position.y, 1e-5);
                ASSERT_NEAR(at.w, p.position.w, 1e-5);
            }
        }
    }
}

TEST(Canonical, IsOneTriangleForAllRotationsAndWindings) {
    const glm::uvec3 t(7, 3, 5);
    for (int k = 0; k < 3; ++k) {
        const glm::uvec3 turned(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
        const glm::uvec3 flipped(turned.y, turned.x, turned.z);
        EXPECT_EQ(canonical(turned).triangle, glm::uvec3(3, 5, 7));
        EXPECT_EQ(canonical(flipped).triangle, glm::uvec3(3, 5, 7));
        EXPECT_FALSE(canonical(turned).reversed);
        EXPECT_TRUE(canonical(flipped).reversed);
    }
}

TEST(CutVolume, StartsBehindItsCasterByTheOffset) {
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    const glm::vec4 light(0, 1, 0, 0);
    const auto lit = litCasters(scene, light, Silhouette::Winding);
    const View view = viewOf({.eye = {0, 0, 9}, .target = {0, 0, 0}}, 64, 64);
    const auto top = [&](float offset) {
        double y = -1e9;
        const CutLists lists = listsOf(scene, lit.at(0), light, view, Part::LightCap, {.offset = offset});
        for (const glm::vec4& p : lists[Part::LightCap]) y = std::max(y, double(p.y));
        return y;
    };
    EXPECT_NEAR(top(0) - top(0.25f), 0.25 / view.tanHalfY, 1e-5);
}

TEST(CutVolume, AtTheEyeLeavesNothingBehindIt) {
    int behind = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
        const World w = randomWorld(seed);
        const auto sides = [&](Clip clip) -> std::vector<glm::vec4> {
            return listsOf(w.scene, w.lit.at(0), w.light, w.view, Part::Sides, {.clip = clip})[Part::Sides];
        };
        for (const glm::vec4& p : sides(Clip::Eye)) ASSERT_GE(p.w, 0) << seed;
        for (const glm::vec4& p : sides(Clip::None)) behind += p.w < 0;
    }
    EXPECT_GT(behind, 0);
}

}  // namespace volume_cut_test
}  // namespace gnomon
