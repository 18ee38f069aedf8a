#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"
#include "truth/truth.h"

namespace gnomon {

/// What became of one pixel.
enum class PixelVerdict : std::uint8_t { Right, Tied, WrongEdge, WrongInterior };

/// A rendered mask held against truth.
struct Judgement {
    std::vector<PixelVerdict> pixels{};  ///< larger is worse
    std::vector<bool> tiedByTruth{};     ///< of the tied ones
    int tiedTruth = 0, tiedCount = 0;
    int edge = 0, interior = 0;
    int wrong() const { return edge + interior; }
};

/// Compares the shadows that a frame shows with truth, pixel by pixel. A mask says whether a volume holds the
/// point just in front of the surface, so it must equal Truth::blocked. Where the seen side faces away from
/// the light, the lit pass adds nothing and the pixel is in shadow whatever the mask says: it is right, and
/// no tie of the count.
///
/// @param maskShadow   per pixel: the mask calls it a shadow
/// @param maskDivisor  a wrong pixel within one mask pixel of the true boundary is an edge pixel
/// @param clamps        the mask's arithmetic can lose counts, so that Tie::CountIfClamped excuses a pixel
Judgement judge(const Truth& truth, const std::vector<bool>& maskShadow, int maskDivisor, bool clamps);

/// The judgements of one frame's lights as one. A pixel is as wrong as the worst of its lights; where none is
/// wrong it is tied if one of them is.
Judgement combined(const std::vector<Judgement>& lights);

/// The shadows that the frame shows: white where the light arrives, black where the mask holds a shadow or
/// the seen side faces away from the light. One channel.
Image shadowPicture(const Truth& truth, const std::vector<bool>& maskShadow);

}  // namespace gnomon
