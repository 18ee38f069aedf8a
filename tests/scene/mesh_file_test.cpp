#include "scene/mesh_file.h"

#include <gmock/gmock.h>

#include <bit>

#include "tools.h"

namespace gnomon {
namespace mesh_file_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

using ObjFile = FolderTest;
using PlyFile = FolderTest;
using StlFile = FolderTest;
using GltfFile = FolderTest;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string base64(const std::string& bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
    }
    return out;
}

TEST_F(ObjFile, NamesLineOfWhatIsWrong) {
    const std::string v = kTriangle;
    EXPECT_EQ(errorOfFile("a.obj", v + "f 1 2\n"), "a.obj:4: face has 2 corners, at least 3 needed");
    EXPECT_EQ(errorOfFile("a.obj", v + "f 1 2 0\n"), "a.obj:4: face index 0; they start at 1");
    EXPECT_EQ(errorOfFile("a.obj", v + "\nf 1 2 4\n"),
              "a.obj:5: face index 4 is out of range, 3 vertices in the file");
    EXPECT_EQ(errorOfFile("a.obj", v + "f -1 -2 -4\n"),
              "a.obj:4: face index -4 is out of range, 3 vertices so far");
    EXPECT_EQ(errorOfFile("a.obj", v + "f 1 2 x\n"), "a.obj:4: 'x' is no face corner");
    EXPECT_EQ(errorOfFile("a.obj", v + "v 1 nan 2\n"), "a.obj:4: coordinate is not finite");
    EXPECT_EQ(errorOfFile("a.obj", v + "v 1 1e400 2\n"), "a.obj:4: coordinate is not finite");
    EXPECT_EQ(errorOfFile("a.obj", v + "v 1 2 1e19\n"),
              "a.obj:4: coordinate 1e+19 is too large (at most 1e+15)");
    EXPECT_EQ(errorOfFile("a.obj", v + "v 1 2\n"), "a.obj:4: vertex has 2 coordinates, not 3");
    EXPECT_EQ(errorOfFile("a.obj", v), "a.obj: no triangle");
    EXPECT_EQ(errorOfFile("a.obj", v + "f 1 1 2\n"), "a.obj: no triangle left");
    EXPECT_EQ(errorOfFile("a.obj", ""), "a.obj: empty file");
}

TEST_F(ObjFile, MayNameVerticesThatComeLater) {
    const MeshFile mesh = loadMeshFile(write("a.obj", "f 1 2 3\n" + std::string(kTriangle)));
    EXPECT_EQ(mesh.objects[0].mesh.triangles.size(), 1u);
}

TEST_F(ObjFile, CutsPolygonsAndSaysWhatItDropped) {
    const MeshFile mesh = loadMeshFile(
        write("Größe.obj", std::string(kTriangle) + "v 2 0 0\nf 4 3 1 2\nf 1 2 4\nf 1 1 3\nf 1 2 3\n"));
    EXPECT_EQ(mesh.objects[0].mesh.triangles.size(), 3u);
    EXPECT_THAT(mesh.notes,
                ElementsAre("2 degenerate triangles dropped (1 repeat a vertex, 1 have no area)"));
}

TEST_F(ObjFile, HasOneObjectPerMaterialWithItsColour) {
    write("m.mtl", "newmtl red\nKd 0.9 0.1 0.2\nnewmtl black\nKd 0 0 0\n");
    const MeshFile mesh = loadMeshFile(write(
        "a.obj", "mtllib m.mtl\n" + std::string(kTriangle) + "usemtl red\nf 1 2 3\nusemtl black\nf 3 2 1\n"));
    ASSERT_EQ(mesh.objects.size(), 2u);
    EXPECT_EQ(mesh.objects[0].colour, glm::vec3(0.9f, 0.1f, 0.2f));
    EXPECT_EQ(mesh.objects[1].colour, glm::vec3(0.8f)) << "black would show no shadow";
}

