#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/limits.h"
#include "scene/scene.h"

namespace gnomon {

/// A scene or mesh file that can't be used. what() is one line, "file:line: what", or "file: what" where the
/// format has no lines.
struct SceneError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What the command line says of light and camera; what is left out comes from the file, else it frames the
/// scene.
struct SceneOverrides {
    std::optional<glm::vec4> light{};  ///< world space, homogeneous (a direction is normalised by the loader)
    std::optional<glm::vec3> eye{}, target{};
    std::optional<float> fovDegrees{}, nearPlane{};
    std::optional<bool>
        ground{};  ///< add a floor below the meshes; default: to OBJ, PLY and STL, not to glTF
};

/// Loads a scene file (.toml) or a mesh file (.obj .ply .stl .gltf .glb).
/// @throws SceneError for anything that can't be drawn: unreadable or malformed file, one beyond @p limits, a
///         mesh or objects of which no triangle is left. A scene file may say that it has no objects, or no
///         lights.
Scene loadScene(const std::filesystem::path& file, const SceneOverrides& overrides = {},
                const SceneLimits& limits = {});

/// Resolves --scene: a file that exists, else an id in @p folder ("boxes" -> folder/boxes.toml, "hard/x" ->
/// folder/hard/x.toml).
/// @throws SceneError that names the known ids
std::filesystem::path findScene(const std::string& idOrFile, const std::filesystem::path& folder);

/// Ids of all scene files in @p folder, sorted; without the hard cases.
std::vector<std::string> sceneIds(const std::filesystem::path& folder);

/// Ids of the hard cases in @p folder: "hard/x" for each folder/hard/x.toml, sorted.
std::vector<std::string> hardSceneIds(const std::filesystem::path& folder);

/// The id of a scene file: its stem, after "hard/" in a folder of that name.
std::string sceneIdOf(const std::filesystem::path& file);

}  // namespace gnomon
