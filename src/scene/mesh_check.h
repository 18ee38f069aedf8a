#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/limits.h"

namespace gnomon {

/// What a mesh file says of itself, read apart from Assimp.
struct MeshFacts {
    std::size_t triangles = 0;        ///< once its polygons are cut into corners - 2 each
    std::size_t otherPrimitives = 0;  ///< points and lines, which no one draws
};

// Assimp reads the meshes, but takes broken files for good ones: it drops faces and vertices, reads past the
// end, and crashes on some PLY headers (5.2.5). So each file is walked here first, and refused with the line,
// vertex or face that is wrong; what Assimp then delivers must have as many triangles as were counted here.
//
// @throws SceneError "file:line: what", or "file: what" in binary data

MeshFacts checkObj(const std::filesystem::path& file, std::string_view text, const SceneLimits& limits = {});
MeshFacts checkPly(const std::filesystem::path& file, std::string_view data, const SceneLimits& limits = {});
MeshFacts checkStl(const std::filesystem::path& file, std::string_view data, const SceneLimits& limits = {});

}  // namespace gnomon
