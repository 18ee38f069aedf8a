#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "profile/profile.h"

namespace gnomon {

// Blend units of chips, bit for bit, as pure functions of integers. Sections and source keys are those of
// hardware.md; nobody has published the rounding of most chips, and the ideal and product units are then what
// bounds it.

/// What a blend unit does with its two inputs: OpenGL's equations, in their order, and the signed sums of
/// NV2A. PSP's absolute difference stands with them.
enum class BlendOperation : std::uint8_t {
    Add,
    Subtract,
    ReverseSubtract,
    Min,
    Max,
    SignedAdd,              ///< D plus S as two's complement, factors ignored (nv2a.md)
    SignedReverseSubtract,  ///< D minus S as two's complement, factors ignored (nv2a.md)
    AbsoluteDifference,     ///< of the two products (section 2.14, PPSSPP)
};

/// What one input is multiplied by: zero, one, value / unit, or 1 - value / unit. The kind matters: chips
/// treat a factor of one otherwise than a value that happens to be largest.
struct Weight {
    enum class Kind : std::uint8_t { Zero, One, Value, Complement };
    Kind kind = Kind::One;
    int value = 0;
    int unit = 255;  ///< the value that stands for 1; other than 255 for the ideal units, and 128 for the GS

    static constexpr Weight zero() { return {Kind::Zero}; }
    static constexpr Weight one() { return {Kind::One}; }
    static constexpr Weight of(int value, int unit = 255) { return {Kind::Value, value, unit}; }
    static constexpr Weight complement(int value, int unit = 255) { return {Kind::Complement, value, unit}; }
    bool operator==(const Weight&) const = default;
};

/// One channel of one blend.
struct ChannelBlend {
    int source = 0, destination = 0;  ///< 0..most
    Weight sourceWeight{}, destinationWeight{};
    BlendOperation operation = BlendOperation::Add;
    int most = 255;  ///< the value that stands for 1; other than 255 for the ideal units only
};

/// The value, 0..most, that @p unit computes; none if it has no such combination of factors or no such
/// operation. Whether a chip offers a combination is the profile's matter: this is arithmetic.
///
/// ideal_*      sum of both products, exact, then rounded once: nearest (halves up) or down; clamped. OpenGL.
/// products_*   each product rounded by itself, then added: the envelope for chips that nobody has measured.
/// voodoo_mame  (S f + D g) >> 8, f = v + 1, 256 - v, 256 or 0; clamped. Section 2.1 (MAME).
/// voodoo_86box S f / 255 + D g / 255, each cut; clamped. Section 2.1 (86V).
/// gs           ((A - B) C >> 7) + D, 128 is 1; clamped, or gs_wrap: the low 8 bits. Section 2.5 (PS2TEK).
/// One
///              coefficient for both factors, weights in the nearest 1/128: see blendGs() for all that it
///              does.
/// powervr      (S u(f) + D u(g)) >> 8, u = v + (v >> 7); at most 255. Section 2.9 (REFSW).
/// flipper      the same; reverse subtraction is D - S without factors. Section 2.12 (DOLPHIN).
/// ge           ((2c + 1)(2f + 1)) >> 10 for each product; factors up to 510. Section 2.14 (PPSSPP).
/// virge        (S a + D (255 - a)) / 255, cut. Section 2.15 (86VIRGE).
/// nv2a         the sum rounded once to the nearest. nv2a.md (recorded on a console, 0 differences).
/// rdp, nv3, ds, psx: fixed multiplexers, see their own functions below; here only what OpenGL can say of
/// them:
///              rdp  alpha with its complement, both cut to 5 bits; the sum wraps. Section 2.10 (ANGRY).
///              nv3  on the top 5 bits: one and one, or alpha with its complement. Section 2.6 (ENVY).
///              ds   on the top 6 bits: alpha with its complement. Section 2.21 (MELON).
///              psx  on the top 5 bits: one and one, added or subtracted. Section 2.11 (PSXSPX, DUCK).
std::optional<int> blend(BlendUnit unit, const ChannelBlend& channel);

/// Red, green, blue, alpha.
using Rgba = std::array<int, 4>;

/// OpenGL's blend state.
struct BlendState {
    BlendFactor source = BlendFactor::One, destination = BlendFactor::Zero;
    BlendOperation operation = BlendOperation::Add;
    Rgba constant{};
};

/// The weight of channel @p channel (0..3) that @p factor is. The saturating factor is min(As, 1 - Ad), 1 for
/// alpha; MAME's Voodoo takes 256 - Ad there. The PS2's alphas are 1 at 128.
Weight weightOf(BlendUnit unit, BlendFactor factor, const Rgba& source, const Rgba& destination,
                const Rgba& constant, int channel);

/// All channels of a pixel of 8 bits each; none if the unit lacks the combination, as the PS2 does colours
/// for factors.
std::optional<Rgba> blendPixel(BlendUnit unit, const BlendState& state, const Rgba& source,
                               const Rgba& destination);

/// An input of the PS2's blend unit.
enum class GsInput : std::uint8_t { Source, Destination, Zero };

/// A setting of the PS2's blend unit: ((a - b) * coefficient >> 7) + d.
struct GsBlend {
    GsInput a = GsInput::Source, b = GsInput::Zero;
    int coefficient = 128;  ///< As, Ad or FIX, 0..255; 128 is 1
    GsInput d = GsInput::Zero;
};

/// Section 2.5 (PS2TEK). The shift rounds down; @p clamps is COLCLAMP: 0..255, or the low 8 bits. Alpha never
/// goes this way: what is written is the source's.
int blendGs(const GsBlend& setting, int source, int destination, bool clamps);

/// The PS2's texture function MODULATE, with which games counted in alpha by drawing a frame onto itself: 128
/// is
/// 1. Section 2.5 (JAK). Clamps at 255.
int modulateGs(int texel, int fragment);

/// N64, forced blend: (p * a + m * (b + 1)) >> 5 and the low 8 bits; a and b have 5 bits. Section 2.10
/// (ANGRY).
int blendRdp(int p, int a, int m, int b);

/// RIVA 128, mode BLEND, on 5 bits: beta is an alpha or the destination; a factor of zero takes the input
/// away. Section 2.6 (ENVY: tested on hardware for points).
int blendNv3(int source, int destination, int beta, bool sourceZero = false, bool destinationZero = false);

/// RIVA 128, mode ADD, on 5 bits; clamped. Section 2.6.
int addNv3(int source, int destination);

/// Nintendo DS, on 6 bits with 5 bits of alpha; @p drawn says whether something with alpha lies below (else
/// the source is written as it is). Section 2.21 (MELON).
int blendDs(int source, int destination, int alpha, bool drawn = true);

/// PlayStation's four blends. Section 2.11 (PSXSPX; DUCK: on 5 bits, halves and quarters cut).
enum class PsxBlend : std::uint8_t { Average, Add, Subtract, AddQuarter };
int blendPsx(PsxBlend mode, int source, int destination);

}  // namespace gnomon
