#include "volume/blockers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "volume/clip_space.h"
#include "volume/orient.h"

namespace gnomon {
namespace {

/// Calls @p visit with each cap's triangle and its corners, counter-clockwise seen from the light.
template <class Visit>
void eachCap(const Scene& scene, std::span<const LitCaster> lit, Visit visit) {
    for (const LitCaster& caster : lit) {
        const auto& positions = scene.objects[caster.object].mesh.positions;
        for (const glm::uvec3& t : caster.lit)
            visit(t, std::array<glm::dvec3, 3>{positions[t.x], positions[t.y], positions[t.z]});
    }
}

constexpr double kPixel = 1e-6;  ///< half of the pixel's side, of the view's length

/// How far the view from the eye reaches: to the light, or to the farthest cap before a directional one. The
/// pixel is a share of it, so that scenes of any scale are seen alike.
double lengthOf(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                const glm::dvec3& eye) {
    if (light.w != 0) return glm::length(glm::dvec3(light) - eye);
    double farthest = 0;
    eachCap(scene, lit, [&](const glm::uvec3&, const std::array<glm::dvec3, 3>& corners) {
        for (const glm::dvec3& corner : corners) farthest = std::max(farthest, glm::length(corner - eye));
    });
    return farthest;
}

/// Cuts at coordinate @p axis <= limit, or >= where @p sign is -1. An edge is cut in one order.
std::vector<glm::dvec3> cut(const std::vector<glm::dvec3>& polygon, int axis, double sign, double limit) {
    const auto height = [&](const glm::dvec3& p) { return limit - sign * p[axis]; };
    const auto before = [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::vector<glm::dvec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        glm::dvec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if (height(a) >= 0) kept.push_back(a);
        if ((height(a) >= 0) == (height(b) >= 0)) continue;
        if (before(b, a)) std::swap(a, b);
        const double ha = std::abs(height(a)), hb = std::abs(height(b));
        kept.push_back(a + ha / (ha + hb) * (b - a));
    }
    return kept;
}

}  // namespace

int holdingEye(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
               const glm::dvec3& eye) {
    int count = 0;
    const glm::dvec4 l(light);
    eachCap(scene, lit, [&](const glm::uvec3& t, const std::array<glm::dvec3, 3>& p) {
        if (orientation(p[0], p[1], p[2], eye) >= 0) return;  // on the light's side
        bool inside = true;
        for (int k = 0; k < 3 && inside; ++k) {
            const int side = orientation(p[k], p[(k + 1) % 3], eye, l);
            // A segment through an edge crosses one of its two triangles.
            inside = side > 0 || (side == 0 && t[k] < t[(k + 1) % 3]);
        }
        count += inside;
    });
    return count;
}

bool onVolumeFace(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                  const glm::dvec3& eye) {
    // Seen from the light, the eye lies in a cap's triangle or on its edge, and not before it.
    const glm::dvec4 l(light);
    bool found = false;
    eachCap(scene, lit, [&](const glm::uvec3&, const std::array<glm::dvec3, 3>& p) {
        const int height = orientation(p[0], p[1], p[2], eye);
        if (found || height > 0) return;
        int least = 1;
        for (int k = 0; k < 3; ++k) least = std::min(least, orientation(p[k], p[(k + 1) % 3], eye, l));
        found = least == 0 || (least > 0 && height == 0);
    });
    return found;
}

std::vector<glm::vec4> eyeBlockers(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                                   const glm::dvec3& eye) {
    const double distance = lengthOf(scene, lit, light, eye);
    if (distance == 0) return {};
    const glm::dvec3 along = glm::normalize(light.w == 0 ? glm::dvec3(light) : glm::dvec3(light) - eye);
    const glm::dvec3 side = std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(side, along)), y = glm::cross(along, x);
    const double pixel = kPixel * distance;

    std::vector<glm::vec4> triangles;
    std::vector<glm::dvec3> polygon;
    eachCap(scene, lit, [&](const glm::uvec3&, const std::array<glm::dvec3, 3>& corners) {
        // Seen along the line, lengths in half pixels; z from 0 at the eye to 1 at the view's end.
        polygon.clear();
        for (const glm::dvec3& corner : corners) {
            const glm::dvec3 p = corner - eye;
            polygon.push_back(
                {glm::dot(p, x) / pixel, glm::dot(p, y) / pixel, glm::dot(p, along) / distance});
        }
        for (const int axis : {0, 1})
            for (const double sign : {1.0, -1.0})
                if (std::all_of(polygon.begin(), polygon.end(),
                                [&](const glm::dvec3& p) { return sign * p[axis] > 1; }))
                    return;
        for (const int axis : {0, 1})
            for (const double sign : {1.0, -1.0}) polygon = cut(polygon, axis, sign, 1);
        polygon = cut(polygon, 2, -1, 0);
        if (light.w != 0) polygon = cut(polygon, 2, 1, 1);
        std::vector<glm::vec4> points;
        for (const glm::dvec3& p : polygon) points.push_back({float(p.x), float(p.y), 0, 1});
        appendFan(points, false, triangles);
    });
    return triangles;
}

}  // namespace gnomon
