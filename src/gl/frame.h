#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"
#include "scene/view.h"

namespace gnomon {

using VertexColour = glm::u8vec4;

/// Where a vertex of a frame's surfaces comes from.
struct SurfaceOrigin {
    std::uint32_t object = 0, triangle = 0;  ///< indices into the scene and its mesh
    glm::vec3 weights{};                     ///< of the triangle's corners
};

/// The surfaces of one frame in clip space, cut at the near plane and the window's sides; a triangle list.
/// Transformed on the host in double precision and rounded once, as the volumes are: a vertex that both share
/// is the same to the bit.
struct FrameSurfaces {
    std::vector<glm::vec4> positions{};
    std::vector<SurfaceOrigin> origins{};  ///< one per position
    std::vector<VertexColour> ambient{};   ///< the part of the colour that needs no light
    glm::vec3 background{};
};

FrameSurfaces frameSurfaces(const Scene& scene, const View& view);

/// The colours that one light gives to a frame's surfaces, one per position.
struct LightColours {
    std::vector<VertexColour> diffuse{};  ///< the light's part alone
    std::vector<VertexColour> lit{};      ///< with the ambient part
};

/// Flat Lambert shading of the seen side, without attenuation by distance; a seen side that faces away gets
/// no light. Computed at the corners of the scene's triangles and interpolated from there.
LightColours lightColours(const Scene& scene, const Light& light, const View& view,
                          const FrameSurfaces& surfaces);

}  // namespace gnomon
