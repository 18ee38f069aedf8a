#pragma once

#include <string>
#include <string_view>

#include "scene/mesh_file.h"

namespace gnomon {

/// The content of a mesh file as bytes, for another process of the same program.
std::string toBytes(MeshFile mesh);

/// Inverse of toBytes().
/// @pre @p bytes are of this program
MeshFile meshFileFrom(std::string_view bytes);

}  // namespace gnomon
