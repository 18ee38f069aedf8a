#include "volume/adjacency.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "bench/torus.h"
#include "shapes.h"

namespace gnomon {
namespace adjacency_test {

using ::testing::IsEmpty;
using ::testing::SizeIs;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The triangles at each edge, those that walk it from low to high first, found the slow way.
std::map<Edge, std::array<std::vector<std::uint32_t>, 2>> trianglesByEdge(
    std::span<const glm::uvec3> triangles) {
    std::map<Edge, std::array<std::vector<std::uint32_t>, 2>> result;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const glm::uvec3 t = triangles[i];
        if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t from = t[k], to = t[(k + 1) % 3];
            result[std::minmax(from, to)][from > to].push_back(i);
        }
    }
    return result;
}

/// Every walk and every crowd of adjacency() must be what the slow way finds.
void expectRight(std::span<const glm::uvec3> triangles) {
    static AdjacencyScratch scratch;  // both as the mesh before left them
    static Adjacency found;
    findAdjacency(triangles, scratch, found);
    ASSERT_EQ(found.triangles, triangles.size());
    ASSERT_GE(found.across.size(), 192 * (triangles.size() / 64 + 1));
    const auto expected = trianglesByEdge(triangles);
    const auto isSimple = [](const auto& sides) { return sides[0].size() <= 1 && sides[1].size() <= 1; };

    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangles[i][k], to = triangles[i][nextCorner(k)];
            const auto edge = expected.find(std::minmax(from, to));
            const bool known = edge != expected.end();
            std::uint32_t across = i;  // crowded, or the triangle repeats a vertex
            const glm::uvec3 t = triangles[i];
            if (known && isSimple(edge->second) && t.x != t.y && t.y != t.z && t.z != t.x) {
                const auto& others = edge->second[from < to];
                across = others.empty() ? found.triangles : others[0];
            }
            ASSERT_EQ(found.across[3 * i + k], across) << "triangle " << i << ", corner " << k;
        }
    }
    for (std::size_t i = 3 * triangles.size(); i < found.across.size(); ++i)
        ASSERT_EQ(found.across[i], found.triangles);

    std::map<Edge, std::array<std::vector<std::uint32_t>, 2>> crowds;
    auto at = found.crowds.begin();
    for (const Adjacency::Crowded& edge : found.crowded) {
        auto& crowd = crowds[{edge.low, edge.high}];
        ASSERT_TRUE(crowd[0].empty() && crowd[1].empty()) << "an edge is listed twice";
        bool last = false;
        for (; !last; ++at) {
            crowd[*at & Adjacency::kBackward].push_back(*at / 4);
            last = (*at & Adjacency::kLast) != 0;
        }
    }
    ASSERT_EQ(at, found.crowds.end());
    auto wanted = expected;
    std::erase_if(wanted, [&](const auto& entry) { return isSimple(entry.second); });
    ASSERT_EQ(crowds, wanted);
}

std::vector<glm::uvec3> randomTriangles(std::uint32_t vertices, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<glm::uvec3> triangles;
    for (int i = 0; i < count; ++i)
        triangles.push_back({random() % vertices, random() % vertices, random() % vertices});
    return triangles;
}

TEST(Adjacency, IsRightOnRandomTriangles) {
    // From 3 vertices, where each edge is crowded, to 500, where most are alone.
    for (const std::uint32_t vertices : {3u, 4u, 5u, 8u, 20u, 100u, 500u}) {
        for (unsigned seed = 0; seed < 40; ++seed)
            expectRight(randomTriangles(vertices, 1 + int(seed * 7 % 150), seed));
    }
}

TEST(Adjacency, IsRightWhereVerticesHaveManyTriangles) {
    expectRight(randomTriangles(12, 3000, 1));
    // Closed fans around vertex 0: buckets too long to search.
    for (const std::uint32_t n : {63u, 64u, 65u, 66u, 500u}) {
        std::vector<glm::uvec3> fan;
        for (std::uint32_t i = 0; i < n; ++i) fan.push_back({0, 1 + i, 1 + (i + 1) % n});
        expectRight(fan);
        fan.push_back({0, 1, 2});
        expectRight(fan);
    }
}

TEST(Adjacency, IsRightOnClosedMeshesInAnyOrder) {
    const Mesh torus = torusGrid(9);
    expectRight(torus.triangles);
    for (unsigned seed = 0; seed < 5; ++seed) expectRight(shuffled(torus, seed).triangles);
    EXPECT_THAT(adjacency(torus.triangles).crowded, IsEmpty());
}

TEST(Adjacency, IsRightWithSparseVertexNumbers) {
    std::vector<glm::uvec3> triangles = randomTriangles(20, 60, 3);
    for (glm::uvec3& t : triangles) t = t * 200000001u + 7u;
    expectRight(triangles);
    for (glm::uvec3& t : triangles) t = t / 200000001u + 0xfffffff0u - 20u;  // high, but close together
    expectRight(triangles);
}

TEST(Adjacency, IsEmptyWithoutTriangles) {
    EXPECT_EQ(adjacency({}).triangles, 0u);
    EXPECT_THAT(adjacency({}).crowded, IsEmpty());
}

TEST(Adjacency, HasNoLimitAt65535) {
    const Mesh torus = torusGrid(300);  // 90,000 vertices, 180,000 triangles
    expectRight(torus.triangles);
}

// Comparing each with each would take longer than a test may.
TEST(Adjacency, TakesEveryTriangleAtOneVertexOrOneEdge) {
    constexpr std::uint32_t kCount = 200000;
    std::vector<glm::uvec3> fan, book;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        fan.push_back({0, 1 + i, 1 + (i + 1) % kCount});
        book.push_back(i % 2 ? glm::uvec3(0, 1, 2 + i) : glm::uvec3(1, 0, 2 + i));
    }
    EXPECT_THAT(adjacency(fan).crowded, IsEmpty());
    EXPECT_THAT(adjacency(book).crowded, SizeIs(1));
}

}  // namespace adjacency_test
}  // namespace gnomon
