#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/scene.h"
#include "scene/view.h"
#include "volume/volume.h"

namespace gnomon {

/// What can be said of one pixel. Background: no surface there, so no shadow; stays lit.
enum class Shadow : std::uint8_t { Background, Lit, InShadow };

/// Why a pixel is excused from comparison; the stronger reason is the larger.
enum class Tie : std::uint8_t {
    None,
    CountIfClamped,  ///< a side of a volume lies so close to the visible surface that it may be counted or
                     ///< not; a count keeps its class either way, but a mask that has lost counts by clamping
                     ///< may not
    Count,           ///< the same, and the class of the count would change; or a side that faces away, for
                     ///< which the count means nothing, is seen within 1/256 pixel
    Truth,           ///< the answer changes within 1/256 pixel, or within one quantum of depth
};

/// The exact shadows of one frame. Rows from the top of the image, as in Image.
struct Truth {
    int width = 0, height = 0;
    std::vector<Shadow> shadow{};
    std::vector<Tie> tie{};
    /// True where the seen side of the surface faces away from the light, so that the lit pass adds nothing
    /// there whatever the mask says.
    std::vector<bool> facesAway{};
    /// True where a caster blocks the light just in front of the visible surface: what a perfect mask holds.
    /// InShadow is facesAway or blocked.
    std::vector<bool> blocked{};
};

/// The quanta within which depth comparisons of one depth format are a tie.
struct DepthTies {
    double truthQuantum = 0;  ///< one quantum of the chip's depth format, in window depth: 2^-bits
    /// How far a volume's face may be from the surface and still fall on either side of it, in window depth:
    /// 8 quanta of 24 bit cover llvmpipe's interpolation; one quantum, and that, for 16 bit.
    double countBand = 0;
    /// Of a floating-point format: its quantum, and what it adds to the band, as a share of 1 - depth.
    double share = 0;

    double quantumAt(double depth) const { return std::max(truthQuantum, share * (1 - depth)); }
    double bandAt(double depth) const { return countBand + share * (1 - depth); }
};

/// The ties of an unsigned-integer depth buffer of @p bits.
DepthTies depthTies(int bits);

/// Ray tracer for the exact hard shadows of one light; knows nothing of plans. Built once per scene and
/// light.
///
/// A visible point is in shadow if the seen side of its surface faces away from the light, or if the open
/// segment from it to the light crosses a caster triangle that faces the light (any triangle of a two-sided
/// caster) other than its own. Candidates come from Embree; every sign is exact (filtered double, then
/// rational).
class Tracer {
  public:
    /// @param scene       must outlive the tracer
    /// @param silhouette  of the volumes whose sides make count ties; truth itself does not depend on it
    Tracer(const Scene& scene, const Light& light, Silhouette silhouette = Silhouette::Winding);
    ~Tracer();
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    /// The frame that @p view sees, at one ray per pixel, with its ties.
    Truth trace(const View& view, const DepthTies& ties) const;

  private:
    struct Impl;
    class Frame;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace gnomon
