#include "matrix/cause_reason.h"

#include <array>

namespace gnomon {

const std::string& reasonOf(Cause cause) {
    static const std::array<std::string, kCauses> kReasons{
        "",
        "the method draws no shadow",
        "more volumes nest than the mask's largest value tells apart",
        "the mask loses what it halves below its least value",
        "the count goes beyond the mask's range and round",
        "the stencil stops at its largest value",
        "the stencil wraps to zero, which is lit",
        "two volumes that overlap cancel",
        "the chip's blend unit rounds",
        "the chip dithers the mask",
        "the eye is in a volume that is not counted",
        "the eye is on a face of a volume, where the count starts",
        "the near plane cuts a volume away",
        "what would count lies beyond the far plane",
        "a caster is open or wound inconsistently, and its silhouette lacks sides",
        "the volume begins at the faces turned away",
        "the volume begins behind its caster",
        "the background's point at infinity lies in a volume",
        "depths differ by less than the chip and the rasteriser round",
        "a triangle's own cap and side lie within a few depth quanta",
        "the mask has fewer pixels than the window",
        "a texel of the depth map holds another caster's depth",
        "the depth map's bias is too large, or too small",
        "",
    };
    return kReasons[std::size_t(cause)];
}

}  // namespace gnomon
