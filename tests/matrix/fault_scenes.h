#pragma once

#include <cmath>
#include <numbers>

#include "gl/tools.h"

namespace gnomon {

/// Three pages that share their spine: an edge of three triangles that a light from above sees walk it the
/// same way, so that three sides hang there.
inline Mesh bookOf() {
    Mesh pages{.positions = {{0, 0, 1}, {0, 0, -1}}, .triangles = {}};
    for (int page = 0; page < 3; ++page) {
        const double angle = (9.0 + 19.0 * page) * std::numbers::pi / 180;
        const glm::vec3 out(float(1.9 * std::cos(angle)), float(1.9 * std::sin(angle)), 0);
        const auto first = std::uint32_t(pages.positions.size());
        pages.positions.push_back(pages.positions[0] + out);
        pages.positions.push_back(pages.positions[1] + out);
        pages.triangles.push_back({0, first, first + 1});
        pages.triangles.push_back({0, first + 1, 1});
    }
    return pages;
}

/// Two books, one behind the other, high enough for the eye to look below the first and through its three
/// shadows onto those of the second.
inline Scene twoBooks() {
    Scene scene;
    scene.objects = {placed("floor", rectangle({9, 9}), {0, 0, 0}, false),
                     placed("front", bookOf(), {-0.13f, 1.91f, 1.23f}),
                     placed("back", bookOf(), {-0.37f, 1.73f, -1.17f})};
    scene.lights = {{.position = {0.9f, 8.3f, 0.4f, 1}}};
    scene.frames = {
        {.eye = {2.3f, 3.7f, 5.3f}, .target = {0.6f, 0.4f, 0}, .fovDegrees = 50, .nearPlane = 0.5f}};
    return scene;
}

/// The boxes with a light below them, before the eye: their volumes end in the sky, and far behind the floor.
inline Scene boxesBeforeTheSky() {
    Scene scene = twoBoxes();
    scene.lights[0].position = {2.1f, 0.5f, 4.9f, 1};
    scene.frames[0].eye = {2.9f, 2.1f, 5.7f};
    scene.frames[0].target = {0, 1.3f, 0};
    return scene;
}

/// The boxes with a light behind the eye: their volumes end behind the floor that is seen.
inline Scene boxesBeforeTheLight() {
    Scene scene = twoBoxes();
    scene.lights[0].position = {3.9f, 5.2f, 9.3f, 1};
    return scene;
}

inline Scene inSunlight(Scene scene) {
    const auto towards = glm::normalize(glm::dvec3(0.21, 0.93, 0.17));
    scene.lights[0].position = glm::vec4(glm::vec3(towards), 0);
    return scene;
}

inline Scene twoBoxesInTheSun() {
    return inSunlight(twoBoxes());
}

}  // namespace gnomon
