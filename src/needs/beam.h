#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "needs/receivers.h"
#include "truth/infinity.h"
#include "volume/clip_space.h"

// Positions are from the eye, homogeneous.

namespace gnomon {

/// Of a sum of products, as a share of the sum of their sizes.
inline constexpr double kBeamRounding = 1e-12;
inline constexpr double kBeamBoxRounding = 1e-12;      ///< of a coordinate
inline constexpr double kBeamProductRounding = 4e-15;  ///< of a product of lengths; more than 16 roundings

inline glm::dvec4 finitePoint(const glm::dvec3& p) {
    return {p, 1};
}

/// Positive beyond it.
struct BeamPlane {
    glm::dvec3 normal{};
    double height = 0;
    double normalError = 0, heightError = 0;

    /// On which side the point lies; 0 where rounding hides it.
    int side(const glm::dvec4& p) const {
        const double x = normal.x * p.x, y = normal.y * p.y, z = normal.z * p.z, w = height * p.w;
        const double value = x + y + z + w;
        const double slack = kBeamRounding * (std::abs(x) + std::abs(y) + std::abs(z) + std::abs(w)) +
                             normalError * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z)) +
                             heightError * std::abs(p.w);
        return value > slack ? 1 : value < -slack ? -1 : 0;
    }
    BeamPlane operator-() const { return {-normal, -height, normalError, heightError}; }
};

/// The plane through a, @p way from there and c; without a normal if they are on one line.
inline BeamPlane planeThrough(const glm::dvec4& a, const glm::dvec4& way, const glm::dvec4& c) {
    const glm::dvec3 p(a), q(way), r(c), qr = glm::cross(q, r);
    const double pSize = glm::length(p), qSize = glm::length(q), rSize = glm::length(r);
    return {
        a.w * qr + way.w * glm::cross(r, p) + c.w * glm::cross(p, q), -glm::dot(p, qr),
        kBeamProductRounding * (a.w * qSize * rSize + std::abs(way.w) * rSize * pSize + c.w * pSize * qSize),
        kBeamProductRounding * pSize * qSize * rSize};
}

template <class Points>
bool allBeyond(const BeamPlane& plane, const Points& points) {
    return std::all_of(std::begin(points), std::end(points),
                       [&](const glm::dvec4& p) { return plane.side(p) > 0; });
}
template <class Points>
bool noneBeyond(const BeamPlane& plane, const Points& points) {
    return std::none_of(std::begin(points), std::end(points),
                        [&](const glm::dvec4& p) { return plane.side(p) > 0; });
}

struct BeamBox {
    glm::dvec3 low{kInfinity}, high{-kInfinity};
    void include(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
    void include(const BeamBox& other) { low = glm::min(low, other.low), high = glm::max(high, other.high); }
};

/// A plane to hold boxes against, quickly.
struct BeamBoxPlane {
    glm::dvec3 normal{}, size{};  ///< its components without signs
    double height = 0;            ///< less all rounding

    BeamBoxPlane() = default;
    /// @param farthest  no coordinate of a box lies farther away
    BeamBoxPlane(const BeamPlane& plane, double farthest)
        : normal(plane.normal), size(glm::abs(plane.normal)) {
        const double slack =
            kBeamRounding * (std::abs(plane.height) + farthest * (size.x + size.y + size.z)) +
            3 * plane.normalError * farthest + plane.heightError;
        height = plane.height - 2 * slack;
    }

    bool hasBeyond(const glm::dvec3& middle, const glm::dvec3& half) const {
        return glm::dot(normal, middle) + height > glm::dot(size, half);
    }
};

/// The convex hull of a patch and the light.
class Beam {
  public:
    /// @param farthest  no coordinate of a box lies farther away
    Beam(std::span<const Receivers::Corner> corners, const glm::dvec4& light, double farthest)
        : m_light(light) {
        for (const Receivers::Corner& c : corners) m_front.push_back({c.direction, c.nearer});
        for (const Receivers::Corner& c : corners) m_all.push_back({c.direction, c.nearer});
        for (const Receivers::Corner& c : corners) m_all.push_back({c.direction, c.farther});
        for (const glm::dvec4& p : m_all) bound(p);
        bound(m_light);
        const int n = m_front.size();
        // Through the light and what it sees as the patch's outline.
        for (int i = 0; i < n; ++i) {
            const int next = (i + 1) % n;
            addOutline(m_planes, m_all, m_all[i], m_all[next] - m_all[i]);
            addOutline(m_planes, m_all, m_all[n + i], m_all[n + next] - m_all[n + i]);
            addOutline(m_planes, m_all, m_all[i], {0, 0, 0, m_all[n + i].w - m_all[i].w});
        }
        // The patch's own faces that the light sees from behind.
        m_frontPlane = facing(planeOf(0));
        addFace(facing(planeOf(0)));
        addFace(facing(planeOf(n)));
        for (int i = 0; i < n; ++i)
            addFace(facing({glm::cross(glm::dvec3(m_front[i]), glm::dvec3(m_front[(i + 1) % n])), 0}));
        for (const BeamPlane& plane : m_planes) m_boxPlanes.push_back({plane, farthest});
    }

    bool misses(const BeamBox& box) {
        for (int k = 0; k < 3; ++k)
            if (box.low[k] > m_box.high[k] || box.high[k] < m_box.low[k]) return true;
        const glm::dvec3 middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
        // What parted the last box from the beam is likely to part this one.
        const int count = m_boxPlanes.size();
        for (int i = 0, at = m_parting; i < count; ++i, at = at + 1 < count ? at + 1 : 0) {
            if (!m_boxPlanes[at].hasBeyond(middle, half)) continue;
            m_parting = at;
            return true;
        }
        return false;
    }

