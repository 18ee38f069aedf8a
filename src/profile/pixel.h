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

/// Widens by repeating the bits from the highest on: 3dfx, ViRGE, Flipper. Sections 2.1 (86V,
/// MAME), 2.12, 2.15.
constexpr int replicated(int code, int bits) {
    int value = code << (8 - bits);
    for (int filled = bits; filled > 0 && filled < 8; filled *= 2) value |= value >> filled;
    return value;
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

/// ViRGE's dithered store in 5 bits; above 248 nothing is added, so that white stays white. Section 2.15
/// (86VIRGE; sarah-walker-pcem/pcem : src/video/vid_s3_virge.c, RGB15, has the same).
constexpr int virgeDithered(int value, int cell) {
    return value > 248 ? 31 : (value + cell) >> 3;
}

/// Four rows of four signed cells.
using DitherMatrix = std::array<std::array<int, 4>, 4>;

/// The PlayStation's. PSXSPX, "24bit RGB to 15bit RGB Dithering"; DUCK has the same.
constexpr DitherMatrix kPsxMatrix{{{-4, 0, -3, 1}, {2, -2, 3, -1}, {-3, 1, -4, 0}, {3, -1, 2, -2}}};

/// What a PSP program has unless it sets another: the PlayStation's numbers (pspdev/pspsdk :
/// src/gu/sceGuStart.c).
constexpr DitherMatrix kGeMatrix = kPsxMatrix;

/// What a PS2 program usually sets: its register's 3-bit numbers 4 2 5 3 / 0 6 1 7 / 5 3 4 2 / 1 7 0 6, with
/// signs (ps2dev/ps2sdk : ee/draw/src/draw.c, draw_setup_environment(), and the same in games' own set-up).
constexpr DitherMatrix kGsMatrix{{{-4, 2, -3, 3}, {0, -2, 1, -1}, {-3, 3, -4, 2}, {1, -1, 0, -2}}};

/// The store of @p bits with a signed cell, which is added before the clamp: PS2 (DIMX; section 2.5, PS2TEK),
/// PlayStation (PSXSPX), PSP (section 2.14, PPSSPP).
/// @param value  of the PS2 and the PSP before their clamp, see blendUnclamped()
constexpr int signedDithered(int value, int bits, int cell) {
    return std::clamp(value + cell, 0, 255) >> (8 - bits);
}

/// The cell 0..7 of the N64's matrices, "magic" and Bayer. Section 2.10 (ANGRY dither.c).
constexpr int rdpCell(DitherMode mode, int x, int y) {
    constexpr DitherMatrix kMagic{{{0, 6, 1, 7}, {4, 2, 5, 3}, {3, 5, 2, 4}, {7, 1, 6, 0}}};
    constexpr DitherMatrix kBayer{{{0, 4, 1, 5}, {4, 0, 5, 1}, {3, 7, 2, 6}, {7, 3, 6, 2}}};
    return (mode == DitherMode::RdpMagic ? kMagic : kBayer)[y & 3][x & 3];
}

/// The value that the N64 stores for @p value, still of 8 bits: the next multiple of 8 (above 247: 255) if
/// its low three bits are greater than the cell. It does so in 32-bit frames too. Section 2.10 (ANGRY
/// dither.c, rgb_dither; blender.c calls it last).
constexpr int rdpDithered(int value, int cell) {
    if ((value & 7) <= cell) return value;
    return value > 247 ? 255 : (value & ~7) + 8;
}

constexpr bool isVoodooDither(DitherMode mode) {
    return mode == DitherMode::Matrix4x4 || mode == DitherMode::Matrix4x4Subtract ||
           mode == DitherMode::Matrix2x2 || mode == DitherMode::Matrix2x2Subtract;
}

/// The cell of @p mode's matrix at a pixel; 0 if it is off. The PS2's and the PSP's are those of the usual
/// matrices above: a program with its own takes its cells from there.
constexpr int ditherCell(DitherMode mode, int x, int y) {
    switch (mode) {
        case DitherMode::Off:
            return 0;
        case DitherMode::Matrix4x4:
        case DitherMode::Matrix4x4Subtract:
        case DitherMode::Matrix2x2:
        case DitherMode::Matrix2x2Subtract:
            return voodooCell(mode, x, y);
        case DitherMode::Gs:
            return kGsMatrix[y & 3][x & 3];
        case DitherMode::Virge:
            return virgeCell(x, y);
        case DitherMode::Psx:
            return kPsxMatrix[y & 3][x & 3];
        case DitherMode::RdpMagic:
        case DitherMode::RdpBayer:
            return rdpCell(mode, x, y);
        case DitherMode::Ge:
            return kGeMatrix[y & 3][x & 3];
    }
    return 0;
}

/// Whether @p mode changes what a colour channel of @p bits stores: 3dfx's 5 and 6 bits, 5 bits on the PS2
/// (PCSX2 GSDrawScanline: 16-bit frames only), ViRGE and PlayStation, any on the N64 and the PSP.
constexpr bool dithers(DitherMode mode, int bits) {
    switch (mode) {
        case DitherMode::Off:
            return false;
        case DitherMode::RdpMagic:
        case DitherMode::RdpBayer:
        case DitherMode::Ge:
            return true;
        case DitherMode::Gs:
        case DitherMode::Virge:
        case DitherMode::Psx:
            return bits == 5;
        default:
            return bits == 5 || bits == 6;
    }
}

}  // namespace gnomon
