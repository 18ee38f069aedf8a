#include "scene/scene_file.h"

#include <gmock/gmock.h>

#include "scene/load.h"
#include "tools.h"

namespace gnomon {
namespace scene_file_test {

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

constexpr const char* kTriangles = R"([[objects]]
shape = "triangles"
vertices = [[0, 0, 0], [2, 0, 0], [-0.0, 2, 0.0], [0, 2, -0.0], [2, 2, 0], [1, 0, 0]]
triangles = [[0, 1, 2], [1, 4, 3], [0, 1, 2], [1, 1, 4], [0, 5, 1]]
)";

// Vertices at 0 and -0.0 are one; copies stay; what has no area goes.
TEST_F(SceneFile, TakesTrianglesAsTheyAre) {
    const Scene scene = loadScene(write("t.toml", std::string(kGood) + kTriangles));
    ASSERT_EQ(scene.objects.size(), 2u);
    const Mesh& mesh = scene.objects[1].mesh;
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.triangles.size(), 3u);
    EXPECT_EQ(scene.dropped.repeatedVertex, 1u);
    EXPECT_EQ(scene.dropped.flat.size(), 1u);
    EXPECT_EQ(scene.objects[1].name, "triangles");
}

TEST_F(SceneFile, RepeatsObjectsStepByStep) {
    const std::string text =
        std::string(kGood) + "name = 'b'\nat = [1, 0, 0]\nrepeat = { count = 3, step = [0, 0.5, 2] }\n";
    const Scene scene = loadScene(write("r.toml", text));
    ASSERT_EQ(scene.objects.size(), 3u);
    EXPECT_EQ(scene.objects[0].name, "b 1");
    EXPECT_EQ(scene.objects[2].name, "b 3");
    for (std::size_t v = 0; v < 8; ++v)
        EXPECT_EQ(scene.objects[2].mesh.positions[v],
                  scene.objects[0].mesh.positions[v] + glm::vec3(0, 1, 4));
}

TEST_F(SceneFile, MayHaveNoObjectsAndNoLights) {
    const Scene scene = loadScene(write("e.toml", "lights = []\nobjects = []\n[camera]\neye = [0, 2, 8]\n"));
    EXPECT_TRUE(scene.objects.empty());
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_FALSE(scene.chosenLight);
    EXPECT_EQ(triangleCount(scene), 0u);
    const auto file = write("e2.toml", "lights = []\nobjects = []\n[camera]\neye = [0, 2, 8]\nnear = 0.5\n");
    const Scene moved = loadScene(file, {.light = glm::vec4(1, 2, 3, 1), .eye = glm::vec3(1, 2, 3)});
    EXPECT_EQ(moved.lights.size(), 1u);
    EXPECT_EQ(moved.frames[0].nearPlane, 0.5f) << "nothing is there to keep it from";
    EXPECT_EQ(errorOf([&] { loadScene(file, {.ground = true}); }),
              "ground: nothing is there to put a floor below");
    EXPECT_EQ(errorOfFile(
                  "n.toml",
                  std::string(kGood).substr(0, std::string(kGood).find("[[objects]]")) +
                      "[[objects]]\nshape = 'triangles'\nvertices = [[0, 0, 0]]\ntriangles = [[0, 0, 0]]\n"),
              "n.toml:1: no triangle left");
}

constexpr const char* kHard = R"([hard]
family = "eyes"
what = "hard to see"
source = "ours"
fails = [{ method = "heidmann", cause = "eye inside a volume" }]
exact = [
    { method = "carmack", profile = "tnt", fidelity = "chip", dither = true, frame = 2, size = [64, 48], levels = 3, mask_scale = "1/2", offset = 0.5 },
]
)";

