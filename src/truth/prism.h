#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "truth/predicates.h"

namespace gnomon {

/// Where prisms' coordinates begin, and how far their triangles are from there, roughly.
struct PrismFrame {
    glm::dvec3 base{};
    double distance = 0;
};

/// What a triangle hides from the light, as four planes in float: three through its edges and the light, one
/// of its own. Each value is the distance from the plane, positive inside, or less than that. Plane stands
/// beside plane in one cache line, so that all are computed as one.
struct alignas(64) Prism {
    /// A plane that is not certain in double precision is 0 everywhere: any point may be inside it.
    /// @pre the triangle casts
    Prism(const LitTriangle& triangle, const glm::dvec4& light, const PrismFrame& frame);

    using Four [[gnu::vector_size(16)]] = float;
    Four x{}, y{}, z{}, constant{};
};

/// A point and its neighbourhood, to be held against prisms.
class Probe {
  public:
    /// @param radius  world units, the point's own error included
    Probe(const glm::dvec3& point, double radius, const PrismFrame& frame) {
        const glm::dvec3 from = point - frame.base;
        m_x = float(from.x), m_y = float(from.y), m_z = float(from.z);
        // Normals are right to 2^-22, of the distance from where the plane was put; and some 6 roundings.
        const double size = std::abs(from.x) + std::abs(from.y) + std::abs(from.z) + frame.distance;
        m_slack = float(1.001 * radius + 1e-6 * size);
    }

    /// Whether all of the neighbourhood is inside, or nothing of it.
    Answer isIn(const Prism& prism) const {
        const Prism::Four value = prism.x * m_x + prism.y * m_y + prism.z * m_z + prism.constant;
        const float least = std::min(std::min(value[0], value[1]), std::min(value[2], value[3]));
        return least < -m_slack ? Answer::No : least > m_slack ? Answer::Yes : Answer::Unsure;
    }

  private:
    float m_x = 0, m_y = 0, m_z = 0, m_slack = 0;
};

}  // namespace gnomon
