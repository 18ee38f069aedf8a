#include "volume/silhouette_finder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <tuple>

#include "bench/torus.h"
#include "shapes.h"
#include "volume/orient.h"

namespace gnomon {
namespace silhouette_finder_test {

using ::testing::SizeIs;

/// From, to, weight.
using Sides = std::vector<std::tuple<std::uint32_t, std::uint32_t, int>>;

Sides sidesOf(const LitCaster& lit) {
    Sides sides;
    for (const Side& s : lit.sides) sides.emplace_back(s.from, s.to, s.weight);
    return sides;
}

/// The rules of volume.h, triangle by triangle and edge by edge.
struct Reference {
    std::vector<glm::uvec3> lit{};
    Sides sides{};

    Reference(const Mesh& mesh, const Caster& caster, const glm::vec4& light, Silhouette silhouette,
              CapFaces capFaces) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> walked;
        for (const std::uint32_t i : caster.triangles) {
            glm::uvec3 t = mesh.triangles[i];
            const int side =
                orientation(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], light);
            if (side == 0) continue;
            if (!caster.twoSided && (side > 0) != (capFaces == CapFaces::Lit)) continue;
            if (side < 0) std::swap(t.x, t.y);
            lit.push_back(t);
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t from = t[k], to = t[(k + 1) % 3];
                ++walked[std::minmax(from, to)][from > to];
                if (silhouette == Silhouette::PerTriangle) sides.emplace_back(from, to, 1);
            }
        }
        if (silhouette == Silhouette::PerTriangle) return;
        for (const auto& [edge, count] : walked) {
            int weight = count[0] - count[1];
            if (silhouette == Silhouette::Triangular)
                weight = (count[0] + count[1]) % 2 * (weight > 0 ? 1 : -1);
            if (silhouette == Silhouette::Visible && count[0] + count[1] != 1) weight = 0;
            if (weight > 0) sides.emplace_back(edge.first, edge.second, weight);
            if (weight < 0) sides.emplace_back(edge.second, edge.first, -weight);
        }
    }
};

/// Several objects of several components each: closed, open, crowded, two-sided, and one that casts nothing.
Scene variedScene(unsigned seed) {
    std::mt19937 random(seed);
    Scene scene;
    const auto add = [&](Mesh mesh, bool twoSided) {
        scene.objects.push_back({.mesh = std::move(mesh), .twoSided = twoSided});
    };
    for (const bool twoSided : {false, true}) {
        add(cube({0, 0, 0}, 1), twoSided);
        add(shuffled(torusGrid(11), seed), twoSided);
        add(soup(300, 120, seed), twoSided);     // many small components
        add(soup(14, 250, seed + 1), twoSided);  // all edges crowded
        Mesh open = torusGrid(12);
        std::shuffle(open.triangles.begin(), open.triangles.end(), random);
        open.triangles.resize(150);
        add(std::move(open), twoSided);
    }
    scene.objects.push_back({.mesh = cube({3, 0, 0}, 1), .casts = false});
    add({}, false);
    return scene;
}

const std::vector<glm::vec4> kLights{{3, 1, 2, 1}, {0, 0, 0, 1},     {0.1f, 0.2f, 0, 1},
                                     {1, 3, 0, 1}, {0, 1, 0, 0},     {0.6f, 0, -0.8f, 0},
                                     {1, 0, 0, 1}, {-40, 7, 0.5f, 1}};

TEST(SilhouetteFinder, FollowsTheRulesForEveryMeshAndLight) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        const Scene scene = variedScene(seed);
        const std::vector<Caster> all = casters(scene);
        const SilhouetteFinder finder(scene);
        for (const glm::vec4& light : kLights) {
            for (int s = 0; s < kSilhouettes; ++s) {
                for (const CapFaces capFaces : {CapFaces::Lit, CapFaces::Away}) {
                    const auto found = finder.lit(light, Silhouette(s), capFaces);
                    ASSERT_THAT(found, SizeIs(all.size()));
                    for (std::size_t i = 0; i < all.size(); ++i) {
                        const Mesh& mesh = scene.objects[all[i].object].mesh;
                        const Reference expected(mesh, all[i], light, Silhouette(s), capFaces);
                        ASSERT_EQ(found[i].object, all[i].object);
                        ASSERT_EQ(found[i].perTriangle, Silhouette(s) == Silhouette::PerTriangle);
                        ASSERT_EQ(found[i].lit, expected.lit);
                        ASSERT_EQ(sidesOf(found[i]), expected.sides)
                            << "silhouette " << s << ", caster " << i;
                    }
                }
            }
        }
    }
}

TEST(SilhouetteFinder, TakesAnySubsetOfTriangles) {
    const Scene scene = variedScene(3);
    std::mt19937 random(1);
    for (std::uint32_t object = 0; object + 1 < scene.objects.size(); ++object) {
        Caster part{.object = object, .twoSided = scene.objects[object].twoSided};
        for (std::uint32_t t = 0; t < scene.objects[object].mesh.triangles.size(); ++t) {
            if (random() % 3 == 0) part.triangles.push_back(t);
        }
        const Reference expected(scene.objects[object].mesh, part, kLights[0], Silhouette::Winding,
                                 CapFaces::Lit);
        const LitCaster found = litCaster(scene, part, kLights[0], Silhouette::Winding);
        EXPECT_EQ(found.lit, expected.lit);
        EXPECT_EQ(sidesOf(found), expected.sides);
    }
}

TEST(SilhouetteFinder, DoesNotDependOnTheOrderOfTrianglesAndVertices) {
    using Point = std::array<float, 3>;
    const auto sides = [](const Mesh& mesh, Silhouette silhouette) {
        const Scene scene = sceneOf(mesh);
        const auto at = [&](std::uint32_t v) {
            const glm::vec3& p = mesh.positions[v];
            return Point{p.x, p.y, p.z};
        };
        std::vector<std::tuple<Point, Point, int>> list;
        for (const LitCaster& lit : SilhouetteFinder(scene).lit({0.3f, 3, 0.2f, 1}, silhouette)) {
            for (const Side& s : lit.sides) list.emplace_back(at(s.from), at(s.to), s.weight);
        }
        std::sort(list.begin(), list.end());
        return list;
    };
    for (const Mesh& mesh : {torusGrid(20), soup(20, 300, 5), soup(200, 300, 6)}) {
        for (int s = 0; s < kSilhouettes; ++s) {
            const auto expected = sides(mesh, Silhouette(s));
            EXPECT_FALSE(expected.empty());
            for (unsigned seed = 0; seed < 4; ++seed)
                EXPECT_EQ(sides(shuffled(mesh, seed), Silhouette(s)), expected) << "silhouette " << s;
        }
    }
}

TEST(SilhouetteFinder, HasNoCastersInAnEmptyScene) {
    EXPECT_THAT(SilhouetteFinder(Scene{}).lit({0, 1, 0, 1}, Silhouette::Winding), SizeIs(0));
}

}  // namespace silhouette_finder_test
}  // namespace gnomon
