#pragma once

#include <span>

#include "scene/scene.h"

namespace gnomon {

/// A sphere around the bounding box of some objects.
struct Bounds {
    glm::dvec3 least{}, most{};
    glm::dvec3 centre{};
    double radius = 0;
};

/// Of objects without any vertex a point: radius 0 about the origin.
Bounds boundsOf(std::span<const Object> objects);

/// A camera that shows all of the sphere within @p fovDegrees, from above and a little to the right; its near
/// plane is at 1/20 of the distance to the sphere, or radius/1000 if that is more.
Camera framingCamera(const Bounds& bounds, float fovDegrees = 45);

/// A point light above and to the left of the framing camera's view, outside of the sphere.
Light framingLight(const Bounds& bounds);

/// A floor facing up, so little below the box that it seems to stand on it, yet not coplanar. Receives only.
Object groundBelow(const Bounds& bounds);

/// A near plane for an eye anywhere, as far out as it can be, for the sake of depth precision: half of the
/// distance to the nearest surface, so that up to 90 degrees of view nothing is cut; at least radius/2000.
float nearPlaneFor(std::span<const Object> objects, const Bounds& bounds, const glm::vec3& eye);

}  // namespace gnomon
