#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/view.h"
#include "volume/volume.h"

namespace gnomon {

/// The volume of one lit caster, cut at the near plane, in clip space (w > 0, or 0 for points at infinity),
/// ready to be drawn with identity matrices. Faces share vertices to the bit, so the rasteriser leaves no
/// crack between them. Triangle lists, counter-clockwise seen from outside the volume.
struct NearCut {
    std::vector<glm::vec4> fronts{};  ///< sides whose outer side the eye sees
    std::vector<glm::vec4> backs{};   ///< the other sides, and the far cap
    std::vector<glm::vec4> cap{};     ///< at the near plane, z = -w to the bit; drawn as front faces
};

/// Whether the volume of @p caster may hold a point of the near rectangle (the section of the view's pyramid
/// with the near plane), or come within 2 pixels of it. Conservative: false is certain, true is not.
bool touchesNearRectangle(const Scene& scene, const LitCaster& caster, const glm::vec4& light,
                          const View& view);

/// Cuts the volume of @p caster at the near plane and closes it with a near cap; its light cap (the lit
/// triangles) is left out, as z-pass never counts it: it lies on visible surfaces.
///
/// The cap is one convex polygon per lit triangle: the points of the near plane that the triangle hides from
/// the light. A face with weight w is there w times. A side that the eye sees exactly edge-on counts as a
/// back.
///
/// Each cut point belongs to one edge of the volume (a vertex's ray, a mesh edge, or an edge at infinity), is
/// computed from that edge alone in a fixed direction, and so is the same for all faces there. Cut points of
/// edges at infinity have w = 0.
///
/// Source: Roettger et al. 2002, section 3.2 (why the near plane needs a cap); the cut is ours.
NearCut cutAtNearPlane(const Scene& scene, const LitCaster& caster, const glm::vec4& light, const View& view);

}  // namespace gnomon
