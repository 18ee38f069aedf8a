#pragma once

#include <array>
#include <compare>
#include <optional>
#include <string>

#include "gl/pixel_words.h"
#include "profile/profile.h"

namespace gnomon {

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

/// The fragment program that does to a frame buffer of words (pixel_words.h) what the chip does: reads the
/// pixel by framebuffer fetch, and writes it back. The functions of profile/ are the definition; the program
/// has the same result for all inputs.
///
/// Uniforms: ivec4 constantSource, blendColour (8 bits per channel; the PS2's alphas with 1 at 128),
/// int alphaReference, sampler2D image.
/// @throws std::runtime_error  the blend unit has no such setting
std::string fragmentProgram(const EmulatedDraw& state);

/// The vertex program that goes with it; empty: OpenGL's own.
std::string vertexProgram(const EmulatedDraw& state);

/// Whether the chip's depth must be written by a program: OpenGL's buffer would store another.
bool storesOtherDepth(const BufferFormat& format, const ChipArithmetic& chip);

}  // namespace gnomon
