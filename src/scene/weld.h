#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace gnomon {

/// Makes one mesh of a triangle list: vertices at exactly the same float position become one (-0 is 0),
/// triangles without area go to @p dropped, vertices that no triangle uses are left out. Duplicate
/// triangles stay.
///
/// @pre finite positions below kMaxCoordinate, indices in range
Mesh weld(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles, Dropped& dropped);

/// All casting objects as one mesh, vertices at exactly the same position merged across objects.
///
/// @param withFlat also the triangles without area that the loader dropped: the mesh as the file has it, but
///                 for triangles that repeat a vertex
Mesh joinCasters(const Scene& scene, bool withFlat);

/// Cuts a polygon into corners - 2 triangles with its orientation: a fan where that turns no triangle over
/// and leaves none without area, else by clipping ears; a fan again where no ear is left (self-crossing
/// outlines) and beyond 500 corners.
///
/// @param corners indices into @p positions, at least 3
/// @return how often a corner was held against an ear, which grows with the cube of the corners
std::uint64_t triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners,
                          std::vector<glm::uvec3>& triangles);

/// "12 degenerate triangles dropped (10 repeat a vertex, 2 have no area)"; empty if none were.
std::string describe(const Dropped& dropped);

/// Products of three coordinate differences must stay within float's range on the way to the screen; files
/// beyond this are refused.
inline constexpr double kMaxCoordinate = 1e15;

}  // namespace gnomon
