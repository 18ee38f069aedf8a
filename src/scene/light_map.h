#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"
#include "scene/view.h"

namespace gnomon {

/// The faces' axes: face f looks along kCubeFaces[f].forward; x and y of its clip space are the others.
struct CubeFace {
    glm::vec3 forward{}, right{}, up{};
};
extern const CubeFace kCubeFaces[6];

/// A light's depth map (Williams 1978) as views from the light: the six faces of a cube, 90 degrees each, for
/// a point light; one square of parallel rays for a directional light.
struct LightMap {
    /// Widths and heights are the map's. Parallel rays: tanHalfX and tanHalfY are half the extents, world
    /// units; the eye lies in the plane of depth 0, and depth 1 is as far from it as the square is wide.
    std::vector<View> faces{};
    bool parallel = false;

    /// Of a point, what the map is searched by. Point light: from the light, world axes and units.
    /// Directional: x and y in the map, -1 to 1, and its depth there, 0 to 1.
    glm::dvec3 coordinates(const glm::dvec3& p) const;
    /// How far these move with @p step.
    glm::dvec3 coordinateStep(const glm::dvec3& step) const;
};

/// @param size  of the map, texels per side
/// @pre at least one object with a vertex
LightMap lightMap(const Scene& scene, const glm::vec4& light, int size);

}  // namespace gnomon
