// Triangles with adjacency for AtomicZP's geometry shader, on any mesh.

#include "gl/silhouette_mesh.h"

#include <gmock/gmock.h>

#include <map>
#include <random>

#include "scene/primitives.h"
#include "volume/orient.h"
#include "volume/volume.h"

namespace gnomon {
namespace silhouette_mesh_test {

/// How often each edge is the side of a volume, from its lower vertex to its higher.
using Sides = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

void add(Sides& sides, std::uint32_t from, std::uint32_t to, int weight) {
    int& sum = sides[{std::min(from, to), std::max(from, to)}];
    sum += from < to ? weight : -weight;
    if (sum == 0) sides.erase({std::min(from, to), std::max(from, to)});
}

/// What the shader makes of one object's mesh: of each edge that a triangle holds, its own facing less that
/// of the triangle across.
Sides shaderSides(const SilhouetteMesh& mesh) {
    const auto facing = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto& v = mesh.vertices;
        const int side =
            orientation(glm::vec3(v[a]), glm::vec3(v[b]), glm::vec3(v[c]), glm::vec4(mesh.light));
        return v[a].w > 1.5f ? side : std::max(side, 0);
    };
    Sides sides;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 6) {
        const std::uint32_t* p = &mesh.indices[i];
        const int own = facing(p[0], p[2], p[4]);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t from = p[2 * k], far = p[2 * k + 1], to = p[(2 * k + 2) % 6];
            const float kind = mesh.vertices[far].w;
            if (kind < 0) continue;
            const int across = kind == 0 ? 0 : facing(to, from, far);
            // The first two vertices stand for "none" and "held".
            if (own != across) add(sides, from - 2, to - 2, own - across);
        }
    }
    return sides;
}

Sides windingSides(const Scene& scene, const glm::vec4& light) {
    Sides sides;
    for (const LitCaster& caster : litCasters(scene, light, Silhouette::Winding))
        for (const Side& side : caster.sides) add(sides, side.from, side.to, side.weight);
    return sides;
}

/// Random triangles of few vertices: edges of one triangle and of many, walked either way.
Mesh soup(std::uint32_t vertices, int triangles, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    Mesh mesh;
    for (std::uint32_t i = 0; i < vertices; ++i)
        mesh.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
    while (int(mesh.triangles.size()) < triangles) {
        const glm::uvec3 t(random() % vertices, random() % vertices, random() % vertices);
        if (t.x != t.y && t.y != t.z && t.z != t.x) mesh.triangles.push_back(t);
    }
    return mesh;
}

TEST(SilhouetteMesh, HasTheSidesOfTheSignedCounterOnAnyMesh) {
    const View view = viewOf({}, 64, 48);
    std::size_t found = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        Scene scene;
        scene.objects = {{.mesh = seed % 3 ? soup(seed % 2 ? 12 : 60, 90, seed) : box({1, 2, 3}),
                          .twoSided = seed % 5 == 0}};
        const glm::vec4 light =
            seed % 4 ? glm::vec4(2, 3, 0.5f + float(seed), 1) : glm::vec4(0.6f, 0, 0.8f, 0);
        const Sides expected = windingSides(scene, light);
        ASSERT_EQ(shaderSides(silhouetteMesh(scene, light, view)), expected) << seed;
        found += expected.size();
    }
    EXPECT_GT(found, 1000u);
}

TEST(SilhouetteMesh, LeavesOutWhatCastsNoShadow) {
    Scene scene;
    scene.objects = {{.mesh = box({1, 1, 1}), .casts = false}};
    EXPECT_THAT(silhouetteMesh(scene, {0, 9, 0, 1}, viewOf({}, 64, 48)).indices, testing::IsEmpty());
}

}  // namespace silhouette_mesh_test
}  // namespace gnomon
