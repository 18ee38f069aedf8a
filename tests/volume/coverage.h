#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace gnomon {

/// Triangles that cover the point (x, y) of the window (-1 to 1), those that are counter-clockwise as +1,
/// others as -1; nothing if an edge passes too close to the point to be sure.
inline std::optional<int> coverage(std::span<const glm::vec4> triangles, double x, double y) {
    int sum = 0;
    for (std::size_t i = 0; i + 3 <= triangles.size(); i += 3) {
        int inside = 0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec4 a = triangles[i + k], b = triangles[i + (k + 1) % 3];
            // (a x b) . (x, y, 1) in homogeneous window coordinates; each factor is at most of this size.
            const glm::dvec3 p(a.x, a.y, a.w), q(b.x, b.y, b.w), at(x, y, 1);
            const double value = glm::dot(glm::cross(p, q), at);
            if (std::abs(value) < 1e-5 * glm::length(p) * glm::length(q)) return std::nullopt;
            inside += value > 0 ? 1 : -1;
        }
        if (std::abs(inside) == 3) sum += inside / 3;
    }
    return sum;
}

}  // namespace gnomon
