// Files that ask for too much: a line that names the limit, before the memory is taken or the time is spent.

#include "scene/limits.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "scene/mesh_file.h"
#include "scene/primitives.h"
#include "tools.h"

namespace gnomon {
namespace limits_test {

using testing::HasSubstr;

constexpr std::uintmax_t kHuge = 107'374'182'400;

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

class SceneLimit : public FolderTest {
  protected:
    /// A file that has a size, and no content.
    std::filesystem::path sparse(const std::string& name, std::uintmax_t size) const {
        const auto file = write(name, "");
        std::filesystem::resize_file(file, size);
        return file;
    }
    /// The error of loading a file with these limits, without the folder's name.
    std::string errorWith(const SceneLimits& limits, const std::filesystem::path& file) const {
        const std::string error = errorOf([&] { loadScene(file, {}, limits); });
        const std::string prefix = m_folder.string() + "/";
        return error.starts_with(prefix) ? error.substr(prefix.size()) : error;
    }
    std::string errorWith(const SceneLimits& limits, const std::string& name,
                          std::string_view content) const {
        return errorWith(limits, write(name, content));
    }
};

TEST_F(SceneLimit, OfBytesIsSaid) {
    for (const char* name : {"a.obj", "a.ply", "a.stl", "a.gltf", "a.glb", "a.txt"})
        EXPECT_EQ(errorWith({}, sparse(name, kHuge)),
                  fmt::format("{}: 107374182400 bytes, more than the 2147483648 that gnomon reads", name));
    EXPECT_EQ(errorWith({}, sparse("a.toml", 1'073'741'824)),
              "a.toml: 1073741824 bytes, more than the 16777216 that gnomon reads");
}

TEST_F(SceneLimit, OfTrianglesHoldsForMeshes) {
    const SceneLimits three{.triangles = 3};
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_EQ(errorWith(three, "a.obj", corners + repeated("f 1 2 3\n", 3)), "no error");
    EXPECT_EQ(errorWith(three, "a.obj", corners + repeated("f 1 2 3\n", 4)),
              "a.obj:7: more than the 3 triangles that gnomon takes");
    EXPECT_EQ(errorWith(three, "a.obj", corners + "f 1 2 3 1 2 3\n"),
              "a.obj:4: more than the 3 triangles that gnomon takes");
    EXPECT_EQ(errorWith(three, "a.obj", corners + "f 1 2 3\n" + repeated("p 1\n", 3)),
              "a.obj:7: more than the 3 triangles that gnomon takes");

    const auto ply = [](int faces, const char* face) {
        return fmt::format(
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                   "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n"
                   "0 0 0\n1 0 0\n0 1 0\n",
                   faces) +
               repeated(face, faces);
    };
    EXPECT_EQ(errorWith(three, "a.ply", ply(3, "3 0 1 2\n")), "no error");
    EXPECT_EQ(errorWith(three, "a.ply", ply(4, "3 0 1 2\n")),
              "a.ply:16: face 3: more than the 3 triangles that gnomon takes");
    EXPECT_EQ(errorWith(three, "a.ply", ply(10, "3 0 1 2\n")),
              "a.ply:7: announces 10 of 'face', more than the 9 that gnomon takes");

    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    EXPECT_EQ(errorWith(three, "a.stl", "solid\n" + repeated(facet, 3) + "endsolid\n"), "no error");
    EXPECT_EQ(errorWith(three, "a.stl", "solid\n" + repeated(facet, 4) + "endsolid\n"),
              "a.stl:29: more than the 3 triangles that gnomon takes");
    std::string binary(80, ' ');
    append(binary, std::uint32_t(4));
    EXPECT_EQ(errorWith(three, "b.stl", binary + std::string(200, '\0')),
              "b.stl: 4 triangles, more than the 3 that gnomon takes");
}

// Without one, a megabyte of spirals takes minutes.
TEST_F(SceneLimit, OfStepsHoldsForPolygonsThatAreHardToCut) {
    constexpr int kCorners = 500;
    std::string corners, face = "f";
    for (int i = 0; i < kCorners; ++i) {
        // Outwards along the spiral, and back beside it.
        const bool isBack = i >= kCorners / 2;
        const int k = isBack ? kCorners - 1 - i : i;
        const double angle = 0.25 * k, radius = (isBack ? 0.95 : 1) + 0.1 * k;
        corners += fmt::format("v {:.6f} {:.6f} 0\n", radius * std::cos(angle), radius * std::sin(angle));
        face += fmt::format(" {}", i + 1);
    }
    face += "\n";
    EXPECT_EQ(errorWith({}, "a.obj", corners + face), "no error");
    EXPECT_THAT(errorWith({.polygonSteps = 1000}, "a.obj", corners + face),
                HasSubstr("face 0: more than the 1000 steps to cut polygons that gnomon takes"));
    EXPECT_THAT(errorWith({.polygonSteps = 20'000'000}, "a.obj", corners + repeated(face, 1000)),
                HasSubstr("more than the 20000000 steps to cut polygons that gnomon takes"));
}

TEST_F(SceneLimit, OfAnnouncedTrianglesNeedsNoTriangle) {
    EXPECT_EQ(errorWith({}, "a.ply",
                        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                        "property float z\nelement face 4000000000\nproperty list uchar int vertex_indices\n"
                        "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
              "a.ply:7: announces 4000000000 of 'face', more than the file can hold");
    std::string glb = "glTF";
    for (const std::uint32_t word : {2u, 24u, 0xfffffff0u}) append(glb, word);
    EXPECT_EQ(errorWith({}, "a.glb", glb + "JSON{}  "),
              "a.glb: chunk 0 announces 4294967280 bytes, the file has 4 left");
}

TEST_F(SceneLimit, OfObjectsHoldsForObjFiles) {
    const SceneLimits two{.objects = 2};
    const std::string part = "o x\nf 1 2 3\n", corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_EQ(errorWith(two, "a.obj", corners + repeated(part, 2)), "no error");
    EXPECT_EQ(errorWith(two, "a.obj", corners + repeated(part, 3)),
              "a.obj:8: more than the 2 objects, groups and changes of material that gnomon takes");
}

/// A document of one triangle in buffer "b.bin", with this instead of its nodes.
std::string gltf(const std::string& nodes, const std::string& rest = {}) {
    return R"({"asset": {"version": "2.0"}, )" + nodes +
           R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 3}],
        "buffers": [{"byteLength": 39, "uri": "b.bin"}])" +
           rest + "}";
}

std::string buffer() {
    std::string bytes;
    for (const int value : {0, 0, 0, 1, 0, 0, 0, 1, 0}) append(bytes, float(value));
    return bytes + std::string("\0\1\2", 3);
}

TEST_F(SceneLimit, OfTrianglesCountsEveryInstance) {
    write("b.bin", buffer());
    const std::string three = gltf(R"("scenes": [{"nodes": [0, 1, 2]}], "nodes": [{"mesh": 0}, {"mesh": 0},
        {"mesh": 0}])");
    EXPECT_EQ(errorWith({.triangles = 3}, "a.gltf", three), "no error");
    EXPECT_EQ(errorWith({.triangles = 2}, "a.gltf", three),
              "a.gltf: more than the 6 vertices that gnomon takes");
    EXPECT_EQ(errorWith({.objects = 2}, "a.gltf", three),
              "a.gltf: more than the 2 objects that gnomon takes");
}

TEST_F(SceneLimit, OfVerticesHoldsWithoutABuffer) {
    const auto zeros = [](const char* count) {
        return fmt::format(R"({{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}],
            "nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
            "accessors": [{{"componentType": 5126, "count": {}, "type": "VEC3"}}]}})",
                           count);
    };
    EXPECT_EQ(errorWith({}, "a.gltf", zeros("200000000")),
              "a.gltf: accessor 0 announces 200000000 values, more than the 100663296 that gnomon takes");
    EXPECT_EQ(errorWith({.triangles = 3}, "a.gltf", zeros("12")),
              "a.gltf: accessor 0 announces 12 values, more than the 9 that gnomon takes");
}

