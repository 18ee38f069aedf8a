#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "profile/profile.h"

namespace gnomon {

// Blend units of chips, bit for bit, as pure functions of integers. Sections and source keys are those of
// hardware.md; nobody has published the rounding of most chips, and the ideal and product units are then what
// bounds it.

/// What a blend unit does with its two inputs: OpenGL's equations, in their order, and what single chips have
/// besides.
enum class BlendOperation : std::uint8_t {
    Add,
    Subtract,
    ReverseSubtract,
    Min,
    Max,
    SignedAdd,              ///< D plus S as two's complement, factors ignored (nv2a.md)
    SignedReverseSubtract,  ///< D minus S as two's complement, factors ignored (nv2a.md)
    AbsoluteDifference,     ///< of source and destination, factors ignored (PPSSPP DrawPixel.cpp)
    AddWrap,                ///< the sum's low bits: PS2 with COLCLAMP 0, N64's forced blend
};

/// Whether @p unit has @p operation, for whichever factors.
bool hasOperation(BlendUnit unit, BlendOperation operation);

/// The operation that a profile calls @p equation.
BlendOperation operationOf(BlendEquation equation);

constexpr bool isGs(BlendUnit unit) {
    return unit == BlendUnit::Gs || unit == BlendUnit::GsWrap;
}

/// Of a constant colour or its alpha, which OpenGL has since 1.2 (its imaging subset).
bool isConstant(BlendFactor factor);

/// Whether @p factor is a colour, or a sum of alphas: the PS2 has neither.
bool isBeyondGs(BlendFactor factor);

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
/// ideal_*      sum of both products, exact, then rounded once: nearest (halves up) or down; clamped, or by
///              add_wrap modulo most + 1. OpenGL. No signed sums, no absolute difference.
/// products_*   each product rounded by itself, then added: the envelope for chips that nobody has measured.
///              OpenGL's five operations.
/// voodoo_mame  (S f + D g) >> 8, f = v + 1, 256 - v, 256 or 0; clamped. Section 2.1 (MAME). Add only.
/// voodoo_86box S f / 255 + D g / 255, each cut; clamped. Section 2.1 (86V). Add only.
/// gs           ((A - B) C >> 7) + D, 128 is 1; clamped, or by add_wrap (COLCLAMP 0) the low 8 bits; gs_wrap
///              always wraps. Section 2.5 (PS2TEK). One coefficient, in the nearest 1/128, for both factors.
///              All pairs that some A, B, D give; add, add_wrap, and the differences where A - B has the
///              sign: "one one" and "src_alpha one" have reverse_subtract, "one src_alpha" has not.
/// powervr      (S u(f) + D u(g)) >> 8, u = v + (v >> 7); at most 255. Section 2.9 (REFSW). Add only.
/// flipper      the same; reverse subtraction is D - S without factors. Section 2.12 (DOLPHIN).
/// ge           ((2c + 1)(2f + 1)) >> 10 for each product; factors up to 510, and 255 - f, which may be
///              negative: the product of its size is then taken away. Section 2.14 (PPSSPP: Rasterizer.cpp,
///              from a probe of the chip). OpenGL's operations and the absolute difference.
/// virge        (S a + D (255 - a)) / 255, cut: alpha with its complement. Section 2.15 (86VIRGE). Add only.
/// nv2a         the sum rounded once to the nearest. nv2a.md (recorded on a console, 0 differences). All but
///              add_wrap and the absolute difference.
/// rdp, nv3, ds, psx: fixed multiplexers, see their own functions below; here only what OpenGL can say:
///              rdp  add: alpha with its complement, both cut to 5 bits. add_wrap: one and one, which is
///                   (31 S + 32 D) >> 5 and its low 8 bits; the chip has no sum that clamps. Section 2.10
///                   (ANGRY).
///              nv3  on the top 5 bits: one and one, or alpha with its complement. Section 2.6 (ENVY).
///              ds   on the top 6 bits: alpha with its complement. Section 2.21 (MELON).
///              psx  on the top 5 bits: one and one, added or subtracted. Section 2.11 (PSXSPX, DUCK).
std::optional<int> blend(BlendUnit unit, const ChannelBlend& channel);

/// The same before the last clamp or wrap, which dithering precedes on the PS2 and the PSP; of the fixed
/// multiplexers, the value itself.
std::optional<int> blendUnclamped(BlendUnit unit, const ChannelBlend& channel);

/// What blend() makes of blendUnclamped(): the low bits, or 0..most.
int finished(BlendUnit unit, BlendOperation operation, int sum, int most = 255);

/// Red, green, blue, alpha.
using Rgba = std::array<int, 4>;

/// OpenGL's blend state.
struct BlendState {
    BlendFactor source = BlendFactor::One, destination = BlendFactor::Zero;
    BlendOperation operation = BlendOperation::Add;
    Rgba constant{};
};

/// The weight of channel @p channel (0..3) that @p factor is. The saturating factor is min(As, 1 - Ad), 1 for
/// alpha; MAME's Voodoo takes min(As, 256 - Ad) there (mamedev/mame : src/devices/video/voodoo_render.cpp,
/// alpha_blend(), ASATURATE; it adds 1 as to any value). The PS2's alphas are 1 at 128.
Weight weightOf(BlendUnit unit, BlendFactor factor, const Rgba& source, const Rgba& destination,
                const Rgba& constant, int channel);

/// All channels of a pixel of 8 bits each; none if the unit lacks the combination, as the PS2 does colours
/// for factors.
std::optional<Rgba> blendPixel(BlendUnit unit, const BlendState& state, const Rgba& source,
                               const Rgba& destination);

/// The same of blendUnclamped().
std::optional<Rgba> blendPixelUnclamped(BlendUnit unit, const BlendState& state, const Rgba& source,
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

/// The same before COLCLAMP.
int sumGs(const GsBlend& setting, int source, int destination);

/// The PS2's texture function MODULATE, with which games counted in alpha by drawing a frame onto itself: 128
/// is 1. Section 2.5 (JAK). Clamps at 255.
int modulateGs(int texel, int fragment);

/// The PS2's settings of a pixel beside the blend. Section 2.5 (PS2TEK).
struct GsPixel {
    bool pabe = false;  ///< blends only where the source's alpha is 0x80 or more
    bool fba = false;   ///< writes alpha with its top bit set
    bool date = false;  ///< tests the top bit of destination alpha: draws only where it is datm
    bool datm = false;
    Rgba mask{};  ///< FBMSK, 8 bits of each channel: a set bit keeps the destination's
    bool operator==(const GsPixel&) const = default;
};

/// PABE: whether a pixel is blended; else the source is written.
constexpr bool gsBlends(bool pabe, int sourceAlpha) {
    return !pabe || sourceAlpha >= 0x80;
}

/// FBA: the alpha that is written, 8 bits.
constexpr int gsAlpha(bool fba, int alpha) {
    return fba ? alpha | 0x80 : alpha;
}

/// FBMSK: (next AND NOT mask) OR (old AND mask), in codes of one width.
constexpr int gsMasked(int next, int old, int mask) {
    return (next & ~mask) | (old & mask);
}

/// DATE: whether a pixel is drawn over a destination alpha of @p bits (8, 1 or 0); without alpha, always.
constexpr bool gsDatePasses(const GsPixel& pixel, int alphaCode, int bits) {
    return !pixel.date || bits == 0 || (alphaCode >> (bits - 1) != 0) == pixel.datm;
}

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

/// PlayStation's four blends, on 5 bits. Section 2.11 (PSXSPX). The average is the floor of half the sum
/// (stenzek/duckstation : src/core/gpu_sw_rasterizer.inl; its older gpu_sw.cpp added two cut halves, which is
/// one less where both are odd); a quarter is cut before it is added.
enum class PsxBlend : std::uint8_t { Average, Add, Subtract, AddQuarter };
int blendPsx(PsxBlend mode, int source, int destination);

}  // namespace gnomon
