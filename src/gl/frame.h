#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"
#include "scene/view.h"
#include "volume/frame_volumes.h"

namespace gnomon {

using Rgba = glm::u8vec4;

/// The surfaces of one frame in clip space, with a colour per vertex for each shading. Transformed on the
/// host in double precision and rounded once, as the volumes are: a vertex that both share is the same to the
/// bit.
struct FrameSurfaces {
    std::vector<glm::vec4> positions{};             ///< triangle list
    std::vector<Rgba> lit{}, diffuse{}, ambient{};  ///< for the side that the eye sees
    glm::vec3 background{};
};

/// Flat Lambert shading of the seen side by @p light, without attenuation by distance; a seen side that faces
/// away gets the ambient part alone.
FrameSurfaces frameSurfaces(const Scene& scene, const Light& light, const View& view);

}  // namespace gnomon
