#include "scene/load.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "scene/framing.h"
#include "scene/view.h"
#include "tools.h"

namespace gnomon {
namespace load_test {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

/// A tetrahedron away from the origin.
constexpr const char* kMesh = "v 10 0 0\nv 12 0 0\nv 10 0 -2\nv 10 3 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

class LoadScene : public FolderTest {
  protected:
    std::filesystem::path m_mesh = write("mesh.obj", kMesh);
};

TEST_F(LoadScene, FramesAMeshWithoutCamera) {
    const Scene scene = loadScene(m_mesh);
    ASSERT_EQ(scene.frames.size(), 1u);
    const View view = viewOf(scene.frames[0], 512, 512);
    const glm::dmat4 clipFromWorld = clipFromEye(view) * eyeFromWorld(view);
    for (const glm::vec3& p : scene.objects[0].mesh.positions) {
        const glm::dvec4 clip = clipFromWorld * glm::dvec4(p, 1);
        EXPECT_LT(std::abs(clip.x), clip.w);
        EXPECT_LT(std::abs(clip.y), clip.w);
        EXPECT_GT(clip.w, 10 * view.nearPlane);
    }
    EXPECT_EQ(scene.id, m_mesh.string());
}

TEST_F(LoadScene, PutsTheDefaultLightOutsideAndAbove) {
    const Scene scene = loadScene(m_mesh);
    const Bounds bounds = boundsOf({scene.objects.data(), 1});
    ASSERT_EQ(scene.lights.size(), 1u);
    const glm::dvec3 light(scene.lights[0].position);
    EXPECT_GT(glm::distance(light, bounds.centre), 2 * bounds.radius);
    EXPECT_GT(light.y, bounds.most.y);
}

TEST_F(LoadScene, PutsAFloorBelowAMeshThatHasNone) {
    const Scene scene = loadScene(m_mesh);
    ASSERT_EQ(scene.objects.size(), 2u);
    const Object& ground = scene.objects[1];
    EXPECT_FALSE(ground.casts);
    EXPECT_FALSE(ground.twoSided);
    EXPECT_LT(ground.mesh.positions[0].y, 0);
    EXPECT_GT(ground.mesh.positions[0].y, -0.01f);
    EXPECT_EQ(loadScene(m_mesh, {.ground = false}).objects.size(), 1u);
}

TEST_F(LoadScene, KeepsTheFloorBelowWhereFloatIsCoarse) {
    const Scene scene = loadScene(write("far.obj", "v 0 1e7 0\nv 4 1e7 0\nv 0 10000004 0\nf 1 2 3\n"));
    EXPECT_LT(scene.objects[1].mesh.positions[0].y, 1e7f);
}

TEST_F(LoadScene, TakesLightFromOverrides) {
    EXPECT_EQ(loadScene(m_mesh, {.light = glm::vec4(1, 2, 3, 1)}).lights[0].position, glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(loadScene(m_mesh, {.light = glm::vec4(0, 3, 4, 0)}).lights[0].position,
              glm::vec4(0, 0.6f, 0.8f, 0));
}

TEST_F(LoadScene, TakesCameraFromOverrides) {
    const Scene scene = loadScene(m_mesh, {.eye = glm::vec3(11, 1, 9), .target = glm::vec3(11, 1, 0)});
    ASSERT_EQ(scene.frames.size(), 1u);
    EXPECT_EQ(scene.frames[0].eye, glm::vec3(11, 1, 9));
    EXPECT_EQ(scene.frames[0].target, glm::vec3(11, 1, 0));
    // Half way to the nearest surface: the floor, 1 and a little below the eye.
    EXPECT_NEAR(scene.frames[0].nearPlane, 0.5, 0.01);
    EXPECT_GT(scene.frames[0].nearPlane, 0.5);

    // The file's own camera may lie on its side; an eye that is placed by hand has y up.
    const auto rolled = write("rolled.toml",
                              "title = 'rolled'\n[light]\nposition = [0, 9, 0]\n[camera]\neye = [0, 1, 9]\n"
                              "target = [0, 0, 0]\nup = [1, 0, 0]\nnear = 1\n[[objects]]\nshape = 'box'\n");
    EXPECT_EQ(loadScene(rolled).frames[0].up, glm::vec3(1, 0, 0));
    EXPECT_EQ(loadScene(rolled, {.eye = glm::vec3(0, 1, 8)}).frames[0].up, glm::vec3(0, 1, 0));

    const Camera other = loadScene(m_mesh, {.fovDegrees = 90.f, .nearPlane = 0.5f}).frames[0];
    EXPECT_EQ(other.fovDegrees, 90);
    EXPECT_EQ(other.nearPlane, 0.5f);
}

TEST(BoundsOf, NothingAreAPoint) {
    EXPECT_EQ(boundsOf({}).radius, 0);
    EXPECT_EQ(boundsOf({}).centre, glm::dvec3(0));
}

TEST_F(LoadScene, LooksAtTheSceneWhereOnlyTheEyeIsGiven) {
    EXPECT_EQ(loadScene(m_mesh, {.eye = glm::vec3(0, 0, 50)}).frames[0].target, glm::vec3(11, 1.5f, -1));
}

TEST_F(LoadScene, RefusesSenselessOverrides) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                    kInf = std::numeric_limits<float>::infinity();
    const auto error = [&](const SceneOverrides& overrides) {
        return errorOf([&] { loadScene(m_mesh, overrides); });
    };
    EXPECT_EQ(error({.light = glm::vec4(1, 2, 3, 0.5f)}), "light: w is 0.5, not 0 or 1");
    EXPECT_EQ(error({.light = glm::vec4(0, 0, 0, 0)}), "light: the direction is zero");
    EXPECT_EQ(error({.light = glm::vec4(0, kNan, 0, 1)}), "light: coordinate is not finite");
    EXPECT_EQ(error({.light = glm::vec4(0, 0, 0, kNan)}), "light: coordinate is not finite");
    EXPECT_EQ(error({.eye = glm::vec3(kInf, 0, 0)}), "eye: coordinate is not finite");
    EXPECT_EQ(error({.eye = glm::vec3(1), .target = glm::vec3(1)}), "eye: the same point as the target");
    EXPECT_EQ(error({.fovDegrees = 180.f}), "fov: 180 is not between 0.01 and 179 degrees");
    EXPECT_EQ(error({.fovDegrees = kNan}), "fov: nan is not between 0.01 and 179 degrees");
    EXPECT_EQ(error({.nearPlane = 0.f}), "near: 0 is not a positive distance");
    EXPECT_EQ(error({.nearPlane = 1e-40f}), "near: 1e-40 is less than 1e-12");
    EXPECT_EQ(error({.nearPlane = kInf}), "near: inf is not a positive distance");
}

TEST_F(LoadScene, RefusesWhatIsNoSceneInOneLine) {
    std::filesystem::create_directories(m_folder / "folder.obj");
    EXPECT_THAT(errorOf([&] { loadScene(m_folder); }), EndsWith(": is a directory"));
    EXPECT_THAT(errorOf([&] { loadScene(m_folder / "folder.obj"); }), EndsWith("folder.obj: is a directory"));
    EXPECT_THAT(errorOf([&] { loadScene(m_folder / "none.ply"); }), EndsWith("none.ply: no such file"));
    EXPECT_THAT(errorOfFile("a.txt", "hello"), HasSubstr("a.txt: unknown kind of file"));
    EXPECT_THAT(errorOf([] { loadScene("/dev/null"); }), EndsWith("/dev/null: is no regular file"));
}

TEST_F(LoadScene, KnowsExtensionsInAnyCase) {
    EXPECT_EQ(triangleCount(loadScene(write("MESH.OBJ", kMesh))), 6u);
}

TEST_F(LoadScene, FindsScenesByIdOrFile) {
    write("b.toml", "");
    write("a.toml", "");
    EXPECT_THAT(sceneIds(m_folder), ElementsAre("a", "b"));
    EXPECT_EQ(findScene("a", m_folder), m_folder / "a.toml");
    EXPECT_EQ(findScene(m_mesh.string(), m_folder), m_mesh);
    EXPECT_EQ(errorOf([&] { findScene("c", m_folder); }), "c: neither a file nor a scene, known: a, b");
    EXPECT_TRUE(sceneIds(m_folder / "none").empty());
    EXPECT_TRUE(hardSceneIds(m_folder).empty());
}

TEST_F(LoadScene, FindsHardCasesInAFolderOfTheirOwn) {
    std::filesystem::create_directories(m_folder / "hard");
    write("a.toml", "");
    const auto file = write("hard/b.toml", "");
    EXPECT_THAT(sceneIds(m_folder), ElementsAre("a"));
    EXPECT_THAT(hardSceneIds(m_folder), ElementsAre("hard/b"));
    EXPECT_EQ(findScene("hard/b", m_folder), file);
    EXPECT_EQ(sceneIdOf(file), "hard/b");
    EXPECT_EQ(sceneIdOf(m_folder / "a.toml"), "a");
    EXPECT_EQ(errorOf([&] { findScene("hard/c", m_folder); }), "hard/c: no such hard case, known: hard/b");
    EXPECT_EQ(errorOf([&] { findScene("c", m_folder); }),
              "c: neither a file nor a scene, known: a, hard, all");
}

}  // namespace load_test
}  // namespace gnomon
