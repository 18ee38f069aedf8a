#pragma once

#include "scene/scene.h"

namespace gnomon {

/// @p mesh with each triangle cut in four at the middles of its edges, @p times over: the same surface, but
/// for the rounding of the middles, with 4^times as many triangles. Triangles that share an edge share its
/// middle; those that rounding leaves without area are dropped.
/// @pre times >= 0
Mesh subdivided(const Mesh& mesh, int times);

}  // namespace gnomon
