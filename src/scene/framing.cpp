#include "scene/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/primitives.h"

namespace gnomon {

Bounds boundsOf(std::span<const Object> objects) {
    Bounds bounds{.least = glm::dvec3(std::numeric_limits<double>::infinity()),
                  .most = glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const Object& object : objects)
        for (const glm::vec3& p : object.mesh.positions) {
            bounds.least = glm::min(bounds.least, glm::dvec3(p));
            bounds.most = glm::max(bounds.most, glm::dvec3(p));
        }
    bounds.centre = (bounds.least + bounds.most) / 2.0;
    bounds.radius = glm::length(bounds.most - bounds.least) / 2;
    return bounds;
}

Camera framingCamera(const Bounds& bounds, float fovDegrees) {
    constexpr double kMargin = 1.1;
    const double distance = kMargin * bounds.radius / std::sin(glm::radians(double(fovDegrees)) / 2);
    const glm::dvec3 eye = bounds.centre + distance * glm::normalize(glm::dvec3(1, 0.8, 1.6));
    return {.eye = glm::vec3(eye),
            .target = glm::vec3(bounds.centre),
            .fovDegrees = fovDegrees,
            .nearPlane = float(std::max((distance - bounds.radius) / 20, bounds.radius / 1000))};
}

Light framingLight(const Bounds& bounds) {
    const glm::dvec3 place = bounds.centre + 2.5 * bounds.radius * glm::normalize(glm::dvec3(-0.6, 1.5, 0.9));
    return {.position = glm::vec4(glm::vec3(place), 1)};
}

Object groundBelow(const Bounds& bounds) {
    constexpr double kWidth = 12;  // radii
    float y = float(bounds.least.y - bounds.radius / 1000);
    // Far from the origin, float may not hold so small a step.
    if (double(y) >= bounds.least.y)
        y = std::nextafter(float(bounds.least.y), -std::numeric_limits<float>::max());
    Object ground{.name = "ground", .mesh = rectangle(glm::dvec2(kWidth * bounds.radius)), .casts = false};
    for (glm::vec3& p : ground.mesh.positions)
        p = glm::vec3(float(bounds.centre.x + double(p.x)), y, float(bounds.centre.z + double(p.z)));
    return ground;
}

float nearPlaneFor(const Bounds& bounds, const glm::vec3& eye, const glm::vec3& target) {
    const double distance = glm::distance(glm::dvec3(eye), glm::dvec3(target));
    return float(std::min(bounds.radius / 1000, distance / 20));
}

}  // namespace gnomon
