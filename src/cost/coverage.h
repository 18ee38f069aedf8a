#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "plan/plan.h"

namespace gnomon {

/// Pixels that triangles cover, by the side of them that is seen.
struct SidesCovered {
    std::int64_t front = 0, back = 0;
    bool operator==(const SidesCovered&) const = default;
};
SidesCovered& operator+=(SidesCovered& a, const SidesCovered& b);

/// Counts the pixels whose centres triangles cover, once for each triangle.
///
/// A fill rule as OpenGL wants it: corners are rounded to 1/256 pixel, as llvmpipe and the chips of the table
/// do, and from there on all is exact in integers. A centre on an edge belongs to the triangle on its right,
/// or above: triangles that share corners to the bit share no pixel and leave none out.
///
/// @param triangles  in clip space, with identity matrices; front faces are counter-clockwise. What lies
///                   outside of the view is cut away.
/// @param width,height  of the viewport, pixels, at 0,0
/// @param scissor       of its pixels; the rest is left out
/// @param depthClamp    what lies before the near plane is drawn, not cut away
SidesCovered covered(std::span<const glm::vec4> triangles, int width, int height, const WindowRect& scissor,
                     bool depthClamp = false);

}  // namespace gnomon
