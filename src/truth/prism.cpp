#include "truth/prism.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// |u| x |v| with plus for minus: what the rounding of u x v is relative to.
double crossSizeSum(const glm::dvec3& u, const glm::dvec3& v) {
    const glm::dvec3 a = glm::abs(u), b = glm::abs(v);
    return a.y * b.z + a.z * b.y + a.z * b.x + a.x * b.z + a.x * b.y + a.y * b.x;
}

}  // namespace

Prism::Prism(const LitTriangle& triangle, const glm::dvec4& light, const PrismFrame& frame) {
    const glm::dvec3 p[3] = {triangle.corners[0], triangle.corners[1], triangle.corners[2]};
    const glm::dvec3 l(light);
    for (int k = 0; k < 4; ++k) {
        const glm::dvec3 &from = p[k % 3], &to = p[(k + 1) % 3];
        const glm::dvec3 u = k == 3 ? p[2] - p[0] : light.w == 0 ? from - to : to - l;
        const glm::dvec3 v = k == 3 ? p[1] - p[0] : light.w == 0 ? l : from - l;
        const glm::dvec3 through = (k != 3 && light.w != 0 ? l : from) - frame.base;
        const glm::dvec3 normal = glm::cross(u, v);
        const double length = glm::length(normal);
        // Its direction must be right to a rounding of float or two.
        if (!(length > 1e-8 * crossSizeSum(u, v)) || !(length > 1e-150)) continue;
        // Scaled down where the plane was put farther off than most, so that one slack does for all.
        const double off = std::abs(through.x) + std::abs(through.y) + std::abs(through.z);
        const glm::dvec3 unit = normal / (length * std::max(1.0, off / frame.distance));
        x[k] = float(unit.x), y[k] = float(unit.y), z[k] = float(unit.z);
        constant[k] = float(-glm::dot(unit, through));
    }
}

}  // namespace gnomon
