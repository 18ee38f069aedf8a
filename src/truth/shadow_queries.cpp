#include "truth/shadow_queries.h"

#include <algorithm>

namespace gnomon {

void ShadowQueries::answer(std::span<const Visible> points, std::span<Answered> answers) {
    constexpr std::size_t kBatch = 64;  // what they read fits the first cache
    LightGrid::Place places[kBatch];
    const LightGrid& casters = m_world.casters;
    for (std::size_t first = 0; first < points.size(); first += kBatch) {
        const std::size_t count = std::min(kBatch, points.size() - first);
        for (std::size_t i = 0; i < count; ++i)
            places[i] = casters.fetchCell(points[first + i].point.position());
        for (std::size_t i = 0; i < count; ++i) casters.fetchEntries(places[i]);
        for (std::size_t i = 0; i < count; ++i) casters.fetchPrisms(places[i]);
        for (std::size_t i = 0; i < count; ++i) answers[first + i] = at(points[first + i]);
    }
}

ShadowQueries::Answered ShadowQueries::at(const Visible& visible) {
    const Hit& hit = visible.hit;
    const SeenSurface& surface = visible.surface;
    const RayPoint& point = visible.point;
    if (surface.facesAway) return {.blocked = isBlocked(point, surface)};

    // How far the visible point moves within 1/256 pixel, and within one quantum of depth.
    const double length = glm::length(point.ray().direction);
    const double beside = (hit.t.high - hit.t.low) * length + 1.01 * hit.t.high * m_rays.steps;
    const double along = m_rays.quantumAt(hit.t.high) * length;
    const double reach = m_world.surfaces.reach() / 2;
    const bool coversDepth = beside + along < reach;
    bool isAllNear = false;
    if (beside < reach) {
        const Answer blocked =
            isBlockedAround(point, surface.triangle, coversDepth ? beside + along : beside);
        if (blocked != Answer::Unsure) {
            const bool isYes = blocked == Answer::Yes;
            return {isYes, !coversDepth && changesWithDepth(surface, point, isYes)};
        }
        isAllNear = coversDepth;
    }

    // One by one: the point, the same a quantum of depth before and behind, and where a rasteriser may see
    // it.
    const auto ask = [&](const RayPoint& at) {
        return isAllNear ? isBlockedByNear(at) : isBlocked(at, surface.triangle);
    };
    const bool blocked = ask(point);
    for (const double shift : shiftsOf(point))
        if (ask(point.moved(shift)) != blocked) return {blocked, true};
    for (const glm::dvec2& corner : kCorners) {
        const EyeRay ray = m_rays.at(visible.x + corner.x, visible.y + corner.y);
        if (ask(RayPoint(ray, m_rays.triangle(surface))) != blocked) return {blocked, true};
    }
    return {blocked, false};
}

bool ShadowQueries::isBlocked(const RayPoint& point, std::uint32_t own) {
    ++m_asked;
    bool blocked = false;
    m_world.castersTowardsLight(point, 0, [&](std::uint32_t index, Answer crossed) {
        blocked = index != own &&
                  (crossed == Answer::Yes || crossesExactly(m_world.triangles[index], m_world.light, point));
        return !blocked;
    });
    return blocked;
}

Answer ShadowQueries::isBlockedAround(const RayPoint& point, std::uint32_t own, double radius) {
    ++m_asked;
    Answer blocked = Answer::No;
    m_near.clear();
    m_world.castersTowardsLight(point, radius, [&](std::uint32_t index, Answer crossed) {
        if (index == own) return true;
        if (crossed == Answer::Unsure)
            crossed = crosses(m_world.triangles[index], m_world.light, point, radius);
        if (crossed == Answer::No) return true;
        blocked = crossed;
        m_near.push_back(index);
        return blocked != Answer::Yes;
    });
    return blocked;
}

/// Of a point in the neighbourhood that was unsure just before: nothing else can block it.
bool ShadowQueries::isBlockedByNear(const RayPoint& point) {
    ++m_asked;
    return std::any_of(m_near.begin(), m_near.end(), [&](std::uint32_t index) {
        return crossesExactly(m_world.triangles[index], m_world.light, point);
    });
}

bool ShadowQueries::changesWithDepth(const SeenSurface& surface, const RayPoint& point, bool blocked) {
    if (surface.facesAway) return false;
    for (const double shift : shiftsOf(point))
        if (isBlocked(point.moved(shift), surface.triangle) != blocked) return true;
    return false;
}

/// One quantum of depth towards the eye, not before the near plane, and one away from it.
std::array<double, 2> ShadowQueries::shiftsOf(const RayPoint& point) const {
    const double quantum = m_rays.quantumAt(point.t());
    return {-std::min(quantum, point.t() - m_rays.view.nearPlane), quantum};
}

}  // namespace gnomon