TEST_F(SceneLimit, OfBytesHoldsForAllBuffersTogether) {
    const std::string nodes = R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])";
    sparse("b.bin", kHuge);
    EXPECT_EQ(errorWith({}, "a.gltf", gltf(nodes)),
              "a.gltf: buffer 0 of 107374182400 bytes, with which the buffers have more than the 2147483648 "
              "bytes that gnomon takes");
    // A thousand bytes, named twice.
    write("b.bin", buffer() + std::string(961, ' '));
    std::string twice = gltf(nodes);
    const std::string one = R"({"byteLength": 39, "uri": "b.bin"})",
                      thousand = R"({"byteLength": 1000, "uri": "b.bin"})";
    twice.replace(twice.find(one), one.size(), thousand + "," + thousand);
    EXPECT_EQ(errorWith({.meshBytes = 2000}, "a.gltf", twice), "no error");
    EXPECT_EQ(errorWith({.meshBytes = 1999}, "a.gltf", twice),
              "a.gltf: buffer 1 of 1000 bytes, with which the buffers have more than the 1999 bytes that "
              "gnomon takes");
}

TEST_F(SceneLimit, OfJsonHoldsForDepthAndNumber) {
    for (const char* open : {"[", "{\"a\":"})
        EXPECT_EQ(errorWith({}, "a.gltf", repeated(open, 1'000'000)), "a.gltf: JSON nested deeper than 200");
    EXPECT_EQ(errorWith({.jsonValues = 9}, "a.gltf", "[" + repeated("{},", 8) + "1]"),
              "a.gltf: more than the 9 JSON values that gnomon takes");
    EXPECT_EQ(errorWith({.jsonValues = 10}, "a.gltf", "[" + repeated("{},", 8) + "1]"),
              "a.gltf: the JSON is no object");
    // Which took minutes: json::parse() with a callback looks through the array for each of its objects.
    EXPECT_EQ(errorWith({}, "a.gltf", "[" + repeated("{},", 1'000'000) + "1]"),
              "a.gltf: the JSON is no object");
}

