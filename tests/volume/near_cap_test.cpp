#include "volume/near_cap.h"

#include <gmock/gmock.h>

#include <array>
#include <bit>
#include <cstdlib>
#include <map>
#include <random>

#include "balance.h"
#include "cut_lists.h"
#include "shapes.h"
#include "volume/orient.h"

namespace gnomon {
namespace near_cap_test {

using ::testing::IsEmpty;

/// What z-pass draws: the light cap is left open.
constexpr std::array kOpenVolume{Part::Sides, Part::FarCap, Part::NearCap};
constexpr std::array kClosedVolume{Part::Sides, Part::FarCap, Part::NearCap, Part::LightCap};

struct Case {
    Scene scene{};
    glm::vec4 light{};
    View view{};
    LitCaster lit{};
};

/// A random closed mesh near the eye, with the light so that its volumes often reach the near plane.
Case randomCase(unsigned seed, Silhouette silhouette = Silhouette::Winding) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    const auto point = [&] { return glm::vec3(coordinate(random), coordinate(random), coordinate(random)); };
    Case c;
    c.scene = sceneOf(blob(0.7f * point(), 0.6f, 5, 6, 0.4f, seed));
    c.scene.objects[0].twoSided = seed % 5 == 0;
    c.light = seed % 3 == 0 ? glm::vec4(glm::normalize(point()), 0) : glm::vec4(2.0f * point(), 1);
    c.view = viewOf(
        {.eye = point(), .target = 0.5f * point(), .fovDegrees = 70, .nearPlane = seed % 2 ? 0.2f : 0.01f},
        320, 240);
    c.lit = litCaster(c.scene, casters(c.scene)[0], c.light, silhouette);
    return c;
}

bool crossesNearPlane(const Case& c) {
    const auto& positions = c.scene.objects[0].mesh.positions;
    const auto beyond = [&](const glm::vec3& p) {
        return glm::dot(glm::dvec3(p) - c.view.eye, c.view.forward) >= c.view.nearPlane;
    };
    return std::any_of(positions.begin(), positions.end(), beyond) !=
           std::all_of(positions.begin(), positions.end(), beyond);
}

TEST(CutVolume, ClosesTheVolumeToTheBit) {
    int cut = 0;
    for (unsigned seed = 0; seed < 600; ++seed) {
        const Case c = randomCase(seed, seed % 7 ? Silhouette::Winding : Silhouette::PerTriangle);
        if (crossesNearPlane(c))
            continue;  // there, the light cap that is left out has edges in the plane, too
        const CutLists near = listsOf(c.scene, c.lit, c.light, c.view);
        Balance balance;
        for (const Part part : kOpenVolume) balance.add(near[part]);
        ASSERT_EQ(balance.open([](const glm::vec4& p) { return p.z == -p.w; }), 0) << seed;
        cut += !near[Part::NearCap].empty();
    }
    EXPECT_GT(cut, 100);
}

TEST(CutVolume, IsClosedWithItsLightCapWhereTheMeshCrossesThePlane) {
    int cut = 0;
    for (unsigned seed = 0; seed < 600; ++seed) {
        const Case c = randomCase(seed);
        if (!crossesNearPlane(c)) continue;
        const CutLists near = listsOf(c.scene, c.lit, c.light, c.view);
        Balance balance;
        for (const Part part : kOpenVolume) balance.add(near[part]);

        // What stays open is the line in which the lit triangles themselves meet the near plane.
        const auto& mesh = c.scene.objects[0].mesh;
        const glm::dmat4 clip = clipFromEye(c.view) * eyeFromWorld(c.view);
        int litCut = 0;
        for (const glm::uvec3& t : c.lit.lit) {
            int beyond = 0;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec4 p = clip * glm::dvec4(mesh.positions[t[k]], 1);
                beyond += p.z + p.w >= 0;
            }
            litCut += beyond == 1 || beyond == 2;
        }
        ASSERT_EQ(balance.open([](const glm::vec4& p) { return p.z == -p.w; }), litCut) << seed;
        cut += litCut > 0;
    }
    EXPECT_GT(cut, 100);
}

