#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/view.h"
#include "volume/volume.h"

namespace gnomon {

/// How many volumes hold the eye: the caps' triangles that the open segment from the eye to the light
/// crosses. Exact; a segment through an edge crosses one of its two triangles, one that ends on a face
/// doesn't cross it.
int holdingEye(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
               const glm::dvec3& eye);

/// Whether @p eye lies exactly on a face of a volume: in a cap, or in a side. There the count that starts at
/// the eye is not one number for all pixels.
bool onVolumeFace(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                  const glm::dvec3& eye);

/// The same triangles as a view of one pixel sees them from the light, orthographically along the line to the
/// eye (Eisemann et al. 2011, ++ZP): the part of each between light and eye that covers some of the pixel, in
/// its clip space, its centre on the line. A triangle list.
std::vector<glm::vec4> eyeBlockers(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                                   const glm::dvec3& eye);

}  // namespace gnomon
