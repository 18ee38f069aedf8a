// The scenes that come with gnomon keep what their headers promise.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scene/load.h"
#include "scene/view.h"
#include "tools.h"

namespace gnomon {
namespace shipped_scenes_test {

const std::filesystem::path kScenes = std::filesystem::path(GNOMON_SOURCE) / "scenes";

Scene shipped(const std::string& id) {
    return loadScene(findScene(id, kScenes));
}

struct Corners {
    glm::dvec3 a, b, c;
};

std::vector<Corners> cornersOf(const Object& object) {
    std::vector<Corners> out;
    const auto at = [&](unsigned v) { return glm::dvec3(object.mesh.positions[v]); };
    for (const glm::uvec3& t : object.mesh.triangles) out.push_back({at(t.x), at(t.y), at(t.z)});
    return out;
}

/// Parameter at which the ray from @p origin meets the triangle, infinite if it doesn't (Moeller and Trumbore
/// 1997).
double meet(const glm::dvec3& origin, const glm::dvec3& direction, const Corners& t) {
    constexpr double kMiss = std::numeric_limits<double>::infinity();
    const glm::dvec3 e1 = t.b - t.a, e2 = t.c - t.a, p = glm::cross(direction, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0) return kMiss;
    const glm::dvec3 s = origin - t.a, q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1) return kMiss;
    const double along = glm::dot(e2, q) / determinant;
    return along > 0 ? along : kMiss;
}

/// Casting objects that @p point does not see the light for.
int castersAbove(const Scene& scene, const glm::dvec3& point) {
    const glm::dvec3 toLight = glm::dvec3(scene.lights[0].position) - point;
    int count = 0;
    for (const Object& object : scene.objects) {
        if (!object.casts) continue;
        const auto triangles = cornersOf(object);
        count += std::any_of(triangles.begin(), triangles.end(),
                             [&](const Corners& t) { return meet(point, toLight, t) < 1; });
    }
    return count;
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, HasAPointLightAboveEverythingAndAnOrbitOfSixtyFrames) {
    const Scene scene = shipped(GetParam());
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].position.w, 1);
    for (const Object& object : scene.objects)
        for (const glm::vec3& p : object.mesh.positions) EXPECT_LT(p.y, scene.lights[0].position.y);
    EXPECT_EQ(scene.frames.size(), 60u);
    EXPECT_TRUE(scene.notes.empty());
    EXPECT_FALSE(scene.title.empty());
}

// 5 x 5 points of the near rectangle of a square image, and the eye.
TEST_P(ShippedScene, KeepsEyeAndNearRectangleOutsideOfAllShadowVolumes) {
    const Scene scene = shipped(GetParam());
    for (std::size_t f = 0; f < scene.frames.size(); ++f) {
        const View view = viewOf(scene.frames[f], 4, 4);
        EXPECT_EQ(castersAbove(scene, view.eye), 0) << "frame " << f;
        for (int y = 0; y <= 4; ++y)
            for (int x = 0; x <= 4; ++x)
                EXPECT_EQ(castersAbove(scene, view.eye + view.nearPlane * rayDirection(view, x, y)), 0)
                    << "frame " << f;
    }
}

TEST_P(ShippedScene, KeepsEverythingBehindTheNearPlane) {
    const Scene scene = shipped(GetParam());
    for (const Camera& camera : scene.frames) {
        const View view = viewOf(camera, 4, 4);
        for (const Object& object : scene.objects)
            for (const Corners& t : cornersOf(object))
                for (int y = 0; y <= 4; ++y)
                    for (int x = 0; x <= 4; ++x)
                        ASSERT_GT(meet(view.eye, rayDirection(view, x, y), t), 3 * view.nearPlane);
    }
}

TEST_P(ShippedScene, HasNeitherEyeNorLightInThePlaneOfAFaceInFrameZero) {
    const Scene scene = shipped(GetParam());
    for (const Object& object : scene.objects)
        for (const Corners& t : cornersOf(object)) {
            const glm::dvec3 normal = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
            for (const glm::dvec3 p : {glm::dvec3(scene.lights[0].position), glm::dvec3(scene.frames[0].eye)})
                EXPECT_GT(std::abs(glm::dot(normal, p - t.a)), 1e-4) << object.name;
        }
}

TEST_P(ShippedScene, ShowsBackgroundAtTheTopInMostFrames) {
    const Scene scene = shipped(GetParam());
    int frames = 0;
    for (const Camera& camera : scene.frames) {
        const View view = viewOf(camera, 64, 64);
        int background = 0;
        for (int x = 0; x < 64; ++x) {
            bool hit = false;
            for (const Object& object : scene.objects)
                for (const Corners& t : cornersOf(object))
                    hit = hit || std::isfinite(meet(view.eye, rayDirection(view, x + 0.5, 63.5), t));
            background += !hit;
        }
        frames += background > 16;
    }
    EXPECT_GT(frames, 45);
}

