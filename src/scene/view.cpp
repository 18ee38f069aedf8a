#include "scene/view.h"

#include <cmath>
#include <limits>

namespace gnomon {

View viewOf(const Camera& camera, int width, int height) {
    View view;
    view.eye = camera.eye;
    view.forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
    glm::dvec3 up = camera.up;
    if (glm::length(glm::cross(view.forward, up)) < 1e-6 * glm::length(up))
        up = std::abs(view.forward.z) < 0.9 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    view.right = glm::normalize(glm::cross(view.forward, up));
    view.up = glm::cross(view.right, view.forward);
    view.tanHalfY = std::tan(glm::radians(double(camera.fovDegrees)) / 2);
    view.tanHalfX = view.tanHalfY * width / height;
    view.nearPlane = camera.nearPlane;
    view.width = width;
    view.height = height;
    return view;
}

glm::dmat4 eyeFromWorld(const View& view) {
    glm::dmat4 m(1);
    const glm::dvec3 rows[3] = {view.right, view.up, -view.forward};
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) m[c][r] = rows[r][c];
        m[3][r] = -glm::dot(rows[r], view.eye);
    }
    return m;
}

glm::dmat4 clipFromEye(const View& view) {
    glm::dmat4 m(0);
    m[0][0] = 1 / view.tanHalfX;
    m[1][1] = 1 / view.tanHalfY;
    m[2][2] = -1;
    m[2][3] = -1;
    m[3][2] = -2 * view.nearPlane;
    return m;
}

glm::dvec3 rayDirection(const View& view, double x, double y) {
    const double sx = (2 * x / view.width - 1) * view.tanHalfX;
    const double sy = (2 * y / view.height - 1) * view.tanHalfY;
    return view.forward + sx * view.right + sy * view.up;
}

double windowDepth(const View& view, double z) {
    return 1 - view.nearPlane / z;
}

double distanceAtDepth(const View& view, double depth) {
    if (depth >= 1) return std::numeric_limits<double>::infinity();
    return view.nearPlane / (1 - depth);
}

}  // namespace gnomon
