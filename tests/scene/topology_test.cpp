#include "scene/topology.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "scene/primitives.h"
#include "scene/weld.h"

namespace gnomon {
namespace topology_test {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

/// @p count triangles around the edge (0,0,0)-(0,0,1), all running along it upwards.
Mesh fan(int count) {
    Mesh mesh{.positions = {{0, 0, 0}, {0, 0, 1}}};
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.5);
        mesh.triangles.emplace_back(0, 1, 2 + i);
    }
    return mesh;
}

/// A band of @p quads with half a twist: vertex 2i and 2i + 1 are the ends of rung i.
Mesh moebiusStrip(std::uint32_t quads) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < quads; ++i) {
        const double turn = 2 * std::numbers::pi * i / quads;
        for (const double side : {-0.4, 0.4}) {
            const double r = 1 + side * std::cos(turn / 2);
            mesh.positions.emplace_back(r * std::cos(turn), r * std::sin(turn), side * std::sin(turn / 2));
        }
        const bool last = i + 1 == quads;
        const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
    }
    return mesh;
}

Mesh together(Mesh a, const Mesh& b, const glm::vec3& offset) {
    const auto base = glm::uvec3(std::uint32_t(a.positions.size()));
    for (const glm::vec3& p : b.positions) a.positions.push_back(p + offset);
    for (const glm::uvec3& t : b.triangles) a.triangles.push_back(t + base);
    return a;
}

/// Vertices where they coincide merged.
Mesh welded(const Mesh& mesh) {
    Dropped dropped;
    return weld(mesh.positions, mesh.triangles, dropped);
}

TEST(Topology, OfAClosedBox) {
    const Topology t = topologyOf(box({1, 2, 3}));
    EXPECT_EQ(t.triangles, 12u);
    EXPECT_EQ(t.vertices, 8u);
    EXPECT_EQ(t.edges, 18u);
    EXPECT_THAT(t.valences, ElementsAre(Pair(2, 18)));
    EXPECT_EQ(t.components, 1u);
    EXPECT_EQ(t.windingConflicts + t.unbalancedEdges + t.duplicates + t.bowTies, 0u);
    EXPECT_EQ(t.euler(), 2);
    EXPECT_EQ(t.genus(), 0);
    EXPECT_EQ(describe(t), "closed manifold, genus 0");
    EXPECT_FALSE(t.boundaryEdge || t.nonManifoldEdge || t.conflictEdge || t.unbalancedEdge);
}

TEST(Topology, OfAnOpenBoxNamesAnEdgeOfItsRim) {
    Mesh mesh = box({2, 2, 2});
    // Both triangles of the top.
    std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
        return mesh.positions[t.x].y > 0 && mesh.positions[t.y].y > 0 && mesh.positions[t.z].y > 0;
    });
    const Topology t = topologyOf(mesh);
    EXPECT_EQ(t.triangles, 10u);
    EXPECT_THAT(t.valences, ElementsAre(Pair(1, 4), Pair(2, 13)));
    EXPECT_EQ(t.boundaryEdges(), 4u);
    EXPECT_EQ(t.unbalancedEdges, 4u);
    EXPECT_EQ(t.windingConflicts, 0u);
    EXPECT_EQ(t.genus(), std::nullopt);
    EXPECT_EQ(describe(t), "open");
    EXPECT_EQ(t.boundaryEdge, (Edge{glm::vec3(-1, 1, -1), glm::vec3(-1, 1, 1)}));
}

class Fan : public testing::TestWithParam<int> {};

TEST_P(Fan, HasOneEdgeOfItsValence) {
    const int k = GetParam();
    const Topology t = topologyOf(fan(k));
    EXPECT_THAT(t.valences, ElementsAre(Pair(1, 2 * k), Pair(k, 1)));
    EXPECT_EQ(t.nonManifoldEdges(), k > 2 ? 1u : 0u);
    EXPECT_EQ(t.maxValence(), k);
    EXPECT_EQ(t.windingConflicts, k == 2 ? 1u : 0u);
    EXPECT_EQ(t.unbalancedEdges, std::size_t(2 * k + 1));
    EXPECT_EQ(t.bowTies, 0u) << "an edge joins the fans at its ends, whatever its valence";
    if (k > 2) {
        EXPECT_EQ(t.nonManifoldEdge, (Edge{glm::vec3(0, 0, 0), glm::vec3(0, 0, 1)}));
    }
}

