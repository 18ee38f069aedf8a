#pragma once

#include <compare>
#include <cstdint>
#include <optional>

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
    bool wraps = false;       ///< Fidelity::Gl: knows sums that wrap, which OpenGL has not
    bool everywhere = false;  ///< Fidelity::Chip: draws that OpenGL gets right by itself are emulated too
    auto operator<=>(const ChipArithmetic&) const = default;
};

/// What a user may choose of it; the rest is the profile's.
struct FidelityChoice {
    Fidelity fidelity = Fidelity::Gl;
    bool dithers = false;  ///< as the chip's driver does by default, instead of not at all
    /// Of chips whose profile lists it; others, and all without it, take the first of their list.
    std::optional<BlendUnit> unit{};
};

/// The arithmetic of @p profile. At Fidelity::Gl all is ideal, with sums that wrap if the chip has them.
ChipArithmetic arithmeticOf(const Profile& profile, const FidelityChoice& choice);

}  // namespace gnomon
