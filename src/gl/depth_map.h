#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gl/frame.h"
#include "scene/light_map.h"

namespace gnomon {

/// What a frame needs of a light's depth map (Williams 1978), for one square of depths (a directional light)
/// or the six faces of a cube (a point light).
struct DepthMapFrame {
    /// The casters in clip space of each face, as a triangle list: those that truth lets cast.
    std::vector<std::vector<glm::vec4>> faces{};
    /// Of each of the frame's surface positions: LightMap::coordinates().
    std::vector<glm::vec3> coordinates{};
    float nearPlane = 0;  ///< of a point light's faces, world units; 0 for a directional light
};

DepthMapFrame depthMapFrame(const Scene& scene, const Light& light, const FrameSurfaces& surfaces);

}  // namespace gnomon
