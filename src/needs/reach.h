#pragma once

#include <span>
#include <vector>

#include "needs/receivers.h"
#include "volume/volume.h"

namespace gnomon {

/// How far the volumes of one light reach in one frame. Conservative: a volume matters only where it says so.
struct Reach {
    /// By volume, in the order in which FrameVolumes::ordinals counts them (casters without lit triangles
    /// have none): a rectangle of pixels outside of which the volume holds no point that is seen, nor comes
    /// so near to one that a rasteriser could tell otherwise; the smallest around patches of the receivers.
    /// Empty: it can't matter. Outside of it all faces that one ray crosses cancel, if the volume is closed.
    std::vector<WindowRect> windows{};
    /// By volume: a lower bound of its distance from the near rectangle (the section of the view's pyramid
    /// with the near plane), world units; 0 where it may touch it (touchesNearRectangle()).
    std::vector<double> nearDistances{};
};

/// @param lit        litCasters() of the scene; as of frameVolumes(), with any caps
/// @param light      its position, homogeneous
/// @param receivers  of @p view, with the ties of the depth buffer that is drawn to
/// @pre volumes start at their casters: a cap that is moved off its surface (CutStyle::offset) may lie before
///      what is seen
Reach reachOf(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light, const View& view,
              const Receivers& receivers);

/// A lower bound of the distance of all surfaces from the near plane, world units; 0 where one may touch it
/// within the window. Infinite if the view holds none.
double surfaceDistance(const Scene& scene, const View& view);

}  // namespace gnomon
