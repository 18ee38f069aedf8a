#pragma once

#include <compare>
#include <optional>

#include "profile/blend.h"
#include "profile/pixel.h"
#include "profile/profile.h"

namespace gnomon {

/// One channel of a frame buffer behind a chip's blend unit, at one pixel. A "value" has 8 bits, a "code" is
/// what the frame buffer holds.
struct FrameChannel {
    BlendUnit unit = BlendUnit::IdealRound;
    int bits = 8;
    DitherMode dither = DitherMode::Off;  ///< of no effect where dithers() is false
    int cell = 0;                         ///< of the dither matrix at the pixel: ditherCell()
    auto operator<=>(const FrameChannel&) const = default;
};

/// The value that blending reads for @p code: replicated, or with low bits of zero (PS2, N64, NV2A). With
/// dither subtraction it may pass 255, as in MAME.
int readBack(const FrameChannel& channel, int code);

/// The value of the source that enters the blend: NV2A cuts it to the surface's bits (nv2a.md), the
/// PlayStation dithers and cuts it here and not at the store (PSXSPX: polygons with shading or blended
/// textures, and lines; flat polygons and rectangles are never dithered, and want Off). Others take it as it
/// is.
int enteringSource(const FrameChannel& channel, int value);

/// The code that is stored for @p value: one path for every chip and mode. Without dithering the low bits
/// drop.
/// @param value  of blend(), or of blendUnclamped(): PS2 and PSP add their cells before they clamp or wrap
///               (PCSX2 GSDrawScanline.cpp; PPSSPP DrawPixel.cpp, whose SSE path though ends differences at 0
///               first)
/// @param wraps  whether the sum keeps its low bits instead of clamping (BlendOperation::AddWrap)
int stored(const FrameChannel& channel, int value, bool wraps = false);

/// Where a pixel lies in the dither matrix, and how its chip stores it.
struct FrameState {
    BlendUnit unit = BlendUnit::IdealRound;
    ColourFormat format{};
    DitherMode dither = DitherMode::Off;
    int x = 0, y = 0;
    GsPixel gs{};  ///< the PS2 only
};

/// A whole pixel: codes in, codes out. Alpha that the format lacks reads as 1 and stays 0; alpha never
/// dithers. The PS2 reads alpha with low bits of zero (128 is 1), writes the source's, and keeps the bits
/// that its mask names; the PSP's alpha, its stencil, stays. None if the unit lacks the combination.
/// Sections 2.1, 2.5, 2.14; nv2a.md, surface formats.
std::optional<Rgba> blendInto(const FrameState& frame, const BlendState& state, const Rgba& source,
                              const Rgba& codes);

/// What the arithmetic of masks needs of one channel. Section 1, with its OpenGL settings.
enum class MaskOperation : std::uint8_t {
    Double,         ///< dst_color, one; source 1
    Halve,          ///< dst_color, zero; source 1/2
    Invert,         ///< one_minus_dst_color, zero; source 1
    Increment,      ///< one, one; source one code (the N64's two codes)
    Decrement,      ///< the same by reverse_subtract; gs_wrap and rdp wrap
    IncrementWrap,  ///< one, one, add_wrap: the PS2 with COLCLAMP 0, the N64, the ideal units
    DecrementWrap,  ///< the same, with a source that wraps to one code less
    InvertBits,     ///< the logic operation Invert
};

/// What @p code becomes, in the chip's own way (section 2(a)); none if its blend unit has none. That the rest
/// of the chip lets the unit do it (equations, destination alpha) is the profile's matter.
///
/// nv3 and psx (5 bits) and ds (6 bits) have no other width. They and the ideal units work on codes, the
/// ideal ones with exactly 1/2. The PS2 halves with FIX = 0x40; ViRGE with black of alpha 255 - half; the
/// PlayStation doubles by adding the frame, as a texture, to itself; the N64 doubles in one cycle, which
/// lacks 1/32.
///
/// @param half  the 8-bit constant that stands for 1/2, where the unit takes one: 127 or 128
std::optional<int> apply(const FrameChannel& channel, MaskOperation operation, int code, int half = 128);

/// Whether @p unit multiplies by a constant of 8 bits for 1/2, so that 127 or 128 matters.
bool takesHalfConstant(BlendUnit unit);

}  // namespace gnomon
