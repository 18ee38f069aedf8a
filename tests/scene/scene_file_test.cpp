#include "scene/scene_file.h"

#include <gmock/gmock.h>

#include "scene/load.h"
#include "tools.h"

namespace gnomon {
namespace {

using testing::HasSubstr;

constexpr const char* kGood = R"(title = "a box"
[light]
position = [1, 5, 2]
[camera]
eye = [0, 2, 8]
[[objects]]
shape = "box"
)";

using SceneFile = FolderTest;

TEST_F(SceneFile, FillsInDefaults) {
    const Scene scene = loadScene(write("a box.toml", kGood));
    EXPECT_EQ(scene.id, "a box");
    EXPECT_EQ(scene.title, "a box");
    EXPECT_EQ(triangleCount(scene), 12u);
    EXPECT_EQ(scene.objects[0].name, "box");
    EXPECT_TRUE(scene.objects[0].casts);
    EXPECT_FALSE(scene.objects[0].twoSided);
    EXPECT_EQ(scene.frames.size(), 1u);
    EXPECT_EQ(scene.lights[0].position, glm::vec4(1, 5, 2, 1));
    EXPECT_TRUE(scene.notes.empty());
}

TEST_F(SceneFile, OrbitsAFullTurnAboutTheAxisThroughTheTarget) {
    std::string text = kGood;
    text.replace(text.find("eye = [0, 2, 8]"), 15,
                 "eye = [1, 2, 8]\ntarget = [1, 0, 0]\norbit = { frames = 4, axis = [0, 1, 0] }");
    const Scene scene = loadScene(write("orbit.toml", text));
    ASSERT_EQ(scene.frames.size(), 4u);
    const glm::vec3 eyes[] = {{1, 2, 8}, {9, 2, 0}, {1, 2, -8}, {-7, 2, 0}};
    for (int f = 0; f < 4; ++f) {
        EXPECT_LT(glm::distance(scene.frames[f].eye, eyes[f]), 1e-6f) << "float's rounding near 8 is 5e-7";
        EXPECT_EQ(scene.frames[f].target, glm::vec3(1, 0, 0));
    }
}

TEST_F(SceneFile, ScalesThenRotatesThenMovesObjects) {
    const std::string text = std::string(kGood) +
                             "size = [2, 4, 6]\nscale = 0.5\nrotate = [0, 0, 1, 90]\nat = [10, 0, 0]\n"
                             "name = \"b\"\ncolour = [1, 0.5, 0]\ncasts = false\ntwo_sided = true\n";
    const Object object = loadScene(write("turned.toml", text)).objects[0];
    glm::vec3 least = object.mesh.positions[0], most = least;
    for (const glm::vec3& p : object.mesh.positions) {
        least = glm::min(least, p);
        most = glm::max(most, p);
    }
    EXPECT_LT(glm::distance(least, glm::vec3(9, -0.5f, -1.5f)), 1e-6f);
    EXPECT_LT(glm::distance(most, glm::vec3(11, 0.5f, 1.5f)), 1e-6f);
    EXPECT_EQ(object.name, "b");
    EXPECT_EQ(object.colour, glm::vec3(1, 0.5f, 0));
    EXPECT_FALSE(object.casts);
    EXPECT_TRUE(object.twoSided);
    EXPECT_EQ(openEdges(object.mesh), 0);
}

TEST_F(SceneFile, NormalisesDirectionsAndTakesManyLights) {
    std::string text = kGood;
    text.replace(text.find("[light]"), 7, "[[lights]]\ndirection = [0, 3, 4]\n[[lights]]");
    const Scene scene = loadScene(write("lights.toml", text));
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].position, glm::vec4(0, 0.6f, 0.8f, 0));
    EXPECT_THAT(scene.notes, testing::IsEmpty());
}

TEST_F(SceneFile, KnowsAllShapes) {
    std::string text = kGood;
    for (const char* shape : {"rectangle", "cylinder", "sphere", "torus", "knot"})
        text += std::string("[[objects]]\nshape = \"") + shape + "\"\n";
    EXPECT_EQ(loadScene(write("shapes.toml", text)).objects.size(), 6u);
}

TEST_F(SceneFile, TakesMeshFilesRelativeToItself) {
    std::filesystem::create_directories(m_folder / "meshes");
    write("meshes/one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\n");
    const std::string text =
        std::string(kGood) +
        "[[objects]]\nname = \"m\"\nshape = \"mesh\"\nfile = \"meshes/one.obj\"\nscale = 2\n";
    const Scene scene = loadScene(write("mesh.toml", text));
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[1].name, "m");
    EXPECT_EQ(scene.objects[1].mesh.positions[1], glm::vec3(2, 0, 0));
    EXPECT_THAT(scene.notes,
                testing::ElementsAre(
                    "meshes/one.obj: 1 degenerate triangle dropped (1 repeat a vertex, 0 have no area)"));
}

