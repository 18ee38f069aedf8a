#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gl/buffer_format.h"
#include "gl/chip_arithmetic.h"

namespace gnomon {

// How the emulation keeps a pixel: the codes of its channels side by side in one unsigned integer of 16 or 32
// bits, red lowest. Of 8888 this is what OpenGL's RGBA8 holds, byte by byte.

/// Whether the words are what OpenGL's RGBA8 holds.
constexpr bool isBytes(const BufferFormat& format) {
    return format.red == 8 && format.green == 8 && format.blue == 8 &&
           (format.alpha == 8 || format.alpha == 0);
}

/// Bits of a word of @p format: 16 or 32.
constexpr int wordBits(const BufferFormat& format) {
    return format.red + format.green + format.blue + format.alpha <= 16 ? 16 : 32;
}

/// Bits of channel @p c, 0 (red) to 3 (alpha).
constexpr int channelBits(const BufferFormat& format, int c) {
    return c == 0 ? format.red : c == 1 ? format.green : c == 2 ? format.blue : format.alpha;
}

/// The lowest bit of channel @p c in the word.
constexpr int channelShift(const BufferFormat& format, int c) {
    int shift = 0;
    for (int k = 0; k < c; ++k) shift += channelBits(format, k);
    return shift;
}

/// The bits of the channels in @p channels (bit c: channel c).
constexpr std::uint32_t wordMask(const BufferFormat& format, unsigned channels) {
    std::uint32_t mask = 0;
    for (int c = 0; c < 4; ++c)
        if (channels >> c & 1)
            mask |= ((std::uint32_t{1} << channelBits(format, c)) - 1) << channelShift(format, c);
    return mask;
}

/// Four bytes of each word, red first: replicated, which makes full intensity 255. A channel that the format
/// lacks is 255. The PS2's alpha, 1 at 128, comes out as OpenGL's.
std::vector<std::uint8_t> bytesOf(std::span<const std::uint32_t> words, const BufferFormat& format,
                                  const ChipArithmetic& chip);

/// The same as the chip's texture unit reads it: with low bits of zero where its blend unit does so (PS2,
/// N64), else replicated (nv2a.md: by the texture unit, unlike the blend unit).
std::vector<std::uint8_t> texelsOf(std::span<const std::uint32_t> words, const BufferFormat& format,
                                   const ChipArithmetic& chip);

}  // namespace gnomon