TEST_F(SceneLimit, OfJsonHoldsWhicheverOfTwoKeysAReaderTakes) {
    EXPECT_EQ(errorWith({}, "a.gltf", R"({"asset": {"version": "2.0", "version": "1.0"}})"),
              "a.gltf: the JSON has a key 'version' twice");
    write("b.bin", buffer());
    EXPECT_EQ(errorWith({}, "a.gltf",
                        gltf(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])",
                             R"(, "extras": [{"a": 1}, {"a": 2}])")),
              "no error");
}

TEST_F(SceneLimit, OfNodesIsThatEachIsShownOnce) {
    write("b.bin", buffer());
    EXPECT_EQ(errorWith({}, "a.gltf", gltf(R"("scenes": [{"nodes": [0, 0]}], "nodes": [{"mesh": 0}])")),
              "a.gltf: scene names node 0 twice");
    EXPECT_EQ(errorWith({}, "a.gltf",
                        gltf(R"("scenes": [{"nodes": [0, 1]}], "nodes": [{"children": [1]}, {"mesh": 0}])")),
              "a.gltf: scene names node 1, which is no root");
}

const std::string kHead = "light = { position = [1, 5, 1] }\n[camera]\neye = [0, 0, 5]\n";

TEST_F(SceneLimit, OfTrianglesIsAskedBeforeAShapeIsMade) {
    const std::string most = "[[objects]]\nsegments = 100000\nshape = ";
    for (const char* shape :
         {"\"torus\"\nsides = 100000\n", "\"knot\"\nsides = 100000\n", "\"sphere\"\nrings = 100000\n",
          "\"cylinder\"\nrepeat = { count = 10000, step = "
          "[0, 0, 0] }\n"})
        EXPECT_EQ(errorWith({}, "a.toml", kHead + most + shape),
                  "a.toml:4: more than the 33554432 triangles that gnomon takes")
            << shape;
    const std::string boxes =
        kHead + "[[objects]]\nshape = \"box\"\nrepeat = { count = 3, step = [2, 0, 0] }\n";
    EXPECT_EQ(errorWith({.triangles = 36}, "a.toml", boxes), "no error");
    EXPECT_EQ(errorWith({.triangles = 35}, "a.toml", boxes),
              "a.toml:4: more than the 35 triangles that gnomon takes");
    EXPECT_EQ(errorWith({.objects = 2}, "a.toml", boxes),
              "a.toml:4: more than the 2 objects that gnomon takes");
    EXPECT_EQ(errorWith({.objects = 5}, "a.toml", boxes + boxes.substr(kHead.size())),
              "a.toml:7: more than the 5 objects that gnomon takes");
}

TEST_F(SceneLimit, OfTrianglesIsTheNumberThatAShapeHas) {
    const std::pair<const char*, Mesh> cases[] = {
        {"shape = \"box\"", box(glm::dvec3(1))},
        {"shape = \"rectangle\"", rectangle(glm::dvec2(1))},
        {"shape = \"cylinder\"\nsegments = 5", cylinder(1, 1, 5)},
        {"shape = \"sphere\"\nsegments = 5\nrings = 4", sphere(1, 5, 4)},
        {"shape = \"torus\"\nsegments = 5\nsides = 4", torus(1, 0.3, 5, 4)},
        {"shape = \"knot\"\nsegments = 16\nsides = 4", torusKnot({.segments = 16, .sides = 4})},
        {"shape = \"triangles\"\nvertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ntriangles = [[0, 1, 2]]",
         Mesh{}},
    };
    for (const auto& [shape, mesh] : cases) {
        const std::size_t triangles = std::max<std::size_t>(1, mesh.triangles.size());
        const std::string content = kHead + "[[objects]]\n" + shape + "\n";
        EXPECT_EQ(errorWith({.triangles = triangles}, "a.toml", content), "no error") << shape;
        EXPECT_THAT(errorWith({.triangles = triangles - 1}, "a.toml", content), HasSubstr("more than the"))
            << shape;
    }
}

