#pragma once

#include <memory>
#include <span>
#include <vector>

#include "needs/minimal_plan.h"
#include "profile/profile.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "volume/volume.h"

namespace gnomon {

/// Whose masks the needs of a light are asked for.
struct NeedsOf {
    int light = 0;
    const Axes& axes;
    int depthBits = 24;
    DepthEncoding depth = DepthEncoding::Linear;
    std::span<const LitCaster> lit{};        ///< of these axes' silhouette and caps
    std::span<const std::uint32_t> drawn{};  ///< FrameVolumes::ordinals of the full plan
    const Nesting& full;                     ///< LightNeeds::full
};

/// Finds out what frames of a scene call for. Keeps what methods share.
class NeedsFinder {
  public:
    /// @param scene  must outlive it
    explicit NeedsFinder(const Scene& scene);
    ~NeedsFinder();

    /// The frame that is asked about from now on.
    void select(const View& view);

    /// All but LightNeeds::brightest.
    LightNeeds volumes(const NeedsOf& of);

    /// FrameNeeds::nearestSurface
    double nearestSurface();

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace gnomon
