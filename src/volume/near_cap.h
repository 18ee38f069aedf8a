#pragma once

#include <glm/glm.hpp>

#include "scene/view.h"
#include "volume/clip_space.h"
#include "volume/volume.h"

namespace gnomon {

/// Whether the volume of @p caster may hold a point of the near rectangle (the section of the view's pyramid
/// with the near plane), or come within 2 pixels of it. Conservative: false is certain, true is not.
bool touchesNearRectangle(const Scene& scene, const LitCaster& caster, const glm::vec4& light,
                          const View& view);

/// The section of the volume of one lit triangle with the near plane: the points of the plane that the
/// triangle hides from the light. Counter-clockwise seen from before the plane, z = -w to the bit; empty if
/// the volume misses the plane.
///
/// Source: Roettger et al. 2002, section 3.2 (why the near plane needs a cap); Hornus et al. 2005 draw the
/// same area from the light. The cut is ours.
ClipPolygon nearCap(const ClipSpace& space, const glm::uvec3& triangle);

}  // namespace gnomon
