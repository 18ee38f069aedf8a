#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "scene/mesh_check.h"
#include "scene/scene.h"

namespace gnomon {

/// What is read from glTF's own JSON. Assimp 5.2.5 keeps one node per light and camera *definition*, so that
/// of 248 lights that share 4 definitions 4 are left.
struct GltfFacts {
    MeshFacts mesh{};  ///< of the scene: a mesh that two nodes show counts twice
    /// All punctual lights of the scene in the order of its nodes (depth first), world space; spot lights as
    /// point lights.
    std::vector<Light> lights{};
    /// All perspective cameras of the scene, likewise; the target is any point ahead, the near plane as in
    /// the file.
    std::vector<Camera> cameras{};
    std::size_t materials = 0;  ///< Assimp's own default material comes after these
    std::vector<std::string> notes{};
};

/// Reads and validates a .gltf or .glb file: JSON, buffers, views, accessors, index values, the node tree,
/// KHR_lights_punctual.
/// @throws SceneError for whatever a reader could trip over
GltfFacts readGltf(const std::filesystem::path& file, std::string_view data, const SceneLimits& limits = {});

}  // namespace gnomon
