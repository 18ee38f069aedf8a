#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace gnomon {

// Depth as chips store it, exactly. Sections are those of hardware.md.

/// The nearest of 2^bits - 1 equal steps, as OpenGL has it.
/// @param depth  0..2^32, in units of 2^-32
/// @pre bits is at most 31
constexpr std::uint32_t linearDepth(std::uint64_t depth, int bits) {
    const std::uint64_t most = (std::uint64_t{1} << bits) - 1;
    return static_cast<std::uint32_t>((depth * most + (std::uint64_t{1} << 31)) >> 32);
}

/// The least depth, in units of 2^-32, that linearDepth() stores as @p code.
constexpr std::uint64_t leastLinearDepth(std::uint32_t code, int bits) {
    const std::uint64_t most = (std::uint64_t{1} << bits) - 1, half = std::uint64_t{1} << 31;
    const std::uint64_t bound = std::uint64_t{code} << 32;
    return bound <= half ? 0 : (bound - half + most - 1) / most;
}

/// 3dfx's linear z: 16 bits of an iterated 20.12 fixed-point number, clamped. Section 2.1 (MAME).
constexpr std::uint32_t voodooZ(std::int32_t z) {
    return static_cast<std::uint32_t>(std::clamp(z >> 12, 0, 0xffff));
}

/// 3dfx's floating w: 4 bits of exponent, 12 of mantissa; greater is farther. Section 2.1 (MAME
/// compute_wfloat). The largest sum, 0x10000, is held at 0xffff as in MAME's older versions.
/// @param inverseW  1/w in units of 2^-48; from 1 on it is stored as 0, below 2^-16 as 0xffff
constexpr std::uint32_t voodooW(std::uint64_t inverseW) {
    const int exponent = std::countl_zero(inverseW) - 16;
    if (exponent < 0) return 0;
    if (exponent >= 16) return 0xffff;
    const auto mantissa = static_cast<std::uint32_t>(inverseW >> (35 - exponent)) & 0xfff;
    return std::min((static_cast<std::uint32_t>(exponent) << 12 | (0xfff - mantissa)) + 1, 0xffffu);
}

/// The least 1/w, in units of 2^-48, that voodooW() stores as @p code, 1..0xfffe.
constexpr std::uint64_t leastVoodooInverseW(std::uint32_t code) {
    const std::uint32_t exponent = (code - 1) >> 12, mantissa = 0xfff - ((code - 1) & 0xfff);
    return std::uint64_t{0x1000 | mantissa} << (35 - exponent);
}

/// The N64's depth: 18 bits to 3 bits of exponent (the number of leading ones, at most 7) and 11 of mantissa.
/// Section 2.10 (ANGRY zbuffer.c).
/// @param z  18 bits
constexpr std::uint32_t n64Depth(std::uint32_t z) {
    const int exponent = std::min(std::countl_one(z << 14), 7);
    return static_cast<std::uint32_t>(exponent) << 11 | ((z >> std::max(6 - exponent, 0)) & 0x7ff);
}

/// The 18 bits that the N64 reads for @p code of 14: the least z that is stored as it.
constexpr std::uint32_t n64DepthRead(std::uint32_t code) {
    const int exponent = static_cast<int>(code >> 11);
    return 0x40000u - (0x40000u >> exponent) + ((code & 0x7ff) << std::max(6 - exponent, 0));
}

}  // namespace gnomon