TEST_F(SceneFile, NamesFileAndLineOfErrors) {
    struct Case {
        std::string find, replace, error;
    };
    const Case cases[] = {
        {"title", "titel", "s.toml:1: unknown key 'titel' in a scene"},
        {"\"a box\"", "7", "s.toml:1: 'title' must be a string"},
        {"\"a box\"", "\"a box", "s.toml:1: "},
        {"position = [1, 5, 2]", "position = [1, 5]", "s.toml:3: 'position' must be an array of 3 numbers"},
        {"position = [1, 5, 2]", "position = [1, nan, 2]",
         "s.toml:3: 'position' must be from -1e+15 to 1e+15"},
        {"position = [1, 5, 2]", "position = [1, \"5\", 2]", "s.toml:3: 'position' must be a number"},
        {"position = [1, 5, 2]", "direction = [0, 0, 0]", "s.toml:3: 'direction' must not be zero"},
        {"position = [1, 5, 2]", "", "s.toml:2: a light needs either position or direction"},
        {"eye = [0, 2, 8]", "eye = [0, 0, 0]", "s.toml:5: 'eye' must differ from 'target'"},
        {"eye = [0, 2, 8]", "", "s.toml:4: 'eye' is missing"},
        {"eye = [0, 2, 8]", "eye = [0, 2, 8]\nfov = 180", "s.toml:6: 'fov' must be from 0.01 to 179"},
        {"eye = [0, 2, 8]", "eye = [0, 2, 8]\nnear = 0", "s.toml:6: 'near' must be positive"},
        {"eye = [0, 2, 8]", "eye = [0, 2, 8]\norbit = { frames = 0 }",
         "s.toml:6: 'frames' must be a whole number from 1 to 100000"},
        {"shape = \"box\"", "shape = \"cone\"", "s.toml:7: unknown shape 'cone'"},
        {"shape = \"box\"", "shape = \"box\"\nradius = 1", "s.toml:8: unknown key 'radius' in shape \"box\""},
        {"shape = \"box\"", "shape = \"box\"\nsize = [1, 0, 1]", "s.toml:8: 'size' must be positive"},
        {"shape = \"box\"", "shape = \"box\"\ncasts = 1", "s.toml:8: 'casts' must be true or false"},
        {"shape = \"box\"", "shape = \"box\"\ncolour = [0, 0, 2]", "s.toml:8: 'colour' must be from 0 to 1"},
        {"shape = \"box\"", "shape = \"box\"\nrotate = [0, 0, 0, 5]",
         "s.toml:8: 'rotate' needs an axis that isn't zero"},
        {"shape = \"box\"", "shape = \"knot\"\np = 2\nq = 4",
         "s.toml:6: 'p' and 'q' must have no common divisor"},
        {"shape = \"box\"", "shape = \"cylinder\"\nsegments = 2.5",
         "s.toml:8: 'segments' must be a whole number from 3 to 100000"},
        {"shape = \"box\"", "shape = \"mesh\"\nfile = \"a.txt\"",
         "s.toml:8: 'file' must be .obj, .ply, .stl, .gltf or .glb"},
        {"[[objects]]\nshape = \"box\"\n", "", "s.toml:1: 'objects' is missing"},
    };
    for (const Case& c : cases) {
        std::string text = kGood;
        text.replace(text.find(c.find), c.find.size(), c.replace);
        EXPECT_THAT(errorOfFile("s.toml", text), testing::StartsWith(c.error)) << c.replace;
    }
}

TEST_F(SceneFile, PassesOnWhatIsWrongWithAMesh) {
    write("bad.obj", "v 0 0 0\nf 1 2\n");
    const std::string text = std::string(kGood) + "[[objects]]\nshape = \"mesh\"\nfile = \"bad.obj\"\n";
    EXPECT_THAT(errorOfFile("s.toml", text), testing::AllOf(testing::StartsWith("s.toml:10: "),
                                                            HasSubstr("bad.obj:2: face has 2 corners")));
}

TEST_F(SceneFile, MayNotBeEmpty) {
    EXPECT_THAT(errorOfFile("s.toml", ""), testing::StartsWith("s.toml:1: "));
}

}  // namespace
}  // namespace gnomon
