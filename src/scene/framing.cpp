#include "scene/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/primitives.h"

namespace gnomon {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

double distanceToEdge(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 way = b - a;
    const double t = std::clamp(glm::dot(point - a, way) / glm::dot(way, way), 0.0, 1.0);
    return glm::distance(point, a + t * way);
}

/// Distance from @p point to the nearest point of the triangle: of its plane where that lies inside, else of
/// an edge.
double distanceTo(const glm::dvec3& point, const Triangle& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    bool inside = true;
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 &a = t[k], &b = t[(k + 1) % 3];
        inside = inside && glm::dot(glm::cross(normal, b - a), point - a) >= 0;
        nearest = std::min(nearest, distanceToEdge(point, a, b));
    }
    return inside ? std::abs(glm::dot(normal, point - t[0])) / glm::length(normal) : nearest;
}

}  // namespace

Bounds boundsOf(std::span<const Object> objects) {
    Bounds bounds{.least = glm::dvec3(std::numeric_limits<double>::infinity()),
                  .most = glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (const Object& object : objects)
        for (const glm::vec3& p : object.mesh.positions) {
            bounds.least = glm::min(bounds.least, glm::dvec3(p));
            bounds.most = glm::max(bounds.most, glm::dvec3(p));
        }
    if (!(bounds.least.x <= bounds.most.x)) return {};
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

float nearPlaneFor(std::span<const Object> objects, const Bounds& bounds, const glm::vec3& eye) {
    double nearest = 4 * bounds.radius;
    for (const Object& object : objects) {
        const auto& p = object.mesh.positions;
        for (const glm::uvec3& t : object.mesh.triangles)
            nearest = std::min(nearest, distanceTo(eye, {p[t.x], p[t.y], p[t.z]}));
    }
    return float(std::max(nearest / 2, bounds.radius / 2000));
}

}  // namespace gnomon