TEST_F(SceneLimit, OfTrianglesHoldsForMeshesInScenes) {
    write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\n");
    const std::string content =
        kHead + "[[objects]]\nshape = \"mesh\"\nfile = \"m.obj\"\nrepeat = { count = 3, step = [2, 0, 0] }\n";
    EXPECT_EQ(errorWith({.triangles = 6}, "a.toml", content), "no error");
    EXPECT_EQ(errorWith({.triangles = 5}, "a.toml", content),
              "a.toml:4: more than the 5 triangles that gnomon takes");
    EXPECT_THAT(errorWith({.triangles = 1}, "a.toml", content),
                HasSubstr("m.obj:5: more than the 1 triangles that gnomon takes"));
}

TEST_F(SceneLimit, OfDepthHoldsForValuesAndKeys) {
    EXPECT_THAT(errorWith({}, "a.toml", "x = " + std::string(1'000'000, '[')), HasSubstr("a.toml:1: "));
    const std::string key = repeated("a.", 500'000) + "a";
    for (const std::string& content : {key + " = 1\n", "[" + key + "]\n", "x = { " + key + " = 1 }\n"})
        EXPECT_EQ(errorWith({}, "a.toml", content), "a.toml:1: a key of more than 16 parts");
}

TEST_F(SceneLimit, OfATextIsALine) {
    EXPECT_EQ(errorWith({}, "a.toml", "title = \"a\\nb\"\n" + kHead + "[[objects]]\nshape = \"box\"\n"),
              "a.toml:1: 'title' must be one line");
    EXPECT_EQ(errorWith({}, "a.toml", kHead + "[[objects]]\nshape = \"box\"\nname = \"\\u001b[2J\"\n"),
              "a.toml:6: 'name' must be one line");
}

TEST_F(SceneLimit, OfADirectionIsThatFloatHasItsSquare) {
    EXPECT_EQ(
        errorWith({}, "a.toml",
                  "objects = []\nlight = { direction = [0, 1e-162, 0] }\ncamera = { eye = [0, 0, 5] }\n"),
        "a.toml:2: 'direction' must not be zero");
    EXPECT_EQ(errorWith({}, "a.toml",
                        "objects = []\nlights = []\ncamera = { eye = [0, 0, 5], up = [1e-45, 0, 0] }\n"),
              "a.toml:3: 'up' must not be zero");
    // The eye turns about an axis on which it lies, as far as float can tell.
    EXPECT_EQ(errorWith({}, "a.toml",
                        "objects = []\nlight = { position = [1, 5, 1] }\n[camera]\neye = [1e8, 0, 5]\n"
                        "target = [1e8, 0, 1]\norbit = { frames = 4, axis = [0, 1, 0] }\n"),
              "a.toml:4: 'eye' must differ from 'target', but doesn't in frame 1");
}

TEST_F(SceneLimit, OfAMeshIsThatFloatHasTheSquareOfItsSize) {
    const auto triangle = [](const char* size) {
        return fmt::format("v 0 0 0\nv {0} 0 0\nv 0 {0} 0\nf 1 2 3\n", size);
    };
    EXPECT_EQ(errorWith({}, "a.obj", triangle("1e-17")), "no error");
    EXPECT_EQ(errorWith({}, "a.obj", triangle("1e-45")),
              "a.obj: all of it lies within 9.90868e-46 of one point (at least 1e-18)");
}

TEST_F(SceneLimit, OfGltfLightsAndCamerasIsThatOneCanDrawWithThem) {
    write("b.bin", buffer());
    const auto withLight = [](const char* colour) {
        return gltf(R"("scenes": [{"nodes": [0]}],
                       "nodes": [{"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}])",
                    fmt::format(R"(, "extensions": {{"KHR_lights_punctual": {{"lights": [
                                   {{"type": "point", "color": [1, {}, 0.5]}}]}}}})",
                                colour));
    };
    EXPECT_EQ(errorWith({}, "a.gltf", withLight("1")), "no error");
    EXPECT_EQ(errorWith({}, "a.gltf", withLight("1e300")), "a.gltf: light 0 has a color of 1e+300");
    EXPECT_EQ(errorWith({}, "a.gltf", withLight("-1")), "a.gltf: light 0 has a color of -1");
    const auto withCamera = [](const char* fov) {
        return gltf(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "camera": 0}])",
                    fmt::format(R"(, "cameras": [{{"type": "perspective", "perspective":
                                   {{"yfov": {}, "znear": 1}}}}])",
                                fov));
    };
    EXPECT_EQ(errorWith({}, "a.gltf", withCamera("1")), "no error");
    EXPECT_EQ(errorWith({}, "a.gltf", withCamera("1e-300")), "a.gltf: camera 0 has a yfov of 1e-300");
    EXPECT_EQ(errorWith({}, "a.gltf", withCamera("3.1415926")), "a.gltf: camera 0 has a yfov of 3.1415926");
}

}  // namespace limits_test
}  // namespace gnomon
