#include "volume/volume.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "shapes.h"
#include "volume/orient.h"

namespace gnomon {
namespace volume_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// The sides as a chain: how often each undirected edge is walked from low to high.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> chain(const std::vector<Side>& sides) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sum;
    for (const Side& s : sides) sum[std::minmax(s.from, s.to)] += s.from < s.to ? s.weight : -s.weight;
    std::erase_if(sum, [](const auto& entry) { return entry.second == 0; });
    return sum;
}

Mesh soup(int vertices, int triangles, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    std::uniform_int_distribution<std::uint32_t> index(0, vertices - 1);
    Mesh mesh;
    for (int i = 0; i < vertices; ++i)
        mesh.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
    for (int i = 0; i < triangles; ++i)
        mesh.triangles.push_back({index(random), index(random), index(random)});
    return mesh;
}

Caster whole(const Scene& scene) {
    Caster caster{.twoSided = scene.objects[0].twoSided};
    for (std::uint32_t t = 0; t < scene.objects[0].mesh.triangles.size(); ++t) caster.triangles.push_back(t);
    return caster;
}

TEST(Casters, AreConnectedComponentsInMeshOrder) {
    Mesh mesh = cube({0, 0, 0}, 1);
    const Mesh other = cube({5, 0, 0}, 1);
    const auto offset = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (std::size_t i = 0; i < other.triangles.size(); ++i)  // interleaved, the second cube first
        mesh.triangles.insert(mesh.triangles.begin() + 2 * i, other.triangles[i] + offset);

    const auto found = casters(sceneOf(mesh));
    ASSERT_THAT(found, SizeIs(2));
    EXPECT_THAT(found[0].triangles, ElementsAre(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22));
    EXPECT_THAT(found[1].triangles, ElementsAre(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23));
}

TEST(Casters, LeaveOutReceivers) {
    Scene scene = sceneOf(cube({0, 0, 0}, 1));
    scene.objects.push_back({.mesh = cube({3, 0, 0}, 1), .twoSided = true});
    scene.objects[0].casts = false;
    const auto found = casters(scene);
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_EQ(found[0].object, 1u);
    EXPECT_TRUE(found[0].twoSided);
}

TEST(LitCaster, LeavesOutFacesSeenEdgeOn) {
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    // In the plane x = 1, above the top: only the two triangles of the top.
    const LitCaster lit = litCaster(scene, casters(scene)[0], {1, 3, 0, 1}, Silhouette::Winding);
    EXPECT_THAT(lit.lit, SizeIs(2));
    EXPECT_THAT(lit.sides, SizeIs(4));
    EXPECT_THAT(litCaster(scene, casters(scene)[0], {0, 1, 0, 0}, Silhouette::Winding).lit, SizeIs(2));
}

TEST(LitCaster, IsEmptyFromInsideAClosedMesh) {
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    const LitCaster lit = litCaster(scene, casters(scene)[0], {0, 0, 0, 1}, Silhouette::Winding);
    EXPECT_THAT(lit.lit, IsEmpty());
    EXPECT_THAT(lit.sides, IsEmpty());
}

TEST(LitCaster, WindsTwoSidedTrianglesTowardsTheLight) {
    Scene scene = sceneOf(soup(30, 200, 7));
    scene.objects[0].twoSided = true;
    const glm::vec4 light(0.3f, 2, 0.1f, 1);
    const Mesh& mesh = scene.objects[0].mesh;
    for (const glm::uvec3& t : litCaster(scene, whole(scene), light, Silhouette::Winding).lit)
        EXPECT_EQ(orientation(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], light), 1);
}

TEST(LitCaster, CountsEdgesWithTheirSign) {
    // Three fins on one edge, all lit and walking it alike: three sides there.
    Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0.5f}, {0, 1, -0.5f}},
              .triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
    const Scene scene = sceneOf(mesh);
    const LitCaster lit = litCaster(scene, whole(scene), {0, 0, 10, 1}, Silhouette::Winding);
    ASSERT_THAT(lit.sides, SizeIs(7));
    EXPECT_EQ(lit.sides[0].from, 0u);
    EXPECT_EQ(lit.sides[0].to, 1u);
    EXPECT_EQ(lit.sides[0].weight, 3);
}

TEST(LitCaster, WindingAndPerTriangleSidesAreTheSameChain) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Scene scene = sceneOf(soup(12 + seed, 150, seed));
        scene.objects[0].twoSided = seed % 2;
        for (const glm::vec4 light :
             {glm::vec4(0, 3, 0, 1), glm::vec4(0, 0, 0, 1), glm::vec4(0.6f, 0, 0.8f, 0)}) {
            const LitCaster winding = litCaster(scene, whole(scene), light, Silhouette::Winding);
            const LitCaster triangles = litCaster(scene, whole(scene), light, Silhouette::PerTriangle);
            ASSERT_THAT(triangles.sides, SizeIs(3 * triangles.lit.size()));
            ASSERT_EQ(chain(winding.sides), chain(triangles.sides));
            // Each undirected edge once, none with weight 0.
            ASSERT_THAT(winding.sides, SizeIs(chain(winding.sides).size()));
        }
    }
}