TEST(CutVolume, LeavesNothingBeforeThePlane) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        const Case c = randomCase(seed);
        const CutLists near = listsOf(c.scene, c.lit, c.light, c.view);
        for (const Part part : kClosedVolume) {
            for (const glm::vec4& p : near[part]) {
                ASSERT_GE(p.z, -p.w);
                ASSERT_GE(p.w, 0);
            }
        }
        for (const glm::vec4& p : near[Part::NearCap]) ASSERT_EQ(p.z, -p.w);
    }
}

/// +1 where the homogeneous triangle covers (x, y) counter-clockwise, -1 clockwise, 0 outside. Sets @p margin
/// to the least distance from an edge's line that was seen.
int covers(const glm::vec4* t, const glm::dvec2& q, double& margin) {
    const glm::dvec3 p[3] = {{t[0].x, t[0].y, t[0].w}, {t[1].x, t[1].y, t[1].w}, {t[2].x, t[2].y, t[2].w}};
    int positive = 0;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 line = glm::cross(p[k], p[(k + 1) % 3]);
        const double d = glm::dot(line, glm::dvec3(q, 1)), size = glm::length(line);
        if (size > 0) margin = std::min(margin, std::abs(d) / size);
        positive += d > 0;
    }
    const double area = glm::dot(glm::cross(p[0], p[1]), p[2]);
    return positive == 3 && area > 0 ? 1 : positive == 0 && area < 0 ? -1 : 0;
}

/// How many lit triangles the segment from @p q to the light crosses; all in double precision.
int crossings(const Case& c, const glm::dvec3& q) {
    const auto& positions = c.scene.objects[0].mesh.positions;
    int count = 0;
    for (const glm::uvec3& t : c.lit.lit) {
        const glm::dvec3 p[3] = {positions[t.x], positions[t.y], positions[t.z]};
        if (orientation(p[0], p[1], p[2], q) >= 0) continue;
        int inside = 0;
        for (int k = 0; k < 3; ++k) inside += orientation(p[k], p[(k + 1) % 3], q, glm::dvec4(c.light)) < 0;
        count += inside == 0;
    }
    return count;
}

TEST(CutVolume, CapCountsTheTrianglesThatHideThePlaneFromTheLight) {
    int covered = 0;
    for (unsigned seed = 0; seed < 300; ++seed) {
        const Case c = randomCase(seed, seed % 2 ? Silhouette::Winding : Silhouette::PerTriangle);
        const CutLists near = listsOf(c.scene, c.lit, c.light, c.view);
        const bool touches = touchesNearRectangle(c.scene, c.lit, c.light, c.view);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> coordinate(-1, 1);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec2 q(coordinate(random), coordinate(random));
            double margin = 1;
            int count = 0;
            for (std::size_t t = 0; t < near[Part::NearCap].size(); t += 3)
                count += covers(&near[Part::NearCap][t], q, margin);
            if (margin < 1e-5) continue;  // float vertices
            const glm::dvec3 world =
                c.view.eye + c.view.nearPlane * (c.view.forward + q.x * c.view.tanHalfX * c.view.right +
                                                 q.y * c.view.tanHalfY * c.view.up);
            ASSERT_EQ(count, crossings(c, world)) << seed << " " << q.x << " " << q.y;
            if (count != 0) {
                ASSERT_TRUE(touches) << seed;
            }
            covered += count != 0;
        }
    }
    EXPECT_GT(covered, 1000);
}

