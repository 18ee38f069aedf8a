#include "scene/weld.h"

#include <gmock/gmock.h>

#include <cmath>

namespace gnomon {
namespace weld_test {

using testing::ElementsAre;

TEST(Weld, MergesVerticesAtTheSamePosition) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                              {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::vector<glm::uvec3> triangles = {{0, 1, 2}, {3, 4, 5}};
    Dropped dropped;
    const Mesh mesh = weld(positions, triangles, dropped);
    EXPECT_THAT(mesh.positions, testing::SizeIs(4));
    EXPECT_THAT(mesh.triangles, ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(1, 3, 2)));
    EXPECT_EQ(describe(dropped), "");
}

TEST(Weld, TakesMinusZeroForZero) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, -0.0f, -0.0f}};
    const std::vector<glm::uvec3> triangles = {{0, 1, 2}, {3, 2, 1}};
    Dropped dropped;
    EXPECT_EQ(weld(positions, triangles, dropped).positions.size(), 3u);
}

TEST(Weld, KeepsVerticesThatDifferByTheLastBitApart) {
    const std::vector<glm::vec3> positions = {
        {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {std::nextafter(1.0f, 2.0f), 0, 0}};
    const std::vector<glm::uvec3> triangles = {{0, 1, 2}, {0, 3, 2}};
    Dropped dropped;
    EXPECT_EQ(weld(positions, triangles, dropped).positions.size(), 4u);
}

TEST(Weld, DropsAndCountsDegenerateTriangles) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, 0, 0}};
    const std::vector<glm::uvec3> triangles = {{0, 1, 2}, {0, 1, 1}, {1, 4, 2}, {0, 1, 3}};
    Dropped dropped;
    const Mesh mesh = weld(positions, triangles, dropped);
    EXPECT_THAT(mesh.triangles, ElementsAre(glm::uvec3(0, 1, 2)));
    EXPECT_EQ(mesh.positions.size(), 3u) << "vertices of dropped triangles go";
    EXPECT_EQ(describe(dropped), "3 degenerate triangles dropped (2 repeat a vertex, 1 have no area)");
}

// Points with three equal coordinates lie on the diagonal, however they are rounded.
TEST(Weld, FindsExactlyCollinearVertices) {
    const std::vector<glm::vec3> positions = {
        glm::vec3(0.1f), glm::vec3(0.7f), glm::vec3(0.3f), {0.3f, 0.3f, std::nextafter(0.3f, 1.0f)}};
    const std::vector<glm::uvec3> straight = {{0, 1, 2}}, bent = {{0, 1, 3}};
    Dropped dropped;
    EXPECT_TRUE(weld(positions, straight, dropped).triangles.empty());
    EXPECT_EQ(dropped.flat.size(), 1u);
    EXPECT_EQ(weld(positions, bent, dropped).triangles.size(), 1u) << "off the line by one bit";
}

TEST(Weld, KeepsDuplicateTriangles) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<glm::uvec3> triangles = {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}};
    Dropped dropped;
    EXPECT_EQ(weld(positions, triangles, dropped).triangles.size(), 3u);
}

std::vector<glm::uvec3> cut(const std::vector<glm::vec3>& positions) {
    std::vector<std::uint32_t> corners(positions.size());
    for (std::uint32_t k = 0; k < corners.size(); ++k) corners[k] = k;
    std::vector<glm::uvec3> triangles;
    triangulate(positions, corners, triangles);
    return triangles;
}

float areaAlongZ(const std::vector<glm::vec3>& positions, const glm::uvec3& t) {
    return glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]).z / 2;
}

TEST(Triangulate, MakesAFanOfAConvexPolygon) {
    EXPECT_THAT(cut({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}),
                ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)));
}

// An arrow head and an L: the fan of the first corner would turn triangles over, and cover more than the
// polygon.
TEST(Triangulate, TurnsNoTriangleOfAConcavePolygonOver) {
    for (const std::vector<glm::vec3>& polygon :
         {std::vector<glm::vec3>{{2, 1, 0}, {0, 2, 0}, {1, 1, 0}, {0, 0, 0}},
          std::vector<glm::vec3>{{0, 3, 0}, {0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}},
          std::vector<glm::vec3>{{3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}, {0, 0, 0}}}) {
        const auto triangles = cut(polygon);
        EXPECT_EQ(triangles.size(), polygon.size() - 2);
        float sum = 0;
        for (const glm::uvec3& t : triangles) {
            EXPECT_GE(areaAlongZ(polygon, t), 0);
            sum += areaAlongZ(polygon, t);
        }
        EXPECT_EQ(sum, polygon.size() == 4 ? 1 : 5);
    }
}

// Dropped as degenerate, the triangle of the fan would take a corner with it and open the mesh.
TEST(Triangulate, LeavesNoTriangleWithoutAreaAtACornerWithinAnEdge) {
    const std::vector<glm::vec3> polygon = {{2, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}};
    for (const glm::uvec3& t : cut(polygon)) EXPECT_GT(areaAlongZ(polygon, t), 0);
}

TEST(Triangulate, AlwaysMakesTwoTrianglesLessThanCorners) {
    EXPECT_EQ(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u) << "crosses itself";
    EXPECT_EQ(cut(std::vector<glm::vec3>(7, glm::vec3(1))).size(), 5u) << "all at one point";
}

}  // namespace weld_test
}  // namespace gnomon
