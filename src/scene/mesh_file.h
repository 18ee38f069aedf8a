#pragma once

#include <filesystem>
#include <vector>

#include "scene/limits.h"
#include "scene/scene.h"

namespace gnomon {

/// The content of a mesh file; only glTF has lights and cameras.
struct MeshFile {
    std::vector<Object> objects{};  ///< one per instance of a mesh, world space; at least one
    std::vector<Light> lights{};
    std::vector<Camera> cameras{};  ///< near planes as in the file
    bool isGltf = false;
    std::vector<std::string> notes{};
    Dropped dropped{};
};

/// True for the extensions that loadMeshFile() knows: .obj .ply .stl .gltf .glb, in any case.
bool isMeshFile(const std::filesystem::path& file);

/// Loads a mesh file through Assimp, once its own walk over the file has found nothing wrong; both in a
/// process of their own, so that a crash there is a SceneError.
/// @throws SceneError
MeshFile loadMeshFile(const std::filesystem::path& file, const SceneLimits& limits = {});

}  // namespace gnomon
