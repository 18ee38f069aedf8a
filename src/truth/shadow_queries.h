#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "truth/frame_rays.h"

namespace gnomon {

/// A visible point: of a pixel all of whose eye rays within 1/256 pixel meet the same triangle first, and no
/// other within one quantum of depth.
struct Visible {
    double x = 0, y = 0;  ///< of the window
    Hit hit{};
    SeenSurface surface{};
    RayPoint point;
};

/// Whether casters lie between visible points and the light. A query is one such question: for a point, or
/// for all points around it at once; its answer is exact, or "unsure" of the latter, upon which the points
/// that count are asked for one by one.
class ShadowQueries {
  public:
    explicit ShadowQueries(const FrameRays& rays) : m_rays(rays), m_world(rays.world) {}

    struct Answered {
        bool blocked = false;  ///< the light does not arrive just in front of the surface
        bool tied = false;     ///< the answer changes within 1/256 pixel or one quantum of depth
    };

    /// The shadows of visible points; of many at once, so that memory is asked for ahead.
    /// @param answers  as many as @p points
    void answer(std::span<const Visible> points, std::span<Answered> answers);

    /// Whether a caster other than the triangle @p own lies between the point and the light.
    bool isBlocked(const RayPoint& point, std::uint32_t own);

    /// Whether a caster lies just in front of the surface.
    bool isBlocked(const RayPoint& point, const SeenSurface& surface) {
        // On the other side of it than the light: it itself.
        return (surface.facesAway && m_rays.triangle(surface).casts) || isBlocked(point, surface.triangle);
    }

    /// Whether the answer changes when the point moves by one quantum of depth towards the eye, or away from
    /// it with its own triangle left out.
    bool changesWithDepth(const SeenSurface& surface, const RayPoint& point, bool blocked);

    /// Queries so far.
    std::uint64_t asked() const { return m_asked; }

  private:
    Answered at(const Visible& visible);
    Answer isBlockedAround(const RayPoint& point, std::uint32_t own, double radius);
    bool isBlockedByNear(const RayPoint& point);
    std::array<double, 2> shiftsOf(const RayPoint& point) const;

    const FrameRays& m_rays;
    const World& m_world;
    std::uint64_t m_asked = 0;
    std::vector<std::uint32_t>
        m_near{};  ///< what may block some point around the last one, if that is unsure
};

}  // namespace gnomon
