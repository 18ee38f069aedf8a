#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "predict/mask_prediction.h"
#include "predict/window_prediction.h"
#include "truth/truth.h"

namespace gnomon {

/// Why a pixel that is not tied shows another shadow than truth: a closed list.
enum class Cause : std::uint8_t {
    None,           ///< it is right, or tied
    NoShadowDrawn,  ///< the method draws none

    // What the mask's arithmetic can't hold
    MaskClamps,
    MaskUnderflows,
    MaskWraps,
    StencilSaturates,
    StencilWraps,
    ParityOverlaps,   ///< overlapping volumes cancel
    RoundingResidue,  ///< of the chip's blend unit; OpenGL's arithmetic is right
    DitherDrift,      ///< the same chip without dithering is right

    // Where the count starts
    EyeInside,      ///< a volume holds the eye and is not counted
    EyeOnFace,      ///< the eye lies in a face of a volume, and the count starts at the eye
    NearPlaneCuts,  ///< a volume holds the near plane's point of the pixel, but not the eye; of a depth map:
                    ///< the caster lies between the light and the map's near plane
    FarPlane,       ///< what would count lies beyond the far plane

    // Which volumes are drawn
    OpenCaster,        ///< the silhouette leaves out sides where a caster is open or inconsistently wound
    InsideOfCaster,    ///< the volume begins at the faces turned away
    VolumeOffset,      ///< the volume begins behind its caster
    BackgroundInside,  ///< the point at infinity lies inside a volume

    // Sampling
    DepthPrecision,  ///< a depth, or a corner, within what the chip and the rasteriser round
    OwnCapAndSide,   ///< the same of the seen triangle's own cap and sides
    MaskResolution,
    MapResolution,  ///< another caster's depth, somewhere else in the texel
    MapBias,  ///< too large: a caster before the point is passed over; too small: a surface shadows itself

    Unexplained,  ///< none of these: a defect
};
constexpr int kCauses = int(Cause::Unexplained) + 1;

/// "mask clamps"; empty for None.
const std::string& name(Cause);

/// The cause of that name; None if there is none.
Cause causeNamed(const std::string& name);

/// What the mask of one light is explained from.
struct CauseInputs {
    const Truth& truth;
    const MaskInputs& mask;  ///< as it was predicted
    MaskPrediction& prediction;
    bool parity = false;     ///< faces invert
    bool halves = false;     ///< counts go down from 1
    bool insideOut = false;  ///< volumes begin at the faces turned away
    bool offset = false;     ///< volumes begin behind their casters
    /// Crossings of the whole window, for a mask of fewer pixels.
    std::function<const Crossings&()> fullSize{};
    /// The same of volumes whose sides are right for any mesh; none where these were drawn.
    std::function<const Crossings&()> winding{};
};

/// Explains wrong pixels of one light's mask: for each the same passes are done over, with one limit after
/// the other lifted, until they come to the truth.
class Explainer {
  public:
    explicit Explainer(const CauseInputs& in);
    ~Explainer();

    /// @param pixel   of the window, rows from the top
    /// @pre the mask is not as truth has it there, but as the prediction allows
    Cause causeOf(std::size_t pixel);

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace gnomon
