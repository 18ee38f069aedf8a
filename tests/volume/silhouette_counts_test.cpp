#include "volume/silhouette_counts.h"

#include <gtest/gtest.h>

#include <random>

#include "shapes.h"

namespace gnomon {
namespace silhouette_counts_test {

VolumeCount built(const Scene& scene, const glm::vec4& light, Silhouette silhouette) {
    VolumeCount sum{.isPoint = light.w != 0};
    for (const LitCaster& caster : litCasters(scene, light, silhouette)) {
        sum.caps += caster.lit.size();
        sum.edges += caster.sides.size();
        for (const Side& side : caster.sides) sum.sides += std::size_t(side.weight);
    }
    return sum;
}

void expectAsBuilt(const Scene& scene, const glm::vec4& light) {
    const VolumeCounts counts = SilhouetteCounter(scene).count(light);
    for (int i = 0; i < kSilhouettes; ++i) {
        if (refusal(scene, Silhouette(i))) continue;
        SCOPED_TRACE(i);
        const VolumeCount expected = built(scene, light, Silhouette(i));
        EXPECT_EQ(counts[i].caps, expected.caps);
        EXPECT_EQ(counts[i].edges, expected.edges);
        EXPECT_EQ(counts[i].sides, expected.sides);
        EXPECT_EQ(counts[i].isPoint, expected.isPoint);
    }
}

const std::vector<glm::vec4> kLights = {{5, 7, 3, 1}, {-2, 9, 1, 1}, {0, 0, 0, 1},
                                        {1, 1, 1, 1}, {0, 1, 0, 0},  {0.6f, 0, -0.8f, 0}};

TEST(SilhouetteCounter, CountsWhatIsBuiltOfAClosedMesh) {
    Scene scene = sceneOf(blob({0, 0, 0}, 2, 8, 12, 0.3f, 1));
    scene.objects.push_back({.mesh = cube({4, 0, 0}, 1)});
    scene.objects.push_back({.mesh = cube({0, -5, 0}, 2), .casts = false});
    for (const glm::vec4& light : kLights) expectAsBuilt(scene, light);
    // Both sides cast: where a lit triangle meets one that faces away, two sides hang from their edge.
    scene.objects[0].twoSided = true;
    for (const glm::vec4& light : kLights) expectAsBuilt(scene, light);
}

// Few vertices and many triangles: edges of any valence, duplicates, conflicts.
TEST(SilhouetteCounter, CountsWhatIsBuiltOfASoup) {
    std::mt19937 random(3);
    const auto coordinate = [&] { return float(random() % 5) - 2; };
    for (int round = 0; round < 40; ++round) {
        Mesh mesh;
        for (int v = 0; v < 12; ++v) mesh.positions.emplace_back(coordinate(), coordinate(), coordinate());
        for (int i = 0; i < 60; ++i) {
            const glm::uvec3 t(random() % 12, random() % 12, random() % 12);
            if (t.x != t.y && t.y != t.z && t.z != t.x) mesh.triangles.push_back(t);
        }
        Scene scene = sceneOf(mesh);
        scene.objects[0].twoSided = round % 2;
        for (const glm::vec4& light : kLights) expectAsBuilt(scene, light);
    }
}

// A cube seen from a corner: three faces, six edges.
TEST(SilhouetteCounter, CountsThePolygonsOfACube) {
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    SilhouetteCounter counter(scene);
    const VolumeCounts point = counter.count({5, 5, 5, 1});
    const VolumeCount &winding = point[int(Silhouette::Winding)], each = point[int(Silhouette::PerTriangle)];
    EXPECT_EQ(winding.caps, 6u);
    EXPECT_EQ(winding.sides, 6u);
    EXPECT_EQ(winding.polygons(), 6u + 2 * 6u);
    EXPECT_EQ(winding.triangles(), 2 * 6u + 2 * 6u);
    EXPECT_EQ(each.sides, 18u);
    EXPECT_EQ(each.polygons(), 18u + 2 * 6u);

    const VolumeCount sun = counter.count({0.5f, 0.5f, 0.7f, 0})[int(Silhouette::Winding)];
    EXPECT_EQ(sun.polygons(), 6u + 6u) << "no far cap";
    EXPECT_EQ(sun.triangles(), 6u + 6u) << "sides close in a point";
}

}  // namespace silhouette_counts_test
}  // namespace gnomon
