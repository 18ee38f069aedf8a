#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "plan/plan.h"
#include "predict/causes.h"
#include "predict/map_depths.h"
#include "predict/mask_channel.h"
#include "predict/seen_window.h"

namespace gnomon {

/// What the mask of one light is predicted from where a depth map makes it.
struct MapMaskInputs {
    const Plan& plan;
    const SeenWindow& window;
    MapDepths& depths;  ///< of the light, as large as the plan's map
    MaskChannel arithmetic{};
};

/// The mask that Shading::Mask makes of a light's depth map: for each pixel the point that is seen there, its
/// texel, the depth of the nearest caster at the texel's centre, and the comparison with the bias.
///
/// A pixel has one exact answer. It may have the other too where the rasteriser's rounding decides: another
/// surface seen, corners moved by 1/256 pixel in the map, a point so near to a border of texels or of the
/// cube's faces that floats don't tell, depths of 24 bits.
///
/// Source: Williams 1978, Casting curved shadows on curved surfaces.
class MapPrediction {
  public:
    /// @param in  what it refers to must outlive this
    explicit MapPrediction(const MapMaskInputs& in);

    /// In exact arithmetic. By pixel of the window, rows from the top.
    bool shadow(std::size_t pixel) const { return (m_answers[pixel] & kShadowExactly) != 0; }
    /// Whether the pixel may be lit and may be in shadow, by rounding.
    bool isOpen(std::size_t pixel) const { return (m_answers[pixel] & kBoth) == kBoth; }
    /// Whether the mask may be shown as @p value, 8 bits.
    bool allows(std::size_t pixel, int value) const;

    /// Why the mask is not as truth has it, @p blocked.
    /// @pre it is not
    Cause causeOf(std::size_t pixel, bool blocked) const;

  private:
    enum : std::uint8_t { kLit = 1, kShadow = 2, kBoth = 3, kShadowExactly = 4 };

    /// Where a seen point lies in the map.
    struct Place {
        glm::dvec3 at{}, error{};  ///< LightMap::coordinates(), and what floats may be off by
    };
    /// The same in one face.
    struct InFace {
        int face = 0;
        glm::dvec2 texel{}, texelError{};
        double depth = 0, depthError = 0;  ///< point light: along the face's axis, world units
    };

    std::uint8_t answersAt(std::size_t pixel) const;
    std::uint8_t answersOf(std::size_t pixel, const Seen& seen) const;
    Place placeOf(std::size_t pixel, const Seen& seen) const;
    InFace inFace(const Place& place, int face) const;
    int faceOf(const glm::dvec3& at) const;
    /// By how much the point lies behind what is stored, the bias taken off; and what that may be off by.
    double behind(const InFace& point, const StoredDepth& stored, double bias) const;
    double behindError(const InFace& point, const StoredDepth& stored) const;
    int shown(std::size_t pixel, bool shadow) const;

    const MapMaskInputs in;
    std::vector<std::uint8_t> m_answers{};
};

}  // namespace gnomon
