#include "truth/count_ties.h"

#include <algorithm>
#include <cmath>

#include "truth/infinity.h"

namespace gnomon {
namespace {

constexpr double kCorner = 1.4142135623730951 * kSubpixel;  ///< how far rounding may move a point, pixels
constexpr double kLongestRise = 0x1p-8;  ///< of a side within reach; steeper ones are too thin
constexpr double kFarBehind = 2000;      ///< in reaches: twice the scene's diagonal

}  // namespace

Tie CountTies::at(const LitTriangle& own, const RayPoint& point, const Beside& beside) {
    if (m_world.sides.empty()) return Tie::None;
    const glm::dvec3 corner(own.corners[0]);
    const glm::dvec2 gradient = depthGradient(
        glm::cross(glm::dvec3(own.corners[1]) - corner, glm::dvec3(own.corners[2]) - corner), corner);

    // The longest band around the point, cut off far behind it (where it is longer than the scene).
    const double depth = windowDepth(m_view, point.t());
    const double length = glm::length(point.ray().direction);
    const double band = m_ties.bandAt(depth);
    const double longest = band + (beside.reach > 0 ? kLongestRise : 0);
    const double first = distanceAtDepth(m_view, std::max(0.0, depth - longest));
    const double last = std::min(distanceAtDepth(m_view, depth + longest),
                                 point.t() + kFarBehind * m_world.edges.reach() / length);

    findSides(point, first, last);

    // The count at the point is that at the start of the band and the sides between; of them, and of
    // those just behind the point, the near ones may be counted or not. At worst all near backs are and
    // no near front is.
    bool any = false;
    int backs = 0;
    for (const std::uint32_t index : m_near) {
        const SideEdge& side = m_world.sides[index];
        const Crossing c = crossSide(side, point.ray());
        const bool isInRange = c.t >= first && c.t <= last;
        const double rise = std::min(kLongestRise, beside.reach * glm::length(c.gradient - gradient));
        const bool isClose =
            isInRange && c.miss <= kCorner && std::abs(windowDepth(m_view, c.t) - depth) <= band + rise;
        const bool isNear = isClose || (beside.reach > 0 && hangsBeside(side, beside));
        any = any || isNear;
        if (isNear)
            backs -= std::min(c.face, 0);
        else if (isInRange && c.miss <= 0 && c.t < point.t())
            backs -= c.face;
    }
    if (!any) return Tie::None;
    return isCrossedMoreThan(backs, RayPoint(point.ray(), first)) ? Tie::CountIfClamped : Tie::Count;
}

/// Collects the sides that may cross the ray from @p first to @p last. A side does where its edge crosses the
/// triangle between that piece and the light: look along rays to the light, close enough that one of them
/// passes within reach of any such edge.
void CountTies::findSides(const RayPoint& point, double first, double last) {
    const double length = glm::length(point.ray().direction);
    m_near.clear();
    const double steps = std::ceil((last - first) * length / m_world.edges.reach());
    const int rays = std::max(1, static_cast<int>(steps));
    for (int i = 0; i < rays; ++i) {
        const double t = first + (last - first) * (i + 0.5) / rays;
        const glm::dvec3 from = point.ray().eye + t * point.ray().direction;
        m_world.towardsLight(m_world.edges, from, [&](std::uint32_t index) {
            m_near.push_back(index);
            return true;
        });
    }
    std::sort(m_near.begin(), m_near.end());
    m_near.erase(std::unique(m_near.begin(), m_near.end()), m_near.end());
}

/// Whether the edge from which the side hangs passes through the neighbourhood and is not hidden there.
bool CountTies::hangsBeside(const SideEdge& side, const Beside& beside) const {
    glm::dvec2 ends[2];
    double depths[2];
    for (int k = 0; k < 2; ++k) {
        const glm::dvec3 p = glm::dvec3(k == 0 ? side.from : side.to) - m_view.eye;
        const double t = glm::dot(p, m_view.forward);
        if (t < m_view.nearPlane) return false;
        ends[k] = {(glm::dot(p, m_view.right) / (t * m_view.tanHalfX) + 1) / 2 * m_view.width,
                   (glm::dot(p, m_view.up) / (t * m_view.tanHalfY) + 1) / 2 * m_view.height};
        depths[k] = windowDepth(m_view, t);
    }
    const glm::dvec2 way = ends[1] - ends[0];
    const double squared = glm::dot(way, way);
    const double u = squared > 0 ? std::clamp(glm::dot(beside.centre - ends[0], way) / squared, 0.0, 1.0) : 0;
    return glm::distance(beside.centre, ends[0] + u * way) <= beside.reach &&
           depths[0] + u * (depths[1] - depths[0]) <= beside.farthest + m_ties.bandAt(beside.farthest);
}

/// How the ray crosses the side: an infinite strip from its edge away from the light.
CountTies::Crossing CountTies::crossSide(const SideEdge& side, const EyeRay& ray) const {
    const glm::dvec3 l(m_world.light), from(side.from), to(side.to), d = ray.direction;
    const bool directional = m_world.light.w == 0;
    const glm::dvec3 f = from - ray.eye, g = to - ray.eye;
    const glm::dvec3 fAway = directional ? -l : from - l, gAway = directional ? -l : to - l;
    const glm::dvec3 borders[4] = {glm::cross(g, f), glm::cross(f, fAway),
                                   directional ? glm::dvec3(0) : glm::cross(fAway, gAway),
                                   glm::cross(gAway, g)};
    // Pixels by which the ray lies beyond the border that it is farthest beyond, for either winding.
    double beyond[2] = {-kInfinity, -kInfinity};
    for (const glm::dvec3& border : borders) {
        const glm::dvec2 rise(2 * m_view.tanHalfX / m_view.width * glm::dot(border, m_view.right),
                              2 * m_view.tanHalfY / m_view.height * glm::dot(border, m_view.up));
        const double size = glm::length(rise);
        if (size == 0) continue;
        const double distance = glm::dot(border, d) / size;
        beyond[0] = std::max(beyond[0], -distance);
        beyond[1] = std::max(beyond[1], distance);
    }

    const glm::dvec3 outward = glm::cross(to - from, directional ? l : l - from);
    const double height = -glm::dot(outward, f), slope = glm::dot(outward, d);
    const double t = -height / slope;
    Crossing crossing{.face = height > 0 ? side.weight : -side.weight};
    if (height == 0 || slope == 0 || t < m_view.nearPlane) return crossing;
    crossing.miss = std::min(beyond[0], beyond[1]);
    crossing.t = t;
    crossing.gradient = depthGradient(outward, from);
    return crossing;
}

/// How a plane's window depth rises, per pixel. Window depth is 1 - near/t, and 1/t is affine in the
/// window.
glm::dvec2 CountTies::depthGradient(const glm::dvec3& normal, const glm::dvec3& onPlane) const {
    const double scale = -2 * m_view.nearPlane / glm::dot(normal, onPlane - m_view.eye);
    return scale * glm::dvec2(glm::dot(normal, m_view.right) * m_view.tanHalfX / m_view.width,
                              glm::dot(normal, m_view.up) * m_view.tanHalfY / m_view.height);
}

/// Whether more than @p count casters' triangles lie between the point and the light; exact.
bool CountTies::isCrossedMoreThan(int count, const RayPoint& point) {
    m_counted.clear();
    m_world.castersTowardsLight(point, 0, [&](std::uint32_t index, Answer crossed) {
        if ((crossed == Answer::Yes || crossesExactly(m_world.triangles[index], m_world.light, point)) &&
            std::find(m_counted.begin(), m_counted.end(), index) == m_counted.end())
            m_counted.push_back(index);
        return static_cast<int>(m_counted.size()) <= count;
    });
    return static_cast<int>(m_counted.size()) > count;
}

}  // namespace gnomon
