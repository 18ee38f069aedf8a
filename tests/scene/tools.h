#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "scene/load.h"

namespace gnomon {

/// Directed edges that no triangle walks the other way: 0 if closed and consistently wound.
inline int openEdges(const Mesh& mesh) {
    std::map<std::pair<unsigned, unsigned>, int> balance;
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const unsigned from = t[k], to = t[(k + 1) % 3];
            if (from < to) ++balance[{from, to}];
            if (to < from) --balance[{to, from}];
        }
    int open = 0;
    for (const auto& [edge, sum] : balance) open += std::abs(sum);
    return open;
}

/// Volume inside a closed mesh: positive if its triangles are counter-clockwise seen from outside.
inline double signedVolume(const Mesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles)
        sum += glm::dot(glm::dvec3(mesh.positions[t.x]),
                        glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])));
    return sum / 6;
}

/// What a SceneError says, or "no error".
inline std::string errorOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no error";
}

/// Adds the bytes of @p value as they lie in memory.
template <typename T>
void append(std::string& bytes, T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
}

/// A test with a folder of its own, removed afterwards.
class FolderTest : public testing::Test {
  protected:
    FolderTest() { std::filesystem::create_directories(m_folder); }
    ~FolderTest() override { std::filesystem::remove_all(m_folder); }

    std::filesystem::path write(const std::string& name, std::string_view content) const {
        std::ofstream(m_folder / name, std::ios::binary) << content;
        return m_folder / name;
    }
    /// The error of loading @p content, without the folder's name.
    std::string errorOfFile(const std::string& name, std::string_view content) const {
        const auto file = write(name, content);
        std::string error = errorOf([&] { loadScene(file); });
        const std::string prefix = m_folder.string() + "/";
        return error.starts_with(prefix) ? error.substr(prefix.size()) : error;
    }

    std::filesystem::path m_folder =
        std::filesystem::temp_directory_path() / ("gnomon_scene_test_" + std::to_string(getpid()));
};

}  // namespace gnomon