INSTANTIATE_TEST_SUITE_P(Valence, Fan, testing::Values(2, 3, 4, 5, 8, 12, 300));

TEST(Topology, GenusOfATorusAndOfPiecesTogether) {
    const Mesh ring = torus(2, 0.5, 16, 8);
    EXPECT_EQ(topologyOf(ring).genus(), 1);
    EXPECT_EQ(topologyOf(ring).euler(), 0);
    const Topology both = topologyOf(together(ring, torus(1, 0.25, 8, 5), {9, 0, 0}));
    EXPECT_EQ(both.components, 2u);
    EXPECT_EQ(both.genus(), 2);
    EXPECT_EQ(topologyOf(together(ring, sphere(1, 8, 4), {9, 0, 0})).genus(), 1);
}

TEST(Topology, OfAMoebiusStripHasOneConflict) {
    const Topology t = topologyOf(moebiusStrip(9));
    EXPECT_EQ(t.triangles, 18u);
    EXPECT_EQ(t.boundaryEdges(), 18u);
    EXPECT_EQ(t.windingConflicts, 1u) << "where the band meets its own back";
    EXPECT_EQ(t.unbalancedEdges, 19u);
    EXPECT_EQ(t.euler(), 0);
    EXPECT_TRUE(t.conflictEdge);
}

TEST(Topology, TurningOneTriangleOfAClosedMeshMakesThreeConflicts) {
    Mesh mesh = sphere(1, 8, 5);
    std::swap(mesh.triangles[9].x, mesh.triangles[9].y);
    const Topology t = topologyOf(mesh);
    EXPECT_EQ(t.windingConflicts, 3u);
    EXPECT_EQ(t.boundaryEdges(), 0u);
    EXPECT_EQ(describe(t), "no boundary, but directions do not cancel");
}

TEST(Topology, CountsDuplicatesByTheirOrientation) {
    Mesh mesh = box({1, 1, 1});
    const glm::uvec3 t = mesh.triangles[3];
    mesh.triangles.emplace_back(t.y, t.z, t.x);
    Topology same = topologyOf(mesh);
    EXPECT_EQ(same.duplicates, 1u);
    EXPECT_EQ(same.duplicatesSameWay, 1u);
    EXPECT_EQ(same.nonManifoldEdges(), 3u);
    EXPECT_FALSE(same.isBalanced());

    mesh.triangles.back() = {t.z, t.y, t.x};
    const Topology reversed = topologyOf(mesh);
    EXPECT_EQ(reversed.duplicates, 1u);
    EXPECT_EQ(reversed.duplicatesSameWay, 0u);

    // Three one way, two the other.
    mesh.triangles.insert(mesh.triangles.end(), {{t.y, t.x, t.z}, t, t});
    EXPECT_EQ(topologyOf(mesh).duplicates, 4u);
    EXPECT_EQ(topologyOf(mesh).duplicatesSameWay, 3u);
}

// Two cubes that share an edge: the directions cancel, though four triangles meet there.
TEST(Topology, AnEdgeOfFourCanBeBalanced) {
    const Topology t = topologyOf(welded(together(box({1, 1, 1}), box({1, 1, 1}), {1, 1, 0})));
    EXPECT_THAT(t.valences, ElementsAre(Pair(2, 34), Pair(4, 1)));
    EXPECT_TRUE(t.isBalanced());
    EXPECT_FALSE(t.isClosedManifold());
    EXPECT_EQ(t.windingConflicts, 0u);
    EXPECT_EQ(t.genus(), std::nullopt);
    EXPECT_EQ(describe(t), "closed (directions cancel along every edge), non-manifold edges");
}

TEST(Topology, TwoCubesThatShareAVertexAreABowTie) {
    const Topology t = topologyOf(welded(together(box({1, 1, 1}), box({1, 1, 1}), {1, 1, 1})));
    EXPECT_EQ(t.bowTies, 1u);
    EXPECT_EQ(t.components, 1u);
    EXPECT_EQ(t.maxValence(), 2);
    EXPECT_FALSE(t.isClosedManifold());
}

