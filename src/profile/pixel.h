#pragma once

#include <algorithm>
#include <array>

#include "profile/profile.h"

namespace gnomon {

// How a channel of 8 bits goes into a frame buffer with fewer, and comes back. A "value" has 8 bits, a "code"
// is what the frame buffer holds. Sections are those of hardware.md.

/// The largest code of @p bits.
constexpr int largestCode(int bits) {
    return (1 << bits) - 1;
}

/// Drops low bits: what 3dfx, ViRGE, PS2, N64, Flipper, PSP and NV2A do without dithering. Sections 2.1
/// (MAME, 86V), 2.5 (PGS), 2.10 (ANGRY), 2.12 (DOLPHIN), 2.15 (86VIRGE); nv2a.md, surface formats.
constexpr int truncated(int value, int bits) {
    return value >> (8 - bits);
}

/// The nearest code, as OpenGL wants it; no value lies between two codes.
constexpr int rounded(int value, int bits) {
    return (2 * value * largestCode(bits) + 255) / 510;
}

/// Widens by repeating the high bits: 3dfx, ViRGE, Flipper. Sections 2.1 (86V, MAME), 2.12, 2.15.
/// @pre bits is 1 or 4 to 8
constexpr int replicated(int code, int bits) {
    return bits == 1 ? 255 * code : (code << (8 - bits)) | (code >> (2 * bits - 8));
}

/// Widens by low bits of zero: PS2, N64, NV2A's blend unit. Sections 2.5 (PGS, PCSX2), 2.10 (ANGRY); nv2a.md.
constexpr int shifted(int code, int bits) {
    return code << (8 - bits);
}

/// The cell 0..15 of 3dfx's matrices at a pixel; 0 if @p mode is off. Section 2.1 (MAME).
constexpr int voodooCell(DitherMode mode, int x, int y) {
    constexpr std::array<std::array<int, 4>, 4> k4x4{
        {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}}};
    constexpr std::array<std::array<int, 2>, 2> k2x2{{{8, 10}, {11, 9}}};
    if (mode == DitherMode::Off) return 0;
    const bool small = mode == DitherMode::Matrix2x2 || mode == DitherMode::Matrix2x2Subtract;
    return small ? k2x2[y & 1][x & 1] : k4x4[y & 3][x & 3];
}

/// 3dfx's dithered store in 5 bits (red, blue) or 6 (green) at @p cell. Section 2.1 (MAME: verified on
/// hardware).
/// @pre bits is 5 or 6
constexpr int voodooDithered(int value, int bits, int cell) {
    return bits == 5 ? (2 * value - (value >> 4) + (value >> 7) + cell) >> 4
                     : (4 * value - (value >> 4) + (value >> 6) + cell) >> 4;
}

/// What "dither subtraction" adds to a destination of @p bits at @p cell. Section 2.1 (MAME); where the
/// halving for green sits differs between its versions, the sum doesn't.
constexpr int ditherSubtraction(int bits, int cell) {
    return ((15 - cell) >> 1) >> (bits == 6 ? 1 : 0);
}

/// The cell 0..7 of ViRGE's matrix. Section 2.15 (86VIRGE).
constexpr int virgeCell(int x, int y) {
    constexpr std::array<std::array<int, 4>, 4> kCells{
        {{0, 4, 1, 5}, {6, 2, 7, 3}, {1, 5, 0, 4}, {7, 3, 6, 2}}};
    return kCells[y & 3][x & 3];
}

/// ViRGE's dithered store in 5 bits; above 248 nothing is added. Section 2.15 (86VIRGE).
constexpr int virgeDithered(int value, int cell) {
    return value > 248 ? 31 : (value + cell) >> 3;
}

/// The PS2's dithered store in 5 bits: a signed cell of its register, -4..3, is added before the clamp.
/// Section 2.5 (PS2TEK).
constexpr int gsDithered(int value, int cell) {
    return std::clamp(value + cell, 0, 255) >> 3;
}

}  // namespace gnomon