TEST_P(ShippedScene, HasClosedCastersAndOneSidedFloor) {
    const Scene scene = shipped(GetParam());
    for (const Object& object : scene.objects) {
        if (object.casts && !object.twoSided) {
            EXPECT_EQ(openEdges(object.mesh), 0) << object.name;
            EXPECT_GT(signedVolume(object.mesh), 0) << object.name;
        }
        EXPECT_EQ(object.casts, object.name != "floor");
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, testing::ValuesIn(sceneIds(kScenes)),
                         [](const auto& test) { return test.param; });

TEST(ShippedScenes, AreTheThreeThatWeDescribe) {
    EXPECT_THAT(sceneIds(kScenes), testing::ElementsAre("boxes", "knot", "roettger"));
}

TEST(Boxes, ThrowShadowsThatOverlapTwiceAndMore) {
    const Scene scene = shipped("boxes");
    int most = 0, twice = 0;
    for (double z = -6; z <= 6; z += 0.1)
        for (double x = -6; x <= 6; x += 0.1) {
            const int count = castersAbove(scene, {x, 0, z});
            most = std::max(most, count);
            twice += count >= 2;
        }
    EXPECT_GE(most, 3);
    EXPECT_GT(twice, 100) << "hundredths of a unit square";
}

// Two convex shapes with a face's plane between them are apart.
TEST(Boxes, DoNotTouchOneAnother) {
    const Scene scene = shipped("boxes");
    const auto parted = [](const Object& a, const Object& b, const glm::dvec3& axis) {
        if (glm::length(axis) < 1e-9) return false;
        const auto range = [&](const Object& object) {
            glm::dvec2 r(1e9, -1e9);
            for (const glm::vec3& p : object.mesh.positions) {
                const double at = glm::dot(glm::normalize(axis), glm::dvec3(p));
                r = {std::min(r.x, at), std::max(r.y, at)};
            }
            return r;
        };
        const glm::dvec2 ra = range(a), rb = range(b);
        return ra.y + 0.01 < rb.x || rb.y + 0.01 < ra.x;
    };
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        for (std::size_t j = i + 1; j < scene.objects.size(); ++j) {
            const Object &a = scene.objects[i], &b = scene.objects[j];
            bool apart = false;
            for (const Object* object : {&a, &b})
                for (const Corners& t : cornersOf(*object))
                    apart = apart || parted(a, b, glm::cross(t.b - t.a, t.c - t.a));
            EXPECT_TRUE(apart) << a.name << ", " << b.name;
        }
}

/// Whether the ray passes three fronts of the silhouette's shadow volume (+1) before its first back (-1), in
/// front of whatever surface it meets first.
bool threeFrontsFirst(const glm::dvec3& eye, const glm::dvec3& direction, const std::vector<Corners>& sides,
                      double surface) {
    std::vector<std::pair<double, int>> crossings;
    const auto cross = [&](const Corners& t) {
        const double at = meet(eye, direction, t);
        if (at >= surface) return;
        const bool front = glm::dot(glm::cross(t.b - t.a, t.c - t.a), direction) < 0;
        crossings.emplace_back(at, front ? 1 : -1);
    };
    for (const Corners& t : sides) cross(t);
    std::sort(crossings.begin(), crossings.end());
    return crossings.size() >= 3 && crossings[0].second == 1 && crossings[1].second == 1 &&
           crossings[2].second == 1;
}

TEST(Knot, HasPixelsWithThreeFrontsBeforeABackInFrameZero) {
    const Scene scene = shipped("knot");
    const auto knot = std::find_if(scene.objects.begin(), scene.objects.end(),
                                   [](const Object& object) { return object.casts; });
    const glm::dvec3 light(scene.lights[0].position);

    // Silhouette edges as their lit triangle walks them; the sides hang from them, wound the other way.
    std::map<std::pair<unsigned, unsigned>, bool> lit;
    const auto at = [&](unsigned v) { return glm::dvec3(knot->mesh.positions[v]); };
    for (const glm::uvec3& t : knot->mesh.triangles) {
        const glm::dvec3 normal = glm::cross(at(t.y) - at(t.x), at(t.z) - at(t.x));
        for (int k = 0; k < 3; ++k) lit[{t[k], t[(k + 1) % 3]}] = glm::dot(normal, light - at(t.x)) > 0;
    }
    constexpr double kFar = 1000;
    std::vector<Corners> sides;
    for (const auto& [edge, isLit] : lit) {
        if (!isLit || lit.at({edge.second, edge.first})) continue;
        const glm::dvec3 from = at(edge.first), to = at(edge.second);
        const glm::dvec3 fromFar = from + kFar * (from - light), toFar = to + kFar * (to - light);
        sides.push_back({to, from, fromFar});
        sides.push_back({to, fromFar, toFar});
    }

    constexpr int kSize = 128;
    const View view = viewOf(scene.frames[0], kSize, kSize);
    int pixels = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const glm::dvec3 direction = rayDirection(view, x + 0.5, y + 0.5);
            double surface = std::numeric_limits<double>::infinity();
            for (const Object& object : scene.objects)
                for (const Corners& t : cornersOf(object))
                    surface = std::min(surface, meet(view.eye, direction, t));
            pixels += threeFrontsFirst(view.eye, direction, sides, surface);
        }
    EXPECT_GT(pixels, 10) << "of " << kSize * kSize;
}

}  // namespace shipped_scenes_test
}  // namespace gnomon
