#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gl/frame.h"
#include "scene/scene.h"

namespace gnomon {

/// What a frame needs of a light's depth map (Williams 1978), for one square of depths (a directional light)
/// or the six faces of a cube (a point light).
struct DepthMapFrame {
    /// The casters in clip space of each face, as a triangle list: those that truth lets cast.
    std::vector<std::vector<glm::vec4>> faces{};
    /// Of each of the frame's surface positions. Point light: from the light, world units. Directional:
    /// x and y in the map, -1 to 1, and its depth there, 0 to 1.
    std::vector<glm::vec3> coordinates{};
    float nearPlane = 0;  ///< of a point light's faces, world units
};

/// The faces' axes: face f looks along kCubeFaces[f].forward; x and y of its clip space are the others.
struct CubeFace {
    glm::vec3 forward{}, right{}, up{};
};
extern const CubeFace kCubeFaces[6];

DepthMapFrame depthMapFrame(const Scene& scene, const Light& light, const FrameSurfaces& surfaces);

}  // namespace gnomon
