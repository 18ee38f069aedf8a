#include "scene/light_map.h"

#include <algorithm>
#include <cmath>

#include "scene/framing.h"

namespace gnomon {
namespace {

LightMap cubeMap(const glm::dvec3& light, double nearPlane, int size) {
    LightMap map;
    for (const CubeFace& face : kCubeFaces) {
        View view{.eye = light, .right = face.right, .up = face.up, .forward = face.forward};
        view.nearPlane = nearPlane;
        view.width = view.height = size;
        map.faces.push_back(view);
    }
    return map;
}

LightMap parallelMap(const glm::dvec3& towards, const Bounds& bounds, int size) {
    const double radius = std::max(bounds.radius, 1e-30);
    View view{.forward = -glm::normalize(towards)};
    const glm::dvec3 side = std::abs(view.forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    view.right = glm::normalize(glm::cross(view.forward, side));
    view.up = glm::cross(view.right, view.forward);
    view.eye = bounds.centre - radius * view.forward;
    view.tanHalfX = view.tanHalfY = radius;
    view.nearPlane = 1;
    view.width = view.height = size;
    return {.faces = {view}, .parallel = true};
}

}  // namespace

const CubeFace kCubeFaces[6] = {
    {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
};

glm::dvec3 LightMap::coordinates(const glm::dvec3& p) const {
    return coordinateStep(p - faces.front().eye);
}

glm::dvec3 LightMap::coordinateStep(const glm::dvec3& step) const {
    if (!parallel) return step;
    const View& view = faces.front();
    const double half = view.tanHalfX;
    return {glm::dot(step, view.right) / half, glm::dot(step, view.up) / half,
            glm::dot(step, view.forward) / (2 * half)};
}

LightMap lightMap(const Scene& scene, const glm::vec4& light, int size) {
    const Bounds bounds = boundsOf(scene.objects);
    if (light.w == 0) return parallelMap(glm::dvec3(light), bounds, size);
    // The program that compares depths has it as a float.
    return cubeMap(glm::dvec3(light), float(2e-3 * bounds.radius), size);
}

}  // namespace gnomon
