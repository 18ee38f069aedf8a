#include "scene/t_junctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "scene/primitives.h"

namespace gnomon {
namespace t_junctions_test {

TEST(TJunctions, AreVerticesInsideOfBoundaryEdges) {
    // A square of two triangles beside one of three, which has a vertex amid the edge between them.
    Mesh mesh{.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {2, 1, 0}, {4, 0, 0}, {4, 2, 0}},
              .triangles = {{0, 1, 2}, {0, 2, 3}, {1, 5, 4}, {4, 5, 6}, {4, 6, 2}}};
    EXPECT_EQ(tJunctions(mesh), 1u);
    mesh.triangles[0] = {0, 1, 4};
    mesh.triangles.emplace_back(0, 4, 2);
    EXPECT_EQ(tJunctions(mesh), 0u) << "all edges meet vertex to vertex";
    mesh.positions.emplace_back(0, 1, 0);
    EXPECT_EQ(tJunctions(mesh), 0u) << "no triangle uses it";
}

TEST(TJunctions, AreNoneOnClosedMeshesNorWhereEdgesOnlyShareEnds) {
    EXPECT_EQ(tJunctions(box({1, 2, 3})), 0u);
    EXPECT_EQ(tJunctions(rectangle({1, 2})), 0u);
    EXPECT_EQ(tJunctions({}), 0u);
}

// Against the definition, over meshes on a small grid where many vertices lie on edges.
TEST(TJunctions, AgreeWithEveryPairTried) {
    std::mt19937 random(11);
    for (int round = 0; round < 30; ++round) {
        Mesh mesh;
        for (int x = 0; x < 5; ++x)
            for (int y = 0; y < 5; ++y)
                for (int z = 0; z < 3; ++z) mesh.positions.emplace_back(x, y, z);
        for (int i = 0; i < 30; ++i) {
            const glm::uvec3 t(random() % 75, random() % 75, random() % 75);
            if (t.x != t.y && t.y != t.z && t.z != t.x) mesh.triangles.push_back(t);
        }
        std::map<std::pair<unsigned, unsigned>, int> valence;
        for (const glm::uvec3& t : mesh.triangles)
            for (int k = 0; k < 3; ++k) ++valence[std::minmax({t[k], t[(k + 1) % 3]})];
        std::erase_if(valence, [](const auto& edge) { return edge.second != 1; });
        std::vector<bool> onBoundary(75), inside(75);
        for (const auto& [edge, count] : valence) onBoundary[edge.first] = onBoundary[edge.second] = true;
        for (const auto& [edge, count] : valence)
            for (unsigned v = 0; v < 75; ++v) {
                // Coordinates are small integers: exact.
                const glm::vec3 a = mesh.positions[edge.first], b = mesh.positions[edge.second];
                const glm::vec3 p = mesh.positions[v];
                if (onBoundary[v] && p != a && p != b && glm::cross(b - a, p - a) == glm::vec3(0) &&
                    glm::dot(p - a, b - p) > 0)
                    inside[v] = true;
            }
        EXPECT_EQ(tJunctions(mesh), std::size_t(std::count(inside.begin(), inside.end(), true)));
    }
}

}  // namespace t_junctions_test
}  // namespace gnomon
