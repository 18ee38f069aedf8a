#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace gnomon {

/// Number of vertices of boundary edges that lie inside another boundary edge, to a millionth of the bounding
/// box's diagonal. There a mesh looks closed but isn't: a rasteriser leaves cracks, and sides of volumes hang
/// from both.
/// @pre no triangle repeats a vertex
std::size_t tJunctions(const Mesh& mesh);

}  // namespace gnomon
