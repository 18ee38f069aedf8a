// Real meshes and malformed files, where the folder GNOMON_SHARED/data is there.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "scene/load.h"
#include "scene/topology.h"
#include "scene/weld.h"
#include "tools.h"

namespace gnomon {
namespace shared_data_test {

using testing::StartsWith;

const std::filesystem::path kData = std::filesystem::path(GNOMON_SHARED) / "data";

bool isMesh(const std::filesystem::path& file) {
    static const std::set<std::string> kKinds = {".obj", ".ply", ".stl", ".gltf", ".glb"};
    return kKinds.contains(file.extension().string());
}

std::vector<std::filesystem::path> meshesIn(const char* folder) {
    std::vector<std::filesystem::path> files;
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator(kData / folder, missing))
        if (isMesh(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<std::filesystem::path> goodMeshes() {
    auto files = meshesIn("meshes");
    const auto scenes = meshesIn("scenes");
    files.insert(files.end(), scenes.begin(), scenes.end());
    return files;
}

std::string nameOf(const testing::TestParamInfo<std::filesystem::path>& info) {
    std::string name = info.param.filename().string();
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

TEST(SharedData, IsThere) {
    if (!std::filesystem::exists(kData))
        GTEST_SKIP() << kData << " is missing: tests on real meshes are left out";
    EXPECT_FALSE(goodMeshes().empty());
    EXPECT_FALSE(meshesIn("malformed").empty());
}

class MalformedFile : public testing::TestWithParam<std::filesystem::path> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MalformedFile);

TEST_P(MalformedFile, IsRefusedInOneLineThatNamesIt) {
    const std::string error = errorOf([&] { loadScene(GetParam()); });
    EXPECT_THAT(error, StartsWith(GetParam().string() + ":"));
    EXPECT_EQ(error.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Shared, MalformedFile, testing::ValuesIn(meshesIn("malformed")), nameOf);

/// What DATA.md says of a file.
struct Counts {
    std::size_t triangles = 0, vertices = 0, repeatedVertex = 0, zeroArea = 0;
    int lights = -1, cameras = -1;  ///< -1: not said
    std::size_t components = 0, boundary = 0, nonManifold = 0, inconsistent = 0, duplicates = 0, sameWay = 0,
                tJunctions = 0;
    int maxValence = 0;
};

std::size_t numberOf(std::string text) {
    std::erase_if(text, [](char c) { return c == ',' || c == ' '; });
    return std::stoul(text);  // "3,129 (6)" is 3129
}

std::map<std::string, Counts> readDataTables() {
    std::map<std::string, Counts> counts;
    std::ifstream stream(kData / "DATA.md");
    for (std::string line; std::getline(stream, line);) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
        // | file | size | triangles | vertices | components | boundary | non-manifold | inconsistent |
        // degenerate | ...
        if (cells.size() < 14 || cells[9].find('+') == std::string::npos) continue;
        const std::string& degenerate = cells[9];
        Counts c{.triangles = numberOf(cells[3]),
                 .vertices = numberOf(cells[4]),
                 .repeatedVertex = numberOf(degenerate.substr(0, degenerate.find('+'))),
                 .zeroArea = numberOf(degenerate.substr(degenerate.find('+') + 1))};
        const auto bracketed = [](const std::string& cell) {
            return numberOf(cell.substr(cell.find('(') + 1));
        };
        c.components = numberOf(cells[5]);
        c.boundary = numberOf(cells[6]);
        c.nonManifold = numberOf(cells[7]);
        c.maxValence = int(bracketed(cells[7]));
        c.inconsistent = numberOf(cells[8]);
        c.duplicates = numberOf(cells[10]);
        c.sameWay = bracketed(cells[10]);
        c.tJunctions = numberOf(cells[11]);
        if (cells.size() == 15) std::sscanf(cells[12].c_str(), "%d, %d", &c.lights, &c.cameras);
        counts[cells[1].substr(1, cells[1].size() - 2)] = c;
    }
    return counts;
}

class GoodFile : public testing::TestWithParam<std::filesystem::path> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(GoodFile);

TEST_P(GoodFile, HasTheTrianglesAndVerticesOfDataTable) {
    const std::string name = GetParam().filename().string();
    const auto table = readDataTables();
    ASSERT_TRUE(table.contains(name)) << "no row in DATA.md";
    const Counts& expected = table.at(name);
    const Scene scene = loadScene(GetParam(), {.ground = false});

    std::size_t repeated = 0, zero = 0;
    for (const std::string& note : scene.notes) {
        const std::size_t bracket = note.find('(');
        if (note.find("degenerate triangle") == std::string::npos || bracket == std::string::npos) continue;
        std::sscanf(note.c_str() + bracket, "(%zu repeat a vertex, %zu have", &repeated, &zero);
    }
    EXPECT_EQ(triangleCount(scene) + repeated + zero, expected.triangles);

    // The table cuts every polygon into a fan; where that makes triangles without area, clipping ears leaves
    // fewer.
    const bool hasFlatFans = name == "wallhole.obj" || name == "box_longline.obj";
    if (hasFlatFans) {
        EXPECT_LE(repeated + zero, expected.repeatedVertex + expected.zeroArea);
    } else {
        EXPECT_EQ(repeated, expected.repeatedVertex);
        EXPECT_EQ(zero, expected.zeroArea);
    }

    // Of the whole file, as the table counts; vertices of degenerate triangles only are in the table but not
    // here, and nested transforms round differently in float and in double.
    std::set<std::array<float, 3>> positions;
    for (const Object& object : scene.objects)
        for (const glm::vec3& p : object.mesh.positions) positions.insert({p.x, p.y, p.z});
    EXPECT_LE(positions.size(), expected.vertices);
    EXPECT_GE(positions.size() + 3 * (repeated + zero), expected.vertices);

    if (expected.lights > 0) {
        EXPECT_EQ(int(scene.lights.size()), expected.lights);
    }
    // cameras.gltf has an orthographic camera, which no frame is made of.
    if (expected.cameras > 0) {
        EXPECT_EQ(int(scene.frames.size()), name == "cameras.gltf" ? 1 : expected.cameras);
    }
}

TEST_P(GoodFile, HasTheTopologyOfDataTable) {
    const std::string name = GetParam().filename().string();
    const Counts expected = readDataTables()[name];
    const Topology topology = topologyOf(joinCasters(loadScene(GetParam(), {.ground = false}), true));
    EXPECT_EQ(topology.components, expected.components);
    EXPECT_EQ(topology.boundaryEdges(), expected.boundary);
    EXPECT_EQ(topology.windingConflicts, expected.inconsistent);
    EXPECT_EQ(topology.tJunctions, expected.tJunctions);
    // Fans of a polygon with a hole run twice over the same three vertices; clipped ears don't.
    if (name == "wallhole.obj") return;
    EXPECT_EQ(topology.nonManifoldEdges(), expected.nonManifold);
    EXPECT_EQ(topology.maxValence(), expected.maxValence);
    EXPECT_EQ(topology.duplicates, expected.duplicates);
    EXPECT_EQ(topology.duplicatesSameWay, expected.sameWay);
}

INSTANTIATE_TEST_SUITE_P(Shared, GoodFile, testing::ValuesIn(goodMeshes()), nameOf);

}  // namespace shared_data_test
}  // namespace gnomon