TEST(LitCaster, DoesNotDependOnTheOrderOfTriangles) {
    const auto sides = [](const Mesh& mesh) {
        const Scene scene = sceneOf(mesh);
        std::vector<std::array<std::uint32_t, 3>> list;
        for (const Side& s : litCaster(scene, whole(scene), {0, 3, 0, 1}, Silhouette::Winding).sides)
            list.push_back({s.from, s.to, static_cast<std::uint32_t>(s.weight)});
        return list;
    };
    Mesh mesh = soup(20, 300, 5);
    const auto before = sides(mesh);
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937(9));
    EXPECT_EQ(sides(mesh), before);
}

/// @p count fins around the edge from vertex 0 to vertex 1: all walk it alike, all face a light at (0, 0,
/// 10).
Mesh fins(int count) {
    Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}}};
    for (int i = 0; i < count; ++i) {
        mesh.positions.push_back({0, 1, 0.5f * float(i)});
        mesh.triangles.push_back({0, 1, 2 + i});
    }
    return mesh;
}
constexpr glm::vec4 kFinLight{0, 0, 10, 1};

void turn(glm::uvec3& triangle) {
    std::swap(triangle.x, triangle.y);
}

/// Sides at the edge from vertex 0 to vertex 1, those from 1 to 0 negative.
int sidesAtTheFins(const Mesh& mesh, Silhouette silhouette) {
    const Scene scene = sceneOf(mesh);
    const auto sum = chain(litCaster(scene, whole(scene), kFinLight, silhouette).sides);
    const auto found = sum.find({0u, 1u});
    return found == sum.end() ? 0 : found->second;
}

TEST(LitCaster, TogglesAnEdgeWithEachCapInTriangular) {
    EXPECT_EQ(sidesAtTheFins(fins(1), Silhouette::Triangular), 1);
    EXPECT_EQ(sidesAtTheFins(fins(2), Silhouette::Triangular), 0);
    EXPECT_EQ(sidesAtTheFins(fins(3), Silhouette::Triangular), 1);
    EXPECT_EQ(sidesAtTheFins(fins(4), Silhouette::Triangular), 0);
}

TEST(LitCaster, DirectsTriangularSidesAsTheMajorityWalks) {
    // Two of three seen from below, whose edge runs the other way; whatever stands last.
    for (const std::array<int, 2> turned : {std::array{0, 1}, {1, 2}, {0, 2}}) {
        Scene scene = sceneOf(fins(3));
        for (const int i : turned) {
            glm::uvec3& t = scene.objects[0].mesh.triangles[i];
            scene.objects[0].mesh.positions[t.z].y = -1;
            turn(t);
        }
        EXPECT_EQ(sidesAtTheFins(scene.objects[0].mesh, Silhouette::Triangular), -1);
        EXPECT_EQ(sidesAtTheFins(scene.objects[0].mesh, Silhouette::Winding), -1);
    }
}

TEST(LitCaster, WantsExactlyOneCapAtAVisibleEdge) {
    EXPECT_EQ(sidesAtTheFins(fins(1), Silhouette::Visible), 1);
    EXPECT_EQ(sidesAtTheFins(fins(2), Silhouette::Visible), 0);
    EXPECT_EQ(sidesAtTheFins(fins(3), Silhouette::Visible), 0);
    Mesh oneLit = fins(3);
    for (int i = 0; i < 2; ++i) turn(oneLit.triangles[i]);  // turned away from the light
    EXPECT_EQ(sidesAtTheFins(oneLit, Silhouette::Visible), 1);
}

TEST(LitCaster, HasTheSameSidesByAllBuildersOnAClosedManifold) {
    const Scene scene = sceneOf(blob({0, 0, 0}, 1, 12, 14, 0.2f, 3));
    for (const glm::vec4 light :
         {glm::vec4(3, 1, 2, 1), glm::vec4(0, 1, 0, 1), glm::vec4(0.6f, 0, 0.8f, 0)}) {
        for (const CapFaces capFaces : {CapFaces::Lit, CapFaces::Away}) {
            const auto sides = [&](Silhouette s) {
                return chain(litCaster(scene, whole(scene), light, s, capFaces).sides);
            };
            const auto winding = sides(Silhouette::Winding);
            EXPECT_FALSE(winding.empty());
            for (int s = 0; s < kSilhouettes; ++s) EXPECT_EQ(sides(Silhouette(s)), winding);
        }
    }
}

