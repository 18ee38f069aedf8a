#pragma once

#include <optional>
#include <vector>

#include "truth/frame_rays.h"

namespace gnomon {

/// What eye rays meet.
class EyeHits {
  public:
    explicit EyeHits(const FrameRays& rays) : m_rays(rays), m_world(rays.world), m_view(rays.view) {}

    /// The one surface that a ray and all within 1/256 pixel of it see, or none.
    struct Quick {
        bool isSure = true;  ///< false: they may see different ones, or another within one quantum of depth
        std::optional<Hit> hit{};
    };
    Quick quick(const EyeRay& ray);

    /// All triangles that the ray meets, up to one quantum behind the first; exact but for the order. Valid
    /// until the next search.
    const std::vector<Hit>& find(const EyeRay& ray);

    /// The first of the hits just found; of equally distant ones that with the lowest index.
    std::optional<SeenSurface> nearest(const EyeRay& ray) const;

  private:
    bool isNarrow(const EyeRay& ray) const;

    const FrameRays& m_rays;
    const World& m_world;
    const View& m_view;
    std::vector<Hit> m_hits{};  ///< of the last search
};

}  // namespace gnomon
