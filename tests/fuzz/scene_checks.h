#pragma once

#include <cmath>

#include "fuzz.h"
#include "scene/load.h"
#include "scene/view.h"
#include "scene/weld.h"

namespace gnomon::fuzz {

/// Few enough that an input takes no second, and more than the corpus has.
inline const SceneLimits kSmallLimits{.meshBytes = 1 << 20,
                                      .tomlBytes = 1 << 20,
                                      .triangles = 20'000,
                                      .objects = 2'000,
                                      .polygonSteps = 10'000'000,
                                      .jsonValues = 10'000};

inline bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline bool isShare(const glm::vec3& colour) {
    return glm::all(glm::greaterThanEqual(colour, glm::vec3(0))) &&
           glm::all(glm::lessThanEqual(colour, glm::vec3(1)));
}

inline void checkObjects(const std::vector<Object>& objects) {
    for (const Object& object : objects) {
        require(isOneLine(object.name), "name of an object");
        require(!object.mesh.triangles.empty(), "object without a triangle");
        require(isShare(object.colour), "colour of an object");
        for (const glm::vec3& p : object.mesh.positions) require(isFinite(p), "position");
        for (const glm::uvec3& t : object.mesh.triangles)
            for (int k = 0; k < 3; ++k) require(t[k] < object.mesh.positions.size(), "index");
    }
}

inline void checkLights(const std::vector<Light>& lights) {
    for (const Light& light : lights) {
        const glm::dvec3 xyz(light.position);
        require(isFinite(xyz) && isFinite(light.colour), "light");
        require(light.position.w == 1 || (light.position.w == 0 && std::abs(glm::length(xyz) - 1) < 1e-6),
                "direction of a light");
        require(glm::all(glm::greaterThanEqual(light.colour, glm::vec3(0))), "colour of a light");
    }
}

/// What draws takes for granted of a scene.
inline void checkScene(const Scene& scene) {
    require(isOneLine(scene.title) && !scene.id.empty(), "title or id");
    for (const std::string& note : scene.notes) require(!note.empty() && isOneLine(note), "note");
    require(triangleCount(scene) <= kSmallLimits.triangles + 2, "more triangles than the limit");
    require(scene.objects.size() <= kSmallLimits.objects + 1, "more objects than the limit");
    checkObjects(scene.objects);
    checkLights(scene.lights);
    require(scene.ambient >= 0 && scene.ambient <= 1 && isShare(scene.background), "ambient or background");
    require(!scene.frames.empty(), "no frame");
    // Paths may be long, and their ends are as good as all of them.
    const std::size_t step = 1 + scene.frames.size() / 64;
    for (std::size_t f = 0; f < scene.frames.size(); f += step) {
        const Camera& camera = scene.frames[f];
        require(std::isfinite(camera.nearPlane) && camera.nearPlane > 0, "near plane");
        require(camera.fovDegrees > 0 && camera.fovDegrees < 180, "field of view");
        const View view = viewOf(camera, 320, 240);
        for (const glm::dvec3& axis : {view.forward, view.right, view.up})
            require(std::abs(glm::length(axis) - 1) < 1e-6, "axis of a view");
        require(isFinite(view.eye) && std::isfinite(1 / view.tanHalfX), "view");
    }
}

}  // namespace gnomon::fuzz
