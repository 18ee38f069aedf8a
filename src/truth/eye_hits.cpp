#include "truth/eye_hits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "truth/infinity.h"

namespace gnomon {
namespace {

/// Whether all rays around @p ray pass inside the triangle, or none does.
Answer meets(const EyeRay& ray, const LitTriangle& t, const glm::dvec3& stepX, const glm::dvec3& stepY) {
    constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
    const glm::dvec3 p[3] = {glm::dvec3(t.corners[0]) - ray.eye, glm::dvec3(t.corners[1]) - ray.eye,
                             glm::dvec3(t.corners[2]) - ray.eye};
    int positive = 0, negative = 0;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 &u = p[k], &v = p[(k + 1) % 3];
        const glm::dvec3 edge = glm::cross(u, v);
        const double value = glm::dot(edge, ray.direction);
        // |u| |v| |direction| is no less than the sum of the products' sizes over 3.
        const double slack =
            std::abs(glm::dot(edge, stepX)) + std::abs(glm::dot(edge, stepY)) +
            3 * kRounding *
                std::sqrt(glm::dot(u, u) * glm::dot(v, v) * glm::dot(ray.direction, ray.direction));
        positive += value > slack;
        negative += value < -slack;
    }
    if (positive > 0 && negative > 0) return Answer::No;
    return positive == 3 || negative == 3 ? Answer::Yes : Answer::Unsure;
}

}  // namespace

/// Whether all that 1/256 pixel around the ray may meet is within reach of it.
bool EyeHits::isNarrow(const EyeRay& ray) const {
    const double leave = m_world.surfaces.clip(ray.eye, ray.direction, 0, kInfinity).second;
    return 2 * leave * m_rays.steps < m_world.surfaces.reach();
}

EyeHits::Quick EyeHits::quick(const EyeRay& ray) {
    if (!isNarrow(ray)) return {.isSure = false};
    m_hits.clear();
    double doubtful = kInfinity;  // nearest distance of a triangle that only some of the rays may meet
    double limit = kInfinity;
    const glm::dvec3 stepX = 1.001 * m_rays.stepX, stepY = 1.001 * m_rays.stepY;
    m_world.surfaces.nearestFirst(ray.eye, ray.direction, 0, kInfinity, [&](std::uint32_t index) {
        const LitTriangle& t = m_world.triangles[index];
        const Answer met = meets(ray, t, stepX, stepY);
        if (met == Answer::No) return limit;
        const auto at = met == Answer::Yes ? planeHit(ray, t, stepX, stepY) : std::nullopt;
        if (!at || (at->low < m_view.nearPlane && at->high >= m_view.nearPlane)) {
            const auto distance = [&](const glm::vec3& p) {
                return glm::dot(glm::dvec3(p) - ray.eye, m_view.forward);
            };
            const auto [nearest, farthest] =
                std::minmax({distance(t.corners[0]), distance(t.corners[1]), distance(t.corners[2])});
            if (farthest * (1 + 1e-9) >= m_view.nearPlane)
                doubtful = std::min(doubtful, std::max(m_view.nearPlane, nearest));
            return limit;
        }
        if (at->high < m_view.nearPlane) return limit;
        m_hits.push_back({index, *at});
        limit = std::min(limit, at->high + m_rays.quantumAt(at->high));
        return limit;
    });
    if (doubtful * (1 - 1e-9) <= limit && doubtful < kInfinity) return {.isSure = false};
    const auto isNear = [&](const Hit& hit) { return hit.t.low <= limit; };
    if (std::count_if(m_hits.begin(), m_hits.end(), isNear) > 1) return {.isSure = false};
    const auto hit = std::find_if(m_hits.begin(), m_hits.end(), isNear);
    return hit == m_hits.end() ? Quick{} : Quick{.hit = *hit};
}

const std::vector<Hit>& EyeHits::find(const EyeRay& ray) {
    m_hits.clear();
    double limit = kInfinity;
    m_world.surfaces.nearestFirst(ray.eye, ray.direction, 0, kInfinity, [&](std::uint32_t index) {
        const LitTriangle& t = m_world.triangles[index];
        Answer met = meets(ray, t, {}, {});
        if (met == Answer::Unsure) {
            int positive = 0;
            for (int k = 0; k < 3; ++k) positive += edgeSide(ray, t.corners[k], t.corners[(k + 1) % 3]) > 0;
            met = positive == 0 || positive == 3 ? Answer::Yes : Answer::No;
        }
        if (met == Answer::No) return limit;
        const glm::dvec3 a = t.corners[0], b = t.corners[1], c = t.corners[2];
        if (orientation(a, b, c, ray.eye) == 0) return limit;
        auto at = planeHit(ray, t);
        if (!at) {
            const auto exact = exactPlaneHit(ray, t);
            if (!exact) return limit;
            const auto value = static_cast<double>(*exact);
            at = {value - 1e-15 * std::abs(value), value + 1e-15 * std::abs(value)};
        }
        if (at->high < m_view.nearPlane) return limit;
        if (at->low < m_view.nearPlane && *exactPlaneHit(ray, t) < Rational(m_view.nearPlane)) return limit;
        m_hits.push_back({index, *at});
        limit = std::min(limit, at->high + m_rays.quantumAt(at->high));
        return limit;
    });
    return m_hits;
}

std::optional<SeenSurface> EyeHits::nearest(const EyeRay& ray) const {
    const auto isBefore = [&](const Hit& a, const Hit& b) {
        if (a.t.high < b.t.low) return true;
        if (b.t.high < a.t.low) return false;
        const Rational ta = *exactPlaneHit(ray, m_world.triangles[a.triangle]);
        const Rational tb = *exactPlaneHit(ray, m_world.triangles[b.triangle]);
        return ta != tb ? ta < tb : a.triangle < b.triangle;
    };
    const Hit* first = nullptr;
    for (const Hit& hit : m_hits) {
        if (!first || isBefore(hit, *first)) first = &hit;
    }
    if (!first) return {};
    return m_rays.surfaceOf(first->triangle, ray);
}

}  // namespace gnomon
