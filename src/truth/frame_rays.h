#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "scene/view.h"
#include "truth/predicates.h"
#include "truth/truth.h"
#include "truth/world.h"
#include "volume/orient.h"

namespace gnomon {

/// Pixels by which a rasteriser may round a corner: 1/256 along each axis.
constexpr double kSubpixel = 1.0 / 256;

/// Where a rasteriser may see a pixel's centre.
constexpr glm::dvec2 kCorners[4] = {
    {-kSubpixel, -kSubpixel}, {kSubpixel, -kSubpixel}, {-kSubpixel, kSubpixel}, {kSubpixel, kSubpixel}};

/// A triangle that an eye ray meets, and bounds on where.
struct Hit {
    std::uint32_t triangle = 0;
    Interval t{};
};

/// What the eye ray of one pixel meets first.
struct SeenSurface {
    std::uint32_t triangle = 0;
    bool facesAway = false;  ///< its seen side, from the light
};

/// The answer for a pixel; without a surface there is no shadow.
inline Shadow shadowOf(const std::optional<SeenSurface>& surface, bool blocked) {
    if (!surface) return Shadow::Background;
    return surface->facesAway || blocked ? Shadow::InShadow : Shadow::Lit;
}

/// The eye rays of one frame, and how far a rasteriser may be from them.
struct FrameRays {
    FrameRays(const World& w, const View& v, const DepthTies& t)
        : world(w),
          view(v),
          ties(t),
          stepX(v.right * (2 * v.tanHalfX / v.width * kSubpixel)),
          stepY(v.up * (2 * v.tanHalfY / v.height * kSubpixel)),
          steps(glm::length(stepX) + glm::length(stepY)) {}

    const World& world;
    const View& view;
    const DepthTies& ties;
    glm::dvec3 stepX, stepY;  ///< 1/256 pixel, for directions
    double steps;             ///< the sum of their lengths

    EyeRay at(double x, double y) const { return {view.eye, rayDirection(view, x, y)}; }

    /// One quantum of depth at distance @p t.
    double quantumAt(double t) const { return ties.quantumAt(windowDepth(view, t)) * t * t / view.nearPlane; }

    const LitTriangle& triangle(const SeenSurface& surface) const {
        return world.triangles[surface.triangle];
    }

    SeenSurface surfaceOf(std::uint32_t index, const EyeRay& ray) const {
        const LitTriangle& t = world.triangles[index];
        const glm::dvec3 a = t.corners[0], b = t.corners[1], c = t.corners[2];
        return {index, t.edgeOn || orientation(a, b, c, ray.eye) < 0};
    }
};

}  // namespace gnomon