/// Unit square as two triangles, binary.
std::string goodPly(bool bigEndian) {
    std::string bytes =
        std::string("ply\nformat ") + (bigEndian ? "binary_big_endian" : "binary_little_endian") +
        " 1.0\ncomment two triangles\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const auto add = [&](auto value) {
        std::string raw;
        append(raw, value);
        if (bigEndian) raw.assign(raw.rbegin(), raw.rend());
        bytes += raw;
    };
    for (const glm::vec3 p : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)})
        for (int k = 0; k < 3; ++k) add(p[k]);
    for (const glm::ivec3 t : {glm::ivec3(0, 1, 2), glm::ivec3(0, 2, 3)}) {
        add(std::uint8_t(3));
        for (int k = 0; k < 3; ++k) add(t[k]);
    }
    return bytes;
}

TEST_F(PlyFile, IsReadInEitherByteOrder) {
    for (const bool bigEndian : {false, true}) {
        const MeshFile mesh = loadMeshFile(write("a.ply", goodPly(bigEndian)));
        EXPECT_EQ(mesh.objects[0].mesh.triangles.size(), 2u);
        EXPECT_EQ(mesh.objects[0].mesh.positions[2], glm::vec3(1, 1, 0));
        EXPECT_FALSE(mesh.objects[0].twoSided);
        EXPECT_EQ(mesh.objects[0].colour, glm::vec3(0.8f));
    }
}

TEST_F(PlyFile, CutAtAnyByteIsRefused) {
    const std::string good = goodPly(false);
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_THAT(errorOfFile("a.ply", good.substr(0, size)), StartsWith("a.ply:")) << size << " bytes";
    EXPECT_EQ(errorOfFile("a.ply", good.substr(0, good.size() - 1)), "a.ply: face 1: the file ends here");
}

