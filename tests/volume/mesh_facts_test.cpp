#include "volume/mesh_facts.h"

#include <gmock/gmock.h>

#include "scene/primitives.h"
#include "scene/weld.h"
#include "shapes.h"

namespace gnomon {
namespace mesh_facts_test {

using testing::HasSubstr;

/// Both halves of the triangles of a box, as objects of their own.
Scene halvedBox() {
    Scene scene;
    const Mesh whole = box({2, 2, 2});
    for (int part = 0; part < 2; ++part) {
        Mesh half = whole;
        half.triangles.assign(whole.triangles.begin() + 6 * part, whole.triangles.begin() + 6 * (part + 1));
        scene.objects.push_back({.name = part == 0 ? "left" : "right", .mesh = half});
    }
    return scene;
}

TEST(MeshFacts, OfAClosedMeshSuitsEveryBuilder) {
    const MeshFacts facts = meshFacts(sceneOf(torus(2, 0.5, 16, 8)), 0);
    ASSERT_EQ(facts.builders.size(), std::size_t(kSilhouettes));
    for (const BuilderFacts& builder : facts.builders) {
        EXPECT_FALSE(builder.refusal);
        EXPECT_FALSE(builder.limitation);
    }
    EXPECT_FALSE(facts.awayRefusal);
    EXPECT_EQ(facts.file.genus(), 1);
    EXPECT_EQ(facts.byObject.edges, facts.drawn.edges);
}

TEST(MeshFacts, SeparatesTheWholeFromItsObjects) {
    Scene scene = halvedBox();
    scene.objects.push_back({.mesh = rectangle({9, 9}), .casts = false});
    const MeshFacts facts = meshFacts(scene, 0);
    EXPECT_EQ(describe(facts.drawn), "closed manifold, genus 0");
    EXPECT_EQ(facts.objects.size(), 2u);
    EXPECT_EQ(facts.leftOut, 1u);
    EXPECT_EQ(facts.byObject.triangles, 12u);
    EXPECT_GT(facts.byObject.boundaryEdges(), 0u);
    ASSERT_TRUE(facts.builders[int(Silhouette::Manifold)].refusal);
    EXPECT_THAT(*facts.builders[int(Silhouette::Manifold)].refusal, HasSubstr("object 0 (left)"));
    EXPECT_TRUE(facts.awayRefusal);
}

TEST(MeshFacts, NamesTheObjectWhereASilhouetteMayBeWrong) {
    Scene scene = sceneOf(cube({0, 0, 0}, 1));
    scene.objects.push_back({.name = "turned", .mesh = cube({5, 0, 0}, 1)});
    glm::uvec3& t = scene.objects[1].mesh.triangles[0];
    std::swap(t.x, t.y);
    const MeshFacts facts = meshFacts(scene, 0);
    for (const Silhouette silhouette : {Silhouette::Triangular, Silhouette::Visible}) {
        const BuilderFacts& builder = facts.builders[std::size_t(silhouette)];
        EXPECT_FALSE(builder.refusal);
        ASSERT_TRUE(builder.limitation);
        EXPECT_THAT(*builder.limitation, HasSubstr("object 1 (turned)"));
    }
    EXPECT_FALSE(facts.builders[int(Silhouette::Winding)].limitation);
}

// From anywhere in the open a cube shows 2 to 6 triangles of one to three faces.
TEST(MeshFacts, RingStandsAroundTheBox) {
    Scene scene = sceneOf(cube({10, 20, 30}, 1));
    scene.chosenLight = true;
    scene.lights = {{}};
    const MeshFacts facts = meshFacts(scene, 8);
    ASSERT_EQ(facts.lightSets.size(), 1u) << "a light of the loader's choice says nothing of the file";
    const LightSet& ring = facts.lightSets[0];
    ASSERT_EQ(ring.lights.size(), 8u);
    const float radius = std::sqrt(3.0f);
    for (const Light& light : ring.lights) {
        EXPECT_FLOAT_EQ(light.position.y, 20 + radius);
        EXPECT_FLOAT_EQ(std::hypot(light.position.x - 10, light.position.z - 30), 2 * radius);
        EXPECT_EQ(light.position.w, 1);
    }
    const auto caps = [](const VolumeCount& c) { return c.caps; };
    EXPECT_EQ(spread(ring, Silhouette::Winding, caps).least, 6u) << "top and two walls";
    EXPECT_EQ(spread(ring, Silhouette::Winding, caps).sum, 8 * 6u);
    EXPECT_THAT(ring.title, HasSubstr("8 point lights around (10, 20, 30)"));
}

TEST(MeshFacts, CountsForTheLightsOfTheScene) {
    Scene scene = sceneOf(cube({0, 0, 0}, 1));
    scene.lights = {{.position = {5, 5, 5, 1}}, {.position = {0, 1, 0, 0}}, {.position = {0, 0, 0, 1}}};
    const MeshFacts facts = meshFacts(scene, 0);
    ASSERT_EQ(facts.lightSets.size(), 1u);
    const LightSet& set = facts.lightSets[0];
    const CountSpread sides = spread(set, Silhouette::Winding, [](const VolumeCount& c) { return c.sides; });
    // Three faces, the top face, and none from within.
    EXPECT_EQ(sides.least, 0u);
    EXPECT_EQ(sides.median, 4u);
    EXPECT_EQ(sides.most, 6u);
    EXPECT_EQ(sides.sum, 10u);
    EXPECT_THAT(set.title, HasSubstr("2 point and 1 directional"));
}

TEST(CountSpread, OfNoLightIsZero) {
    EXPECT_EQ(spread({}, Silhouette::Winding, [](const VolumeCount& c) { return c.caps; }).sum, 0u);
}

}  // namespace mesh_facts_test
}  // namespace gnomon