TEST(CutVolume, FacesAlongARayCountTheShadow) {
    // Before every point of the eye ray: cap + fronts - backs = lit triangles between the point and the
    // light. At infinity nothing is left but the light caps that the ray crosses.
    int counted = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Case c = randomCase(seed);
        if (crossesNearPlane(c)) continue;
        const CutLists near = listsOf(c.scene, c.lit, c.light, c.view);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> coordinate(-1, 1);
        const auto& positions = c.scene.objects[0].mesh.positions;
        for (int i = 0; i < 50; ++i) {
            const glm::dvec2 q(coordinate(random), coordinate(random));
            double margin = 1;
            int count = 0;
            for (const Part part : kOpenVolume) {
                for (std::size_t t = 0; t < near[part].size(); t += 3)
                    count += covers(&near[part][t], q, margin);
            }
            const glm::dvec3 d =
                c.view.forward + q.x * c.view.tanHalfX * c.view.right + q.y * c.view.tanHalfY * c.view.up;
            int caps = 0;
            for (const glm::uvec3& t : c.lit.lit) {
                const glm::dvec3 p[3] = {positions[t.x], positions[t.y], positions[t.z]};
                int side = 0;
                for (int k = 0; k < 3; ++k)
                    side += orientation(p[k], p[(k + 1) % 3], c.view.eye, glm::dvec4(d, 0));
                if (std::abs(side) != 3) continue;
                // A crossing beyond the near plane; the mesh lies on one side of it.
                if (glm::dot(p[0] - c.view.eye, c.view.forward) < c.view.nearPlane) continue;
                caps += side < 0 ? 1 : -1;
            }
            if (margin < 1e-5) continue;
            ASSERT_EQ(count + caps, 0) << seed;
            counted += caps != 0;
        }
    }
    EXPECT_GT(counted, 500);
}

TEST(TouchesNearRectangle, KeepsTwoPixelsOfMargin) {
    // A square that hides part of the near plane, seen head on; its shadow's edge stands x pixels beside the
    // image.
    const View view =
        viewOf({.eye = {0, 0, 0}, .target = {0, 0, -1}, .fovDegrees = 90, .nearPlane = 1}, 100, 100);
    const auto touches = [&](double pixels) {
        const auto x = static_cast<float>(1 + pixels * 0.02);
        Scene scene = sceneOf({.positions = {{x, -1, 1}, {x + 1, -1, 1}, {x + 1, 1, 1}, {x, 1, 1}},
                               .triangles = {{0, 1, 2}, {0, 2, 3}}});
        const glm::vec4 light(0, 0, 1, 0);
        return touchesNearRectangle(scene, litCaster(scene, casters(scene)[0], light, Silhouette::Winding),
                                    light, view);
    };
    EXPECT_TRUE(touches(-1));
    EXPECT_TRUE(touches(1.99));
    EXPECT_FALSE(touches(4));
}

TEST(TouchesNearRectangle, RejectsWhatLiesBeyond) {
    const View view = viewOf({}, 320, 240);
    Scene scene = sceneOf(cube({0, 0, -2}, 1));
    for (const glm::vec4 light : {glm::vec4(0, 10, 0, 1), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 9, 1)}) {
        const LitCaster lit = litCaster(scene, casters(scene)[0], light, Silhouette::Winding);
        EXPECT_FALSE(touchesNearRectangle(scene, lit, light, view));
    }
    const glm::vec4 behind(0, 0, -9, 1);
    EXPECT_TRUE(touchesNearRectangle(scene, litCaster(scene, casters(scene)[0], behind, Silhouette::Winding),
                                     behind, view));
}

TEST(CutVolume, TakesALightInTheNearPlane) {
    const View view = viewOf({.eye = {0, 0, 0}, .target = {0, 0, -1}, .nearPlane = 1}, 100, 100);
    Scene scene = sceneOf(cube({0, 3, -1}, 1));
    for (const glm::vec4 light : {glm::vec4(0, 9, -1, 1), glm::vec4(0, 1, 0, 0)}) {
        const LitCaster lit = litCaster(scene, casters(scene)[0], light, Silhouette::Winding);
        EXPECT_TRUE(touchesNearRectangle(scene, lit, light, view));
        const CutLists near = listsOf(scene, lit, light, view);
        double margin = 1;
        int count = 0;
        for (std::size_t t = 0; t < near[Part::NearCap].size(); t += 3)
            count += covers(&near[Part::NearCap][t], {0.123, 0.1}, margin);
        EXPECT_EQ(count, 1);
    }
}

}  // namespace near_cap_test
}  // namespace gnomon
