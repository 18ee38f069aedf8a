#pragma once

#include <functional>

#include "scene/mesh_file.h"

namespace gnomon {

/// What @p parse makes of @p file, in a process of its own: a parser that crashes is a bad file.
/// @throws SceneError  what @p parse throws, or how its process ended
MeshFile parsedApart(const std::filesystem::path& file, const std::function<MeshFile()>& parse);

}  // namespace gnomon
