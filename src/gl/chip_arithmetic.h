#pragma once

#include <compare>
#include <cstdint>

#include "profile/profile.h"

namespace gnomon {

/// Whose arithmetic a frame is drawn with.
enum class Fidelity : std::uint8_t {
    Gl,    ///< the host's blending, in the chip's buffer formats
    Chip,  ///< the chip's own, bit for bit: blend unit, dithering, read-back, depth encoding
};

/// "gl", "chip".
const char* name(Fidelity);

/// What decides between the ways in which a chip may compute, for one surface.
struct ChipArithmetic {
    Fidelity fidelity = Fidelity::Gl;
    BlendUnit unit = BlendUnit::IdealRound;
    DitherMode dither = DitherMode::Off;      ///< while GL_DITHER is enabled
    DitherMode undithered = DitherMode::Off;  ///< while it is not: off, unless the chip can't do without
    DepthEncoding depth = DepthEncoding::Linear;
    auto operator<=>(const ChipArithmetic&) const = default;
};

/// The arithmetic of @p profile: the first of each of its lists. At Fidelity::Gl all is ideal.
ChipArithmetic arithmeticOf(const Profile& profile, Fidelity fidelity);

}  // namespace gnomon