TEST(Topology, DoesNotDependOnTheOrder) {
    Mesh mesh = together(moebiusStrip(12), fan(5), {0, 0, 3});
    mesh = together(mesh, torus(1, 0.3, 9, 7), {4, 0, 0});
    mesh.triangles.push_back(mesh.triangles[5]);
    std::swap(mesh.triangles[40].x, mesh.triangles[40].z);
    const Topology first = topologyOf(mesh);

    std::mt19937 random(7);
    for (int round = 0; round < 20; ++round) {
        std::vector<std::uint32_t> order(mesh.positions.size());
        for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
        std::shuffle(order.begin(), order.end(), random);
        Mesh other = mesh;
        for (std::uint32_t v = 0; v < order.size(); ++v) other.positions[order[v]] = mesh.positions[v];
        for (glm::uvec3& t : other.triangles) {
            t = {order[t.x], order[t.y], order[t.z]};
            if (random() % 2) t = {t.y, t.z, t.x};
        }
        std::shuffle(other.triangles.begin(), other.triangles.end(), random);
        const Topology t = topologyOf(other);
        EXPECT_EQ(t.vertices, first.vertices);
        EXPECT_EQ(t.edges, first.edges);
        EXPECT_EQ(t.valences, first.valences);
        EXPECT_EQ(t.windingConflicts, first.windingConflicts);
        EXPECT_EQ(t.unbalancedEdges, first.unbalancedEdges);
        EXPECT_EQ(t.duplicates, first.duplicates);
        EXPECT_EQ(t.duplicatesSameWay, first.duplicatesSameWay);
        EXPECT_EQ(t.components, first.components);
        EXPECT_EQ(t.bowTies, first.bowTies);
        EXPECT_EQ(t.boundaryEdge, first.boundaryEdge);
        EXPECT_EQ(t.nonManifoldEdge, first.nonManifoldEdge);
        EXPECT_EQ(t.conflictEdge, first.conflictEdge);
        EXPECT_EQ(t.unbalancedEdge, first.unbalancedEdge);
    }
}

TEST(Topology, LeavesVerticesThatNoTriangleUsesOut) {
    Mesh mesh = box({1, 1, 1});
    mesh.positions.emplace_back(9, 9, 9);
    EXPECT_EQ(topologyOf(mesh).vertices, 8u);
    EXPECT_EQ(topologyOf(mesh).components, 1u);
    EXPECT_EQ(topologyOf({}).components, 0u);
    EXPECT_FALSE(topologyOf({}).isClosedManifold());
}

TEST(JoinCasters, ClosesWhatIsOpenPerObject) {
    Scene scene;
    const Mesh whole = box({2, 2, 2});
    for (int part = 0; part < 2; ++part) {
        Mesh half = whole;
        half.triangles.assign(whole.triangles.begin() + 6 * part, whole.triangles.begin() + 6 * (part + 1));
        scene.objects.push_back({.mesh = welded(half)});
        EXPECT_GT(topologyOf(scene.objects.back().mesh).boundaryEdges(), 0u);
    }
    scene.objects.push_back({.mesh = rectangle({9, 9}), .casts = false});
    EXPECT_EQ(describe(topologyOf(joinCasters(scene, false))), "closed manifold, genus 0");
}

// A square of two triangles, one cut at the middle of an edge: the sliver on that edge closes the crack.
TEST(JoinCasters, TakesTrianglesWithoutAreaBackWhereAsked) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, 0}, {2, 2, 0}};
    const std::vector<glm::uvec3> triangles = {{0, 1, 2}, {1, 4, 3}, {3, 4, 2}, {2, 1, 3}, {0, 0, 1}};
    Scene scene;
    scene.objects.push_back({.mesh = weld(positions, triangles, scene.dropped)});
    EXPECT_EQ(scene.dropped.flat.size(), 1u);
    EXPECT_EQ(scene.dropped.repeatedVertex, 1u);
    const Topology drawn = topologyOf(joinCasters(scene, false));
    EXPECT_EQ(drawn.triangles, 3u);
    EXPECT_EQ(drawn.boundaryEdges(), 7u);
    const Topology file = topologyOf(joinCasters(scene, true));
    EXPECT_EQ(file.triangles, 4u);
    EXPECT_EQ(file.vertices, 5u);
    EXPECT_EQ(file.boundaryEdges(), 4u);
}

}  // namespace topology_test
}  // namespace gnomon
