#include "scene/camera_path.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/framing.h"

namespace gnomon {
namespace {

/// The box of what casts; of a scene without casters that of all.
Bounds boundsOfCasters(const Scene& scene) {
    std::vector<Object> casters;
    for (const Object& object : scene.objects)
        if (object.casts) casters.push_back(object);
    return boundsOf(casters.empty() ? scene.objects : casters);
}

bool isWithin(const Bounds& bounds, const glm::dvec3& p) {
    return glm::all(glm::greaterThan(p, bounds.least)) && glm::all(glm::lessThan(p, bounds.most));
}

/// @p v, turned by @p angle about the vertical.
glm::dvec3 turned(const glm::dvec3& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

}  // namespace

std::vector<Camera> cameraPath(const Scene& scene, int count) {
    std::vector<Camera> path;
    const std::size_t frames = scene.frames.size();
    if (frames > 1) {
        for (int i = 0; i < count; ++i)
            path.push_back(scene.frames[std::size_t(i) * frames / std::size_t(count)]);
        return path;
    }
    const Bounds bounds = boundsOfCasters(scene);
    const Camera& first = scene.frames.front();
    const glm::dvec3 eye(first.eye);
    const bool inside = isWithin(bounds, eye);
    const glm::dvec3 axes = (bounds.most - bounds.least) / 3.0;
    for (int i = 0; i < count; ++i) {
        const double angle = glm::two_pi<double>() * i / count;
        Camera camera = first;
        if (inside) {
            const double c = std::cos(angle), s = std::sin(angle);
            camera.eye = glm::vec3(bounds.centre.x + axes.x * c, eye.y, bounds.centre.z + axes.z * s);
            camera.target = camera.eye + glm::vec3(glm::normalize(glm::dvec3(-axes.x * s, 0, axes.z * c)));
        } else {
            camera.eye = glm::vec3(bounds.centre + turned(eye - bounds.centre, angle));
            camera.target =
                glm::vec3(bounds.centre + turned(glm::dvec3(first.target) - bounds.centre, angle));
        }
        camera.nearPlane = nearPlaneFor(scene.objects, bounds, camera.eye);
        path.push_back(camera);
    }
    return path;
}

}  // namespace gnomon
