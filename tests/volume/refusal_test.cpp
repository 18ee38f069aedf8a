#include <gmock/gmock.h>

#include "shapes.h"
#include "volume/volume.h"

namespace gnomon {
namespace refusal_test {

using ::testing::AllOf;
using ::testing::Eq;
using ::testing::HasSubstr;
using ::testing::Optional;

constexpr std::array kAll{Silhouette::Triangular, Silhouette::Visible, Silhouette::Manifold,
                          Silhouette::Winding, Silhouette::PerTriangle};

TEST(Refusal, HasNothingAgainstAClosedManifold) {
    for (const Silhouette s : kAll) {
        for (const CapFaces c : {CapFaces::Lit, CapFaces::Away})
            EXPECT_EQ(refusal(sceneOf(cube({0, 0, 0}, 1)), s, c), std::nullopt);
    }
}

TEST(Refusal, NamesTheBoundaryThatManifoldCantTake) {
    Mesh mesh = cube({0, 0, 0}, 1);
    mesh.triangles.erase(mesh.triangles.begin());  // {0, 4, 6}; {0, 4} lies between it and {0, 5, 4}
    EXPECT_THAT(refusal(sceneOf(mesh), Silhouette::Manifold),
                Optional(Eq("object 0 (mesh): boundary: only triangle 4 at edge 0-4 from (-1, -1, -1) to "
                            "(-1, -1, 1)")));
    for (const Silhouette s :
         {Silhouette::Triangular, Silhouette::Visible, Silhouette::Winding, Silhouette::PerTriangle})
        EXPECT_EQ(refusal(sceneOf(mesh), s), std::nullopt);
}

TEST(Refusal, NamesTheEdgeOfThreeTriangles) {
    Mesh mesh = cube({0, 0, 0}, 1);
    mesh.positions.push_back({9, 9, 9});
    mesh.triangles.push_back({0, 1, 8});
    EXPECT_THAT(refusal(sceneOf(mesh), Silhouette::Manifold),
                Optional(HasSubstr("3 triangles at edge 0-1 ")));
}

TEST(Refusal, NamesTheWindingConflict) {
    Mesh mesh = cube({0, 0, 0}, 1);
    std::swap(mesh.triangles[0].x, mesh.triangles[0].y);
    EXPECT_THAT(refusal(sceneOf(mesh), Silhouette::Manifold),
                Optional(HasSubstr("winding conflict: triangles 0 and 5 walk the same way along edge 0-4 ")));
}

TEST(Refusal, NamesTheDuplicates) {
    Mesh mesh = cube({0, 0, 0}, 1);
    mesh.triangles.push_back({4, 6, 0});
    EXPECT_THAT(refusal(sceneOf(mesh), Silhouette::Manifold),
                Optional(HasSubstr("triangles 0 and 12 are the same, at edge 0-4 ")));
}

TEST(Refusal, TakesBackToBackTrianglesForManifold) {
    Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}, {0, 2, 1}}};
    EXPECT_EQ(refusal(sceneOf(mesh), Silhouette::Manifold, CapFaces::Away), std::nullopt);
}

TEST(Refusal, WantsClosedCastersForAwayCapsUnlessTwoSided) {
    Scene scene = sceneOf(cube({0, 0, 0}, 1));
    scene.objects[0].mesh.triangles.pop_back();  // {4, 7, 6}
    EXPECT_EQ(refusal(scene, Silhouette::Winding), std::nullopt);
    EXPECT_THAT(refusal(scene, Silhouette::Winding, CapFaces::Away),
                Optional(HasSubstr("not closed: 1 triangle one way and 0 the other along edge 4-6 ")));
    scene.objects[0].twoSided = true;
    EXPECT_EQ(refusal(scene, Silhouette::Winding, CapFaces::Away), std::nullopt);
}

TEST(Refusal, TakesClosedMeshesWithEdgesOfFourForAwayCaps) {
    // Two cubes that share the edge 1-5.
    Mesh mesh = cube({0, 0, 0}, 1);
    const Mesh other = cube({2, -2, 0}, 1);
    std::array<std::uint32_t, 8> at{};
    for (std::uint32_t v = 0; v < 8; ++v) {
        at[v] = v == 2 ? 1 : v == 6 ? 5 : std::uint32_t(mesh.positions.size());
        if (at[v] > 5) mesh.positions.push_back(other.positions[v]);
    }
    for (const glm::uvec3& t : other.triangles) mesh.triangles.push_back({at[t.x], at[t.y], at[t.z]});
    EXPECT_EQ(refusal(sceneOf(mesh), Silhouette::Winding, CapFaces::Away), std::nullopt);
    EXPECT_THAT(refusal(sceneOf(mesh), Silhouette::Manifold),
                Optional(HasSubstr("4 triangles at edge 1-5 ")));
}

TEST(Refusal, LeavesReceiversAlone) {
    Scene scene = sceneOf({.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}});
    scene.objects[0].casts = false;
    EXPECT_EQ(refusal(scene, Silhouette::Manifold, CapFaces::Away), std::nullopt);
    scene.objects.push_back(scene.objects[0]);
    scene.objects[1].casts = true;
    EXPECT_THAT(refusal(scene, Silhouette::Manifold), Optional(HasSubstr("object 1 (mesh): boundary")));
}

TEST(Refusal, PassesOverTrianglesWithARepeatedVertex) {
    Mesh mesh = cube({0, 0, 0}, 1);
    mesh.triangles.push_back({0, 0, 7});
    EXPECT_EQ(refusal(sceneOf(mesh), Silhouette::Manifold, CapFaces::Away), std::nullopt);
}

TEST(Limitation, IsTwoTrianglesThatWalkAnEdgeAlike) {
    Mesh mesh = cube({0, 0, 0}, 1);
    EXPECT_EQ(limitation(mesh, Silhouette::Visible), std::nullopt);
    mesh.positions.push_back({9, 9, 9});
    mesh.triangles.push_back({0, 4, 8});
    for (const Silhouette s : {Silhouette::Triangular, Silhouette::Visible})
        EXPECT_THAT(limitation(mesh, s),
                    Optional(Eq("triangles 0 and 12 walk the same way along edge 0-4 from (-1, -1, -1) to "
                                "(-1, -1, 1)")));
    for (const Silhouette s : {Silhouette::Manifold, Silhouette::Winding, Silhouette::PerTriangle})
        EXPECT_EQ(limitation(mesh, s), std::nullopt);
}

TEST(Limitation, OfOpenMeshesIsNone) {
    Mesh mesh = cube({0, 0, 0}, 1);
    mesh.triangles.pop_back();
    EXPECT_EQ(limitation(mesh, Silhouette::Visible), std::nullopt);
}

TEST(Limitation, OfTwoSidedMeshesIsAnyBend) {
    const Mesh flat{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                    .triangles = {{0, 1, 2}, {2, 1, 3}}};
    EXPECT_EQ(limitation(flat, Silhouette::Visible, true), std::nullopt);
    Mesh bent = flat;
    bent.positions[3].z = 0.5f;
    EXPECT_EQ(limitation(bent, Silhouette::Visible), std::nullopt);
    EXPECT_THAT(limitation(bent, Silhouette::Visible, true), Optional(HasSubstr("edge 1-2 ")));
    Mesh folded = flat;  // in the plane, but back over the first triangle: the other way up
    folded.positions[3] = {0.25f, 0.25f, 0};
    EXPECT_THAT(limitation(folded, Silhouette::Visible, true), Optional(HasSubstr("edge 1-2 ")));
}

}  // namespace refusal_test
}  // namespace gnomon
