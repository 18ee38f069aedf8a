#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "scene/view.h"
#include "truth/frame_rays.h"
#include "truth/predicates.h"
#include "truth/truth.h"
#include "truth/world.h"

namespace gnomon {

/// The neighbourhood of a pixel's centre in which a rasteriser may see what stands there.
struct Beside {
    glm::dvec2 centre{};  ///< window position
    double reach = 0;     ///< pixels; 0: the centre's own ray alone
    double farthest = 0;  ///< window depth of the farthest surface that is seen there
};

/// Finds where the sides of volumes lie so close to a visible point that they may be counted or not.
class CountTies {
  public:
    CountTies(const World& world, const View& view, const DepthTies& ties)
        : m_world(world), m_view(view), m_ties(ties) {}

    /// Whether the sides of volumes near the visible point of @p own may change what the mask holds there.
    Tie at(const LitTriangle& own, const RayPoint& point, const Beside& beside);

  private:
    /// Where an eye ray crosses the side of a volume.
    struct Crossing {
        int face = 0;  ///< the side's weight if it is a front, its negative if it is a back
        double miss = std::numeric_limits<double>::infinity();  ///< pixels by which the ray misses it; 0 or
                                                                ///< less: it crosses
        double t = 0;
        glm::dvec2 gradient{};  ///< of the side's window depth
    };

    glm::dvec2 depthGradient(const glm::dvec3& normal, const glm::dvec3& onPlane) const;
    void findSides(const RayPoint& point, double first, double last);
    Crossing crossSide(const SideEdge& side, const EyeRay& ray) const;
    bool hangsBeside(const SideEdge& side, const Beside& beside) const;
    bool isCrossedMoreThan(int count, const RayPoint& point);

    const World& m_world;
    const View& m_view;
    const DepthTies& m_ties;
    std::vector<std::uint32_t> m_near{}, m_counted{};
};

}  // namespace gnomon
