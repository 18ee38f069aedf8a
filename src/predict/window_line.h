#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "scene/view.h"

namespace gnomon {

/// A function that is affine over the window: x, y in pixels, y up, pixel centres at .5.
struct WindowLine {
    double x = 0, y = 0, c = 0;

    double at(double px, double py) const { return x * px + y * py + c; }
    double slope() const { return std::hypot(x, y); }
};

/// normal . rayDirection(view, x, y)
inline WindowLine alongRays(const View& view, const glm::dvec3& normal) {
    const double right = view.tanHalfX * glm::dot(normal, view.right),
                 up = view.tanHalfY * glm::dot(normal, view.up);
    return {2 * right / view.width, 2 * up / view.height, glm::dot(normal, view.forward) - right - up};
}

}  // namespace gnomon