TEST(LitCaster, HasDoubledContoursWhereATwoSidedManifoldBends) {
    Scene scene = sceneOf(cube({0, 0, 0}, 1));
    scene.objects[0].twoSided = true;
    const glm::vec4 light(0.2f, 3, 0.1f, 1);  // sees the top; the other five sides from behind
    for (const Silhouette s : {Silhouette::Manifold, Silhouette::Winding}) {
        const LitCaster lit = litCaster(scene, whole(scene), light, s);
        EXPECT_THAT(lit.lit, SizeIs(12));
        ASSERT_THAT(lit.sides, SizeIs(4));
        for (const Side& side : lit.sides) EXPECT_EQ(side.weight, 2);
    }
    EXPECT_THAT(litCaster(scene, whole(scene), light, Silhouette::Visible).sides, IsEmpty());
}

TEST(LitCaster, CapsWithTheFacesTurnedAwayWoundTowardsTheLight) {
    const Scene scene = sceneOf(cube({0, 0, 0}, 1));
    const LitCaster away =
        litCaster(scene, whole(scene), {0.2f, 3, 0.1f, 1}, Silhouette::Winding, CapFaces::Away);
    EXPECT_THAT(away.lit, SizeIs(10));
    const Mesh& mesh = scene.objects[0].mesh;
    const glm::uvec3 first = mesh.triangles[0];
    EXPECT_EQ(away.lit[0], glm::uvec3(first.y, first.x, first.z));
    for (const glm::uvec3& t : away.lit)
        EXPECT_EQ(
            orientation(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], {0.2f, 3, 0.1f, 1}),
            1);
}

TEST(LitCaster, HasTheSameSidesWhicheverFacesCapAClosedMesh) {
    // No face edge-on: then what is lit and what is away have one outline.
    const Scene scene = sceneOf(blob({0, 0, 0}, 1, 12, 14, 0.2f, 3));
    const glm::vec4 light(3, 1, 2, 1);
    const auto sides = [&](CapFaces capFaces) {
        return chain(litCaster(scene, whole(scene), light, Silhouette::Winding, capFaces).sides);
    };
    EXPECT_EQ(sides(CapFaces::Away), sides(CapFaces::Lit));
}

TEST(LitCaster, CapsTwoSidedCastersWithBothSidesEitherWay) {
    Scene scene = sceneOf(soup(30, 200, 7));
    scene.objects[0].twoSided = true;
    const auto lit = [&](CapFaces capFaces) {
        return litCaster(scene, whole(scene), {0.3f, 2, 0.1f, 1}, Silhouette::Winding, capFaces).lit;
    };
    EXPECT_EQ(lit(CapFaces::Away), lit(CapFaces::Lit));
}

TEST(LitCasters, AreThoseOfAllCastersInTheirOrder) {
    Scene scene = sceneOf(cube({0, 0, 0}, 1));
    scene.objects.push_back({.mesh = cube({3, 0, 0}, 1), .casts = false});
    scene.objects.push_back({.mesh = cube({6, 0, 0}, 1)});
    const auto lit = litCasters(scene, {6, 9, 0, 1}, Silhouette::Visible, CapFaces::Away);
    ASSERT_THAT(lit, SizeIs(2));
    EXPECT_EQ(lit[0].object, 0u);
    EXPECT_EQ(lit[1].object, 2u);
    EXPECT_THAT(lit[1].sides, SizeIs(4));
}

TEST(LitCaster, TakesSparseVertexNumbers) {
    Mesh mesh = cube({0, 0, 0}, 1);
    mesh.positions.resize(1000);
    std::swap(mesh.positions[999], mesh.positions[0]);
    for (glm::uvec3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) t[k] = t[k] == 0 ? 999 : t[k];
    }
    const Scene scene = sceneOf(mesh);
    EXPECT_THAT(litCaster(scene, casters(scene)[0], {0, 3, 0, 1}, Silhouette::Winding).sides, SizeIs(4));
}

TEST(LitCaster, Takes350kTriangles) {
    const Scene scene = sceneOf(blob({0, 0, 0}, 1, 418, 420, 0.001f, 1));
    ASSERT_GT(triangleCount(scene), 350000u);
    const Caster caster = whole(scene);
    const LitCaster lit = litCaster(scene, caster, {3, 3, 0, 1}, Silhouette::Winding);
    EXPECT_GT(lit.sides.size(), 400u);
}

TEST(Extruded, PointsAwayFromTheLight) {
    EXPECT_EQ(extruded({1, 2, 3}, {0.5f, 1, 1, 1}), glm::vec4(0.5f, 1, 2, 0));
    EXPECT_EQ(extruded({1, 2, 3}, {0, 1, 0, 0}), glm::vec4(0, -1, 0, 0));
}

}  // namespace volume_test
}  // namespace gnomon
