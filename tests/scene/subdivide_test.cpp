#include "scene/subdivide.h"

#include <gtest/gtest.h>

#include "scene/primitives.h"

namespace gnomon {
namespace subdivide_test {

double areaOf(const Mesh& mesh) {
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        area += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return area;
}

TEST(Subdivided, HasFourTimesTheTrianglesOfTheSameSurface) {
    const Mesh ball = sphere(1, 12, 6);
    const Mesh fine = subdivided(ball, 2);
    EXPECT_EQ(fine.triangles.size(), 16 * ball.triangles.size());
    EXPECT_NEAR(areaOf(fine), areaOf(ball), 1e-6);
}

// Euler: a closed surface without holes stays one, since neighbours share the middles of their edges.
TEST(Subdivided, SharesTheMiddlesOfEdges) {
    const Mesh ball = sphere(1, 12, 6);
    const auto euler = [](const Mesh& mesh) {
        return std::ptrdiff_t(mesh.positions.size()) - std::ptrdiff_t(mesh.triangles.size()) / 2;
    };
    EXPECT_EQ(euler(ball), 2);
    EXPECT_EQ(euler(subdivided(ball, 3)), 2);
}

TEST(Subdivided, NoTimesAtAllIsTheMesh) {
    const Mesh cube = box({1, 2, 3});
    EXPECT_EQ(subdivided(cube, 0).triangles, cube.triangles);
}

}  // namespace subdivide_test
}  // namespace gnomon
