// What all rays cross, held against the tracer: it knows nothing of volumes, and must come to the same.

#include "predict/crossings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "scene/primitives.h"
#include "scene/view.h"
#include "truth/scenes.h"

namespace gnomon {
namespace crossings_test {

constexpr int kWidth = 72, kHeight = 54;

struct Compared {
    int pixels = 0, blocked = 0, most = 0, different = 0;
};

/// Holds what the volumes of all crossings say against truth, in every pixel that truth does not tie. An eye
/// in a volume is no exception: the near caps count.
Compared compared(const Scene& scene, Silhouette silhouette) {
    Compared out;
    const Light& light = scene.lights.front();
    const View view = viewOf(scene.frames.front(), kWidth, kHeight);
    const DepthTies ties = depthTies(24);
    const Truth truth = Tracer(scene, light, silhouette).trace(view, ties);
    const auto lit = litCasters(scene, light.position, silhouette);
    const Crossings crossings = crossingsOf(scene, lit, light.position, view, ties);
    for (std::size_t p = 0; p < truth.blocked.size(); ++p) {
        if (truth.tie[p] != Tie::None) continue;
        const int count = volumesAround(crossings.signatures[crossings.exact[p]]);
        ++out.pixels;
        out.blocked += truth.blocked[p];
        out.most = std::max(out.most, count);
        out.different += (count != 0) != truth.blocked[p];
    }
    return out;
}

struct SceneCase {
    std::string name{};
    Scene (*make)(std::mt19937&) = nullptr;
};
void PrintTo(const SceneCase& c, std::ostream* out) {
    *out << c.name;
}

glm::vec3 point(std::mt19937& random, float size) {
    std::uniform_real_distribution<float> coordinate(-size, size);
    return {coordinate(random), coordinate(random), coordinate(random)};
}

/// A floor and an eye above it; the light comes from above, every other time from infinity.
Scene lit(std::mt19937& random, std::vector<Object> objects) {
    Scene scene;
    scene.objects = std::move(objects);
    scene.objects.push_back(floorOf(6));
    const glm::vec3 from = point(random, 1) + glm::vec3(0, 6, 0);
    scene.lights = {{.position = random() % 2 ? glm::vec4(from, 1) : glm::vec4(glm::normalize(from), 0)}};
    scene.frames = {
        {.eye = point(random, 1) + glm::vec3(3, 4, 5), .target = {0, 0.5f, 0}, .nearPlane = 0.25f}};
    return scene;
}

Mesh moved(Mesh mesh, const glm::vec3& by) {
    for (glm::vec3& p : mesh.positions) p += by;
    return mesh;
}

/// Closed casters that overlap.
Scene closed(std::mt19937& random) {
    std::vector<Object> objects;
    for (int i = 0; i < 3; ++i)
        objects.push_back({.mesh = moved(box(glm::dvec3(glm::abs(point(random, 1))) + 0.3),
                                         point(random, 1.2f) + glm::vec3(0, 2, 0))});
    objects.push_back({.mesh = sphere(point(random, 1) + glm::vec3(0, 2, 0), 0.6f, 5, 7)});
    return lit(random, std::move(objects));
}

/// Not closed: sheets, of which two are seen from both sides.
Scene open(std::mt19937& random) {
    std::vector<Object> objects;
    for (int i = 0; i < 4; ++i)
        objects.push_back({.mesh = rectangle(point(random, 1) + glm::vec3(0, 1.7f, 0), point(random, 1.5f),
                                             point(random, 1.5f)),
                           .twoSided = i < 2});
    return lit(random, std::move(objects));
}

/// Several triangles at one edge, wound in any way, and triangles that cross.
Scene nonManifold(std::mt19937& random) {
    std::vector<Object> objects;
    for (const bool twoSided : {false, true}) {
        Object object{.mesh = {.positions = {point(random, 1) + glm::vec3(0, 1.5f, 0),
                                             point(random, 1) + glm::vec3(0, 1.5f, 0)},
                               .triangles = {}},
                      .twoSided = twoSided};
        for (std::uint32_t page = 0; page < 7; ++page) {
            object.mesh.positions.push_back(point(random, 1.4f) + glm::vec3(0, 1.5f, 0));
            object.mesh.triangles.push_back(random() % 2 ? glm::uvec3(0, 1, 2 + page)
                                                         : glm::uvec3(1, 0, 2 + page));
        }
        objects.push_back(std::move(object));
    }
    return lit(random, std::move(objects));
}

/// The eye among the casters, under a slab that holds it in its volume.
Scene eyeInside(std::mt19937& random) {
    Scene scene = closed(random);
    scene.objects.push_back({.mesh = moved(box({9, 0.2, 9}), {0, 5.3f, 0})});
    scene.lights[0].position = {point(random, 1) + glm::vec3(0, 9, 0), 1};
    scene.frames[0].eye = point(random, 0.5f) + glm::vec3(1.5f, 1.5f, 2);
    scene.frames[0].nearPlane = 0.5f;
    return scene;
}

/// Random triangles, the light and the eye anywhere among them.
Scene anything(std::mt19937& random) {
    Scene scene = soup(9, unsigned(random()));
    const glm::vec3 from = point(random, 2);
    scene.lights = {{.position = random() % 2 ? glm::vec4(from, 1) : glm::vec4(glm::normalize(from), 0)}};
    scene.frames = {{.eye = point(random, 1.5f), .target = point(random, 0.3f), .nearPlane = 0.125f}};
    return scene;
}

class CrossingsOf : public testing::TestWithParam<SceneCase> {};

TEST_P(CrossingsOf, ComeToTheShadowsOfTheTracer) {
    std::mt19937 random(1);
    int blocked = 0, most = 0;
    for (int i = 0; i < 8; ++i) {
        const Scene scene = GetParam().make(random);
        for (const Silhouette silhouette : {Silhouette::Winding, Silhouette::PerTriangle}) {
            const Compared found = compared(scene, silhouette);
            EXPECT_EQ(found.different, 0) << i << ", " << int(silhouette) << ", of " << found.pixels;
            blocked += found.blocked;
            most = std::max(most, found.most);
        }
    }
    // Or nothing was compared.
    EXPECT_GT(blocked, 1000);
    EXPECT_GT(most, 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, CrossingsOf,
                         testing::Values(SceneCase{"Closed", closed}, SceneCase{"Open", open},
                                         SceneCase{"NonManifold", nonManifold},
                                         SceneCase{"EyeInside", eyeInside}, SceneCase{"Anything", anything}),
                         [](const auto& test) { return test.param.name; });

TEST(Crossings, AreNoneWithoutALitCaster) {
    Scene scene;
    scene.objects = {floorOf(6)};
    scene.frames = {{.eye = {1, 2, 3}}};
    const View view = viewOf(scene.frames[0], kWidth, kHeight);
    const Crossings crossings = crossingsOf(scene, {}, {0, 5, 0, 1}, view, depthTies(24));
    EXPECT_EQ(crossings.exact.size(), std::size_t(kWidth * kHeight));
    for (const Signature& signature : crossings.signatures) EXPECT_TRUE(signature.empty());
}

TEST(VolumeCount, IsOfCastersThatHaveLitTrianglesOrEachOfThese) {
    const std::vector<LitCaster> lit{{.object = 0, .lit = {{0, 1, 2}, {0, 2, 3}}},
                                     {.object = 1},
                                     {.object = 2, .lit = {{0, 1, 2}, {0, 2, 3}}, .perTriangle = true}};
    EXPECT_EQ(volumeCount(lit), 3u);
}

}  // namespace crossings_test
}  // namespace gnomon
