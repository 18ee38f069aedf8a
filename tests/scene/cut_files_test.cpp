// Good files that end too early, at every byte, and with every byte changed: a clear line, or a scene that
// can be drawn.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "tools.h"

namespace gnomon {
namespace cut_files_test {

const glm::vec3 kCorners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

void append(std::string& bytes, const glm::vec3& v) {
    for (int k = 0; k < 3; ++k) gnomon::append(bytes, v[k]);
}

std::string obj() {
    std::string text = "# a tetrahedron\no it\n";
    for (const glm::vec3& v : kCorners) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    for (const auto& f : kFaces) text += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    return text;
}

std::string ply(bool isBinary) {
    std::string text = fmt::format(
        "ply\nformat {} 1.0\ncomment a tetrahedron\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n",
        isBinary ? "binary_little_endian" : "ascii");
    for (const glm::vec3& v : kCorners)
        if (isBinary)
            append(text, v);
        else
            text += fmt::format("{} {} {}\n", v.x, v.y, v.z);
    for (const auto& f : kFaces) {
        if (isBinary)
            text += '\3';
        else
            text += "3";
        for (const int index : f)
            if (isBinary)
                gnomon::append(text, index);
            else
                text += fmt::format(" {}", index);
        if (!isBinary) text += "\n";
    }
    return text;
}

std::string stl(bool isBinary) {
    std::string text = isBinary ? std::string(80, ' ') : "solid it\n";
    if (isBinary) gnomon::append(text, std::uint32_t(std::size(kFaces)));
    for (const auto& f : kFaces) {
        if (isBinary) {
            append(text, glm::vec3(0, 0, 1));
            for (const int index : f) append(text, kCorners[index]);
            gnomon::append(text, std::uint16_t(0));
            continue;
        }
        text += "facet normal 0 0 1\nouter loop\n";
        for (const int index : f)
            text += fmt::format("vertex {} {} {}\n", kCorners[index].x, kCorners[index].y, kCorners[index].z);
        text += "endloop\nendfacet\n";
    }
    return isBinary ? text : text + "endsolid it\n";
}

std::string glb() {
    std::string data;
    for (const glm::vec3& v : kCorners) append(data, v);
    for (const auto& f : kFaces)
        for (const int index : f) gnomon::append(data, std::uint16_t(index));
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},)"
        R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
        R"("buffers":[{"byteLength":72}]})";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    const auto word = [&](std::size_t value) { gnomon::append(bytes, std::uint32_t(value)); };
    word(2), word(12 + 8 + json.size() + 8 + data.size());
    word(json.size()), bytes += "JSON" + json;
    word(data.size()), bytes += "BIN" + std::string(1, '\0') + data;
    return bytes;
}

std::string toml() {
    return "title = \"two plates\"\nambient = 0.2\n[light]\nposition = [1.5, 8.5, 0.5]\n[camera]\neye = "
           "[3.0, 3.0, 6.0]\n"
           "target = [0.0, 0.5, 0.0]\nfov = 50.0\nnear = 0.5\n[[objects]]\nname = \"floor\"\nshape = "
           "\"rectangle\"\n"
           "size = [24.0, 24.0]\ncasts = false\n[[objects]]\nshape = \"box\"\nsize = [1.0, 1.0, 1.0]\nat = "
           "[0.0, 1.0, 0.0]\n"
           "rotate = [0, 1, 0, 30]\n";
}

struct GoodFile {
    const char* name;
    std::string (*make)();
    bool mayEndEarly;  ///< what is cut off by whole lines leaves a good file
};

void PrintTo(const GoodFile& file, std::ostream* out) {
    *out << file.name;
}

class GoodFiles : public FolderTest, public testing::WithParamInterface<GoodFile> {
  protected:
    /// Loads @p content. An error is one line that names the file; a scene has triangles, and all of it is
    /// finite.
    /// @return whether there is a scene
    bool loads(const std::string& content) {
        const auto file = write(GetParam().name, content);
        try {
            const Scene scene = loadScene(file);
            std::size_t triangles = 0;
            for (const Object& object : scene.objects) {
                triangles += object.mesh.triangles.size();
                for (const glm::vec3& p : object.mesh.positions)
                    EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
            }
            EXPECT_GT(triangles, 0u);
            return true;
        } catch (const SceneError& error) {
            const std::string what = error.what();
            EXPECT_TRUE(what.starts_with(file.string() + ":")) << what;
            EXPECT_EQ(what.find_first_of("\n\r"), std::string::npos) << what;
            EXPECT_EQ(what.find("crash"), std::string::npos) << what;
            return false;
        }
    }
};

TEST_P(GoodFiles, AreGood) {
    EXPECT_TRUE(loads(GetParam().make()));
}

TEST_P(GoodFiles, CutAtEveryByteAreRefusedInOneLineOrDrawn) {
    const std::string whole = GetParam().make();
    const std::size_t text = whole.find_last_not_of('\n') + 1;
    int scenes = 0;
    for (std::size_t size = 0; size < text; ++size) {
        SCOPED_TRACE(fmt::format("the first {} of {} bytes", size, whole.size()));
        scenes += loads(whole.substr(0, size));
    }
    EXPECT_EQ(scenes > 0, GetParam().mayEndEarly);
}

TEST_P(GoodFiles, WithOneByteChangedAreRefusedInOneLineOrDrawn) {
    const std::string whole = GetParam().make();
    for (std::size_t at = 0; at < whole.size(); ++at)
        for (const char byte : {'\xff', '9'}) {
            SCOPED_TRACE(fmt::format("byte {} is {}", at, int(byte)));
            std::string changed = whole;
            changed[at] = byte;
            loads(changed);
        }
}

INSTANTIATE_TEST_SUITE_P(Formats, GoodFiles,
                         testing::Values(GoodFile{"a.obj", obj, true},
                                         GoodFile{"ascii.ply", [] { return ply(false); }, false},
                                         GoodFile{"binary.ply", [] { return ply(true); }, false},
                                         GoodFile{"ascii.stl", [] { return stl(false); }, true},
                                         GoodFile{"binary.stl", [] { return stl(true); }, false},
                                         GoodFile{"a.glb", glb, false}, GoodFile{"a.toml", toml, true}),
                         [](const auto& file) {
                             std::string name = file.param.name;
                             std::replace(name.begin(), name.end(), '.', '_');
                             return name;
                         });

}  // namespace cut_files_test
}  // namespace gnomon
