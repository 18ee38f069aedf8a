#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>

#include "gl/buffer_format.h"
#include "gl/chip_arithmetic.h"

namespace gnomon {

constexpr int kAlpha = 3;  ///< the channel

/// Where a draw's fragments take their colour from.
enum class FragmentSource : std::uint8_t {
    Constant,       ///< one colour for the whole draw
    Interpolated,   ///< the vertices' colours
    TextureColour,  ///< texture environment REPLACE: red, green and blue of an RGB texture, alpha constant
    TextureAlpha,   ///< the same: alpha of an alpha texture, red, green and blue constant
    TextureAll,     ///< the same: all four channels
};

/// The state on which a chip's program for one draw depends. Colour [0] and alpha [1] have their own factors.
struct EmulatedDraw {
    BufferFormat format{};
    ChipArithmetic chip{};
    DitherMode dither = DitherMode::Off;
    unsigned channels = 15;  ///< that are written: bit c for channel c; 0: depth only
    bool blends = false;
    std::array<BlendFactor, 2> source{BlendFactor::One, BlendFactor::One};
    std::array<BlendFactor, 2> destination{BlendFactor::Zero, BlendFactor::Zero};
    std::array<BlendEquation, 2> equation{};
    bool inverts = false;  ///< logic operation INVERT, which takes the place of blending
    FragmentSource from = FragmentSource::Constant;
    /// FragmentSource::Constant: the colour, 8 bits per channel, if the program may be made for it alone.
    std::optional<std::array<int, 4>> constant{};
    Compare alphaTest = Compare::Always;
    bool writesDepth = false;  ///< the depth that the chip would store, by gl_FragDepth
    int rows = 0;              ///< of the window: dither matrices begin at its top
    auto operator<=>(const EmulatedDraw&) const = default;
};

}  // namespace gnomon