    /// Whether the lit triangle may come between the light and some point just before a surface.
    bool isCutBy(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const glm::dvec4 corners[3] = {finitePoint(a), finitePoint(b), finitePoint(c)};
        if (hasBeyond(m_planes, corners)) return false;
        const glm::dvec4 toC = corners[2] - corners[0];
        if (allBeyond(planeThrough(corners[0], corners[1] - corners[0], toC), m_front)) return false;
        if (m_frontPlane && allBeyond(*m_frontPlane, corners)) return false;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec4 &from = corners[k], &to = corners[(k + 1) % 3];
            BeamPlane plane = planeThrough(from, to - from, m_light);
            const int inside = plane.side(corners[(k + 2) % 3]);
            if (inside == 0) continue;
            if (inside > 0) plane = -plane;
            if (allBeyond(plane, m_front)) return false;
        }
        if (!m_hasFrontPlanes) {
            m_hasFrontPlanes = true;
            for (int i = 0; i < m_front.size(); ++i)
                addOutline(m_frontPlanes, m_front, m_front[i],
                           m_front[(i + 1) % m_front.size()] - m_front[i]);
        }
        if (hasBeyond(m_frontPlanes, corners)) return false;
        // Normal to an edge of each.
        for (int i = 0; i < m_front.size(); ++i)
            for (int k = 0; k < 3; ++k)
                if (partsAlong(m_front, m_front[i], m_front[(i + 1) % m_front.size()],
                               corners[(k + 1) % 3] - corners[k], corners))
                    return false;
        return true;
    }

    /// Whether the side that hangs from the edge may come as near to a surface as depths may be off by.
    bool isTouchedFrom(const glm::dvec3& from, const glm::dvec3& to) const {
        const glm::dvec4 ends[2] = {finitePoint(from), finitePoint(to)};
        if (hasBeyond(m_planes, ends)) return false;
        const BeamPlane plane = planeThrough(ends[0], ends[1] - ends[0], m_light);
        if (allBeyond(plane, m_all) || allBeyond(-plane, m_all)) return false;
        const int n = m_front.size();
        for (int i = 0; i < n; ++i) {
            const int next = (i + 1) % n;
            for (const auto& [a, b] : {std::pair(i, next), std::pair(n + i, n + next), std::pair(i, n + i)})
                if (partsAlong(m_all, m_all[a], m_all[b], ends[1] - ends[0], ends)) return false;
        }
        return true;
    }

  private:
    void bound(const glm::dvec4& p) {
        for (int k = 0; k < 3; ++k) {
            const double at = p.w > 0 ? p[k] / p.w : std::copysign(kInfinity, p[k]),
                         slack = kBeamBoxRounding * std::abs(at);
            if (p.w == 0 && p[k] == 0) continue;
            m_box.low[k] = std::min(m_box.low[k], at - slack);
            m_box.high[k] = std::max(m_box.high[k], at + slack);
        }
    }

    /// Of the patch's near or far polygon.
    BeamPlane planeOf(int first) const {
        const int n = m_front.size();
        const glm::dvec4 &a = m_all[first], &b = m_all[first + n / 3], &c = m_all[first + 2 * n / 3];
        return planeThrough(a, b - a, c - a);
    }

    /// The plane turned so that the light is not beyond it; nothing if it lies in it.
    std::optional<BeamPlane> facing(const BeamPlane& plane) const {
        const int side = plane.side(m_light);
        if (side == 0) return {};
        return side > 0 ? -plane : plane;
    }

    void addFace(const std::optional<BeamPlane>& plane) {
        if (plane && noneBeyond(*plane, m_all)) m_planes.push_back(*plane);
    }

    template <class Planes, class Points>
    void addOutline(Planes& planes, const Points& points, const glm::dvec4& from, const glm::dvec4& way) {
        const BeamPlane plane = planeThrough(from, way, m_light);
        if (noneBeyond(plane, points)) planes.push_back(plane);
        if (noneBeyond(-plane, points)) planes.push_back(-plane);
    }

    /// Whether the plane through a and b along @p way has all of @p others beyond, and nothing of the beam of
    /// @p points.
    template <class Points, class Others>
    bool partsAlong(const Points& points, const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& way,
                    const Others& others) const {
        const BeamPlane plane = planeThrough(a, b - a, way);
        for (const BeamPlane& one : {plane, -plane})
            if (allBeyond(one, others) && one.side(m_light) <= 0 && noneBeyond(one, points)) return true;
        return false;
    }

    template <class Planes, class Points>
    static bool hasBeyond(const Planes& planes, const Points& points) {
        return std::any_of(planes.begin(), planes.end(),
                           [&](const BeamPlane& plane) { return allBeyond(plane, points); });
    }

    glm::dvec4 m_light;
    Few<glm::dvec4, 8> m_front{};
    Few<glm::dvec4, 16> m_all{};  ///< the near corners, then the far ones
    BeamBox m_box{};
    Few<BeamPlane, 58> m_planes{};        ///< of the beam of the whole patch
    Few<BeamBoxPlane, 58> m_boxPlanes{};  ///< the same
    int m_parting = 0;                    ///< of these
    std::optional<BeamPlane> m_frontPlane{};
    Few<BeamPlane, 16> m_frontPlanes{};  ///< of the beam of the near polygon, made when first asked for
    bool m_hasFrontPlanes = false;
};

}  // namespace gnomon