TEST_F(PlyFile, NamesLineOfWhatIsWrong) {
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_index\nend_header\n";
    EXPECT_EQ(loadMeshFile(write("a.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).objects.size(), 1u);
    EXPECT_EQ(errorOfFile("a.ply", header + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"),
              "a.ply:11: vertex 1: coordinate is not finite");
    EXPECT_EQ(errorOfFile("a.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
              "a.ply:13: face 0: index 3 is out of range, 3 vertices");
    EXPECT_EQ(errorOfFile("a.ply", header + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n"),
              "a.ply:13: face 0: has 2 corners, at least 3 needed");
    EXPECT_EQ(errorOfFile("a.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n"),
              "a.ply:13: face 0: too few values");
    EXPECT_EQ(errorOfFile("a.ply",
                          "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\n"
                          "property float y\nproperty float z\nelement face 1\n"
                          "property list uchar int vertex_index\nend_header\n0\n"),
              "a.ply:3: announces 99999999999 of 'vertex', more than the file can hold");
    EXPECT_EQ(errorOfFile("a.ply", "ply\nformat ascii 2\nproperty float x\n"),
              "a.ply:3: bad header line 'property float x'");
}

std::string goodStl() {
    std::string bytes(80, 'x');
    append(bytes, std::uint32_t(1));
    for (const float value : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
        append(bytes, value);
    append(bytes, std::uint16_t(0));
    return bytes;
}

TEST_F(StlFile, CutAtAnyByteIsRefused) {
    const std::string good = goodStl();
    EXPECT_EQ(loadMeshFile(write("a.stl", good)).objects[0].mesh.triangles.size(), 1u);
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_THAT(errorOfFile("a.stl", good.substr(0, size)), StartsWith("a.stl: ")) << size << " bytes";
    EXPECT_EQ(errorOfFile("a.stl", good.substr(0, 100)),
              "a.stl: announces 1 triangles, 134 bytes, but has 100 bytes");
}

TEST_F(StlFile, AsTextNamesLineOfWhatIsWrong) {
    const std::string start = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
    const std::string end = "endloop\nendfacet\nendsolid a\n";
    EXPECT_EQ(loadMeshFile(write("a.stl", start + "vertex 0 1 0\n" + end)).objects[0].mesh.triangles.size(),
              1u);
    EXPECT_EQ(errorOfFile("a.stl", start + end), "a.stl:7: facet has 2 corners, not 3");
    EXPECT_EQ(errorOfFile("a.stl", start + "vertex 0 inf 0\n" + end), "a.stl:6: coordinate is not finite");
    EXPECT_EQ(errorOfFile("a.stl", start), "a.stl:5: file ends inside a solid");
    EXPECT_EQ(errorOfFile("a.stl", start + "vertexx 0 1 0\n" + end), "a.stl:6: 'vertexx' is no STL keyword");
}

/// One triangle (0,0,0) (1,0,0) (0,1,0) in mesh 0; @p rest are further members of the root.
std::string gltf(const std::string& rest, const std::string& material = "") {
    std::string bytes;
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) append(bytes, value);
    return R"({"asset": {"version": "2.0"}, "scene": 0,
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
           base64(bytes) + R"("}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0})" +
           material + "}]}], " + rest + "}";
}

constexpr const char* kOneNode = R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])";

TEST_F(GltfFile, AppliesNestedTransformsToEachInstance) {
    const MeshFile mesh = loadMeshFile(write("a.gltf", gltf(R"("scenes": [{"nodes": [0, 2]}], "nodes": [
        {"translation": [10, 0, 0], "scale": [2, 2, 2], "children": [1]},
        {"translation": [0, 1, 0], "mesh": 0}, {"mesh": 0}])")));
    ASSERT_EQ(mesh.objects.size(), 2u);
    EXPECT_THAT(mesh.objects[0].mesh.positions,
                ElementsAre(glm::vec3(10, 2, 0), glm::vec3(12, 2, 0), glm::vec3(10, 4, 0)));
    EXPECT_EQ(mesh.objects[1].mesh.positions[1], glm::vec3(1, 0, 0));
}

TEST_F(GltfFile, TurnsTrianglesOfAMirroredNodeRound) {
    const MeshFile mesh = loadMeshFile(
        write("a.gltf", gltf(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [-1, 1, 1]}])")));
    const Mesh& m = mesh.objects[0].mesh;
    const glm::uvec3 t = m.triangles[0];
    EXPECT_GT(glm::cross(m.positions[t.y] - m.positions[t.x], m.positions[t.z] - m.positions[t.x]).z, 0);
}

TEST_F(GltfFile, HasColourAndSidesOfItsMaterial) {
    const MeshFile mesh =
        loadMeshFile(write("a.gltf", gltf(std::string(kOneNode) + R"(, "materials": [{"doubleSided": true,
        "pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.75, 1]}}])",
                                          R"(, "material": 0)")));
    EXPECT_EQ(mesh.objects[0].colour, glm::vec3(0.25f, 0.5f, 0.75f));
    EXPECT_TRUE(mesh.objects[0].twoSided);

    const MeshFile plain = loadMeshFile(write("b.gltf", gltf(kOneNode)));
    EXPECT_EQ(plain.objects[0].colour, glm::vec3(0.8f));
    EXPECT_FALSE(plain.objects[0].twoSided);
}

// Assimp keeps one light per definition, and the last node that shows it.
TEST_F(GltfFile, HasALightForEachNodeThatNamesOne) {
    const MeshFile mesh =
        loadMeshFile(write("a.gltf", gltf(R"("scenes": [{"nodes": [0, 1, 2, 3, 4]}], "nodes": [
        {"mesh": 0},
        {"translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"translation": [4, 5, 6], "extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"rotation": [-0.70710678, 0, 0, 0.70710678], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"translation": [7, 8, 9], "extensions": {"KHR_lights_punctual": {"light": 2}}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional"},
        {"type": "point", "color": [1, 0.5, 0]}, {"type": "spot", "spot": {}}]}})")));
    ASSERT_EQ(mesh.lights.size(), 4u);
    EXPECT_EQ(mesh.lights[0].position, glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(mesh.lights[0].colour, glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(mesh.lights[1].position, glm::vec4(4, 5, 6, 1));
    // Turned by -90 degrees about x, -z points down: the light comes from above.
    EXPECT_LT(glm::distance(mesh.lights[2].position, glm::vec4(0, 1, 0, 0)), 1e-6f);
    EXPECT_EQ(mesh.lights[3].position, glm::vec4(7, 8, 9, 1));
    EXPECT_THAT(mesh.notes, ElementsAre("1 spot light taken as point light"));
}

TEST_F(GltfFile, HasACameraForEachNodeThatNamesAPerspectiveOne) {
    const MeshFile mesh = loadMeshFile(write("a.gltf", gltf(R"("scenes": [{"nodes": [0, 1, 2]}], "nodes": [
        {"mesh": 0}, {"camera": 0}, {"translation": [100, 0, 3], "camera": 1}], "cameras": [
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 1, "zfar": 2}},
        {"type": "perspective", "perspective": {"yfov": 0.7853981633974483, "znear": 0.5}}])")));
    ASSERT_EQ(mesh.cameras.size(), 1u);
    const Camera& camera = mesh.cameras[0];
    EXPECT_EQ(camera.eye, glm::vec3(100, 0, 3));
    EXPECT_EQ(glm::normalize(camera.target - camera.eye), glm::vec3(0, 0, -1));
    EXPECT_EQ(camera.up, glm::vec3(0, 1, 0));
    EXPECT_EQ(camera.fovDegrees, 45);
    EXPECT_EQ(camera.nearPlane, 0.5f);
    EXPECT_THAT(mesh.notes, ElementsAre("1 orthographic camera skipped"));
}

TEST_F(GltfFile, WithABrokenReferenceIsRefused) {
    struct Case {
        std::string rest, error;
    };
    const Case cases[] = {
        {R"("scenes": [{"nodes": [1]}], "nodes": [{"mesh": 0}])", "a.gltf: scene names node 1, of 1"},
        {R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 3}])", "a.gltf: node 0 names mesh 3, of 1"},
        {R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": -1}])", "a.gltf: node 0 names mesh -1, of 1"},
        {R"("scenes": [{"nodes": [0]}], "nodes": [{"children": [0]}])", "a.gltf: node 0 is its own ancestor"},
        {R"("scenes": [{"nodes": [0]}], "nodes": [{"children": [2]}, {"children": [2]}, {"mesh": 0}])",
         "a.gltf: node 2 has two parents, 0 and 1"},
        {R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "camera": 0}], "cameras": [{"type": "perspective",
            "perspective": {"yfov": 0.5, "znear": 0}}])",
         "a.gltf: camera 0 has a znear of 0"},
        {R"("nodes": [{"mesh": 0}])", "a.gltf: no scene, so nothing to show"},
        {R"("scenes": [{"nodes": [0]}], "nodes": [{}])", "a.gltf: no triangle"},
        {R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [1e30, 1, 1]}])",
         "a.gltf: mesh 'meshes[0]', vertex 1: coordinate 1e+30 is too large (at most 1e+15)"},
        {R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "extensionsRequired": ["KHR_draco_mesh_compression"])",
         "a.gltf: needs the extension KHR_draco_mesh_compression, unknown here"},
        {R"("scenes": [{"nodes": "x"}], "nodes": [{"mesh": 0}])", "a.gltf: 'nodes' is no array"},
    };
    for (const Case& c : cases) EXPECT_THAT(errorOfFile("a.gltf", gltf(c.rest)), StartsWith(c.error));
}

TEST_F(GltfFile, BeyondItsBufferIsRefused) {
    std::string text = gltf(kOneNode);
    text.replace(text.find("\"count\": 3"), 10, "\"count\": 4");
    EXPECT_EQ(errorOfFile("a.gltf", text), "a.gltf: accessor 0 ends past buffer view 0 of 36 bytes");
    EXPECT_EQ(errorOfFile("b.gltf", "{\n\"asset\": }"), "b.gltf:2: bad JSON at byte 12");
    EXPECT_THAT(errorOfFile("c.gltf", std::string(100000, '[')), HasSubstr("nested deeper than 200"));
}

}  // namespace mesh_file_test
}  // namespace gnomon