TEST_F(SceneFile, TakesPromisesOfHardCases) {
    EXPECT_FALSE(loadScene(write("plain.toml", kGood)).hard);
    const HardCase hard = *loadScene(write("h.toml", std::string(kGood) + kHard)).hard;
    EXPECT_EQ(hard.family, "eyes");
    EXPECT_EQ(hard.what, "hard to see");
    EXPECT_EQ(hard.source, "ours");
    ASSERT_EQ(hard.fails.size(), 1u);
    EXPECT_EQ(hard.fails[0].cause, "eye inside a volume");
    EXPECT_EQ(hard.fails[0].line, 12u);
    EXPECT_EQ(argumentsOf(hard.fails[0]), "--method heidmann --profile ideal");
    ASSERT_EQ(hard.exact.size(), 1u);
    EXPECT_EQ(
        argumentsOf(hard.exact[0]),
        "--method carmack --profile tnt --levels 3 --mask-scale 1/2 --offset 0.5 --fidelity chip --dither on "
        "--frame 2 --size 64x48");
}

TEST_F(SceneFile, NamesFileAndLineOfErrorsInTrianglesAndHardCases) {
    struct Case {
        std::string find, replace, error;
    };
    const Case cases[] = {
        {"[0, 5, 1]", "[0, 6, 1]", "s.toml:11: 'triangles' must be from 0 to 5"},
        {"[0, 5, 1]", "[0, -1, 1]", "s.toml:11: 'triangles' must be from 0 to 5"},
        {"[0, 5, 1]", "[0, 1.5, 1]", "s.toml:11: 'triangles' must be whole numbers"},
        {"[0, 5, 1]", "[0, 5]", "s.toml:11: 'triangles' must be arrays of 3 numbers"},
        {"[2, 2, 0]", "[2, nan, 0]", "s.toml:10: 'vertices' must be from -1e+15 to 1e+15"},
        {"[2, 2, 0]", "2", "s.toml:10: 'vertices' must be arrays of 3 numbers"},
        {"[2, 2, 0]", "[2, 'x', 0]", "s.toml:10: 'vertices' must be a number"},
        {"shape = \"box\"", "shape = \"box\"\nrepeat = { count = 0, step = [0, 0, 0] }",
         "s.toml:8: 'count' must be a whole number from 1 to 10000"},
        {"shape = \"box\"", "shape = \"box\"\nrepeat = { count = 2 }", "s.toml:8: 'step' is missing"},
        {"shape = \"box\"", "shape = \"box\"\nrepeat = { step = [0, 0, 0] }", "s.toml:8: 'count' is missing"},
        {"shape = \"box\"", "shape = \"box\"\nrepeat = { count = 2, step = [0, 0, 0], turn = 1 }",
         "s.toml:8: unknown key 'turn' in repeat"},
        {"family = \"eyes\"", "familiy = \"eyes\"", "s.toml:13: unknown key 'familiy' in [hard]"},
        {"family = \"eyes\"", "family = \"\"", "s.toml:13: 'family' must be one line"},
        {"what = \"hard to see\"", "", "s.toml:12: 'what' is missing"},
        {"eye inside a volume", "", "s.toml:16: 'cause' must not be empty"},
        {", cause = \"eye inside a volume\"", "", "s.toml:16: 'cause' is missing"},
        {"method = \"carmack\"", "method = \"carmack\", cause = \"far plane\"",
         "s.toml:18: unknown key 'cause' in a cell of 'exact'"},
        {"levels = 3", "level = 3", "s.toml:18: unknown key 'level' in a cell of 'exact'"},
        {"levels = 3", "levels = [3]", "s.toml:18: 'levels' must be a string or a number"},
        {"fidelity = \"chip\"", "fidelity = \"chips\"", "s.toml:18: 'fidelity' must be gl or chip"},
        {"dither = true", "dither = \"on\"", "s.toml:18: 'dither' must be true or false"},
        {"size = [64, 48]", "size = [64]", "s.toml:18: 'size' must be an array of 2 numbers"},
        {"fails = [{", "fails = [3, {", "s.toml:16: 'fails' must be tables: [[fails]]"},
    };
    for (const Case& c : cases) {
        std::string text = std::string(kGood) + kTriangles + kHard;
        text.replace(text.find(c.find), c.find.size(), c.replace);
        EXPECT_EQ(errorOfFile("s.toml", text), c.error) << c.replace;
    }
}

TEST_F(SceneFile, MayNotBeEmpty) {
    EXPECT_THAT(errorOfFile("s.toml", ""), testing::StartsWith("s.toml:1: "));
}

}  // namespace scene_file_test
}  // namespace gnomon
