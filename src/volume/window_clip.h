#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "scene/view.h"

namespace gnomon {

inline const glm::vec4& positionOf(const glm::vec4& p) {
    return p;
}
/// Where an edge is cut: v a + u b, in double precision, rounded once.
inline glm::vec4 between(const glm::vec4& a, const glm::vec4& b, double v, double u) {
    return glm::vec4(v * glm::dvec4(a) + u * glm::dvec4(b));
}

/// Cuts convex polygons in clip space at the sides of the window, a quarter pixel outside of the outermost
/// pixel centres, so that OpenGL has nothing to clip. llvmpipe culls what it clips by another sign of the
/// area than what it rasterises, and a sliver may fall out of the pass for front faces and of that for back
/// faces too.
///
/// Faces that share an edge to the bit share its cut point to the bit: it is computed from the edge's ends in
/// one order. @p Point has positionOf() and between(), found where it is declared.
template <class Point>
class WindowClip {
  public:
    explicit WindowClip(const View& view) : m_limits{1 - 0.5 / view.width, 1 - 0.5 / view.height} {}

    /// The part of the polygon inside; empty if it has none. Valid until the next call.
    std::span<const Point> cut(std::span<const Point> polygon) {
        if (isInside(polygon)) return polygon;
        for (const int axis : {0, 1}) {
            for (const double sign : {1.0, -1.0}) {
                const bool isOutside = std::all_of(polygon.begin(), polygon.end(), [&](const Point& p) {
                    return height(positionOf(p), axis, sign) < 0;
                });
                if (isOutside) return {};
            }
        }
        m_polygon.assign(polygon.begin(), polygon.end());
        for (const int axis : {0, 1})
            for (const double sign : {1.0, -1.0}) cut(axis, sign);
        return m_polygon;
    }

  private:
    double height(const glm::vec4& p, int axis, double sign) const {
        return m_limits[axis] * p.w - sign * p[axis];
    }

    bool isInside(std::span<const Point> polygon) const {
        return std::all_of(polygon.begin(), polygon.end(), [&](const Point& point) {
            const glm::vec4& p = positionOf(point);
            return std::abs(p.x) <= m_limits[0] * p.w && std::abs(p.y) <= m_limits[1] * p.w;
        });
    }

    Point cutPoint(const Point& p, const Point& q, int axis, double sign) const {
        const glm::vec4 &a = positionOf(p), &b = positionOf(q);
        if (std::tie(b.x, b.y, b.z, b.w) < std::tie(a.x, a.y, a.z, a.w)) return cutPoint(q, p, axis, sign);
        const double ha = std::abs(height(a, axis, sign)), hb = std::abs(height(b, axis, sign));
        return between(p, q, hb / (ha + hb), ha / (ha + hb));
    }

    /// Keeps what lies within the limit on one side of the window.
    void cut(int axis, double sign) {
        m_kept.clear();
        for (std::size_t i = 0; i < m_polygon.size(); ++i) {
            const Point &a = m_polygon[i], &b = m_polygon[(i + 1) % m_polygon.size()];
            const bool aInside = height(positionOf(a), axis, sign) >= 0,
                       bInside = height(positionOf(b), axis, sign) >= 0;
            if (aInside) m_kept.push_back(a);
            if (aInside != bInside) m_kept.push_back(cutPoint(a, b, axis, sign));
        }
        m_polygon.swap(m_kept);
    }

    double m_limits[2];
    std::vector<Point> m_polygon{}, m_kept{};
};

}  // namespace gnomon
