#include "profile/pixel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>

#include "profile/words.h"

namespace gnomon {
namespace pixel_test {

constexpr std::array kBits{1, 2, 3, 4, 5, 6, 7, 8};

TEST(Pixel, StoresWhatItReads) {
    for (const int bits : kBits)
        for (int code = 0; code <= largestCode(bits); ++code) {
            EXPECT_EQ(truncated(replicated(code, bits), bits), code) << bits;
            EXPECT_EQ(truncated(shifted(code, bits), bits), code) << bits;
            EXPECT_EQ(rounded(replicated(code, bits), bits), code) << bits;
        }
}

TEST(Pixel, OfNoBitsIsZero) {
    EXPECT_EQ(replicated(0, 0), 0);
}

// The definition of replication: the code again and again, and of these bits the highest eight.
TEST(Pixel, ReplicationRepeatsTheCode) {
    for (const int bits : kBits)
        for (int code = 0; code <= largestCode(bits); ++code) {
            std::uint64_t repeated = 0;
            int length = 0;
            while (length < 8) {
                repeated = repeated << bits | static_cast<std::uint64_t>(code);
                length += bits;
            }
            EXPECT_EQ(replicated(code, bits), static_cast<int>(repeated >> (length - 8))) << bits;
        }
}

TEST(Pixel, RoundsToTheNearestCode) {
    for (const int bits : kBits)
        for (int value = 0; value <= 255; ++value) {
            // In units of 1 / (255 * most): how far the code stands from the value.
            const int most = largestCode(bits);
            const auto distance = [&](int code) { return std::abs(code * 255 - value * most); };
            const int code = rounded(value, bits);
            for (int other = 0; other <= most; ++other) EXPECT_LE(distance(code), distance(other)) << bits;
        }
}

TEST(VoodooDither, MatricesHoldTheirCells) {
    std::array<int, 16> seen{};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) ++seen[static_cast<std::size_t>(voodooCell(DitherMode::Matrix4x4, x, y))];
    for (const int count : seen) EXPECT_EQ(count, 1);
    EXPECT_EQ(voodooCell(DitherMode::Matrix4x4Subtract, 3, 2), 9);
    EXPECT_EQ(voodooCell(DitherMode::Matrix2x2, 0, 0), 8);
    EXPECT_EQ(voodooCell(DitherMode::Matrix2x2, 1, 0), 10);
    EXPECT_EQ(voodooCell(DitherMode::Matrix2x2Subtract, 0, 1), 11);
    EXPECT_EQ(voodooCell(DitherMode::Matrix2x2, 3, 3), 9);
}

TEST(VoodooDither, StaysWithinTheCodesAndKeepsOrder) {
    for (const int bits : {5, 6})
        for (int cell = 0; cell < 16; ++cell) {
            EXPECT_EQ(voodooDithered(0, bits, cell), 0);
            EXPECT_EQ(voodooDithered(255, bits, cell), largestCode(bits));
            for (int value = 1; value <= 255; ++value) {
                const int code = voodooDithered(value, bits, cell);
                EXPECT_GE(code, voodooDithered(value - 1, bits, cell));
                EXPECT_LE(code, largestCode(bits));
            }
        }
}

// Sixteen cells together store a value with four further bits. Their sum is off by less than one of those:
// the formula's two shifts cut up to one each, with opposite signs.
TEST(VoodooDither, MeansTheValue) {
    for (const int bits : {5, 6})
        for (int value = 0; value <= 255; ++value) {
            int sum = 0;
            for (int cell = 0; cell < 16; ++cell) sum += voodooDithered(value, bits, cell);
            const double share = value / 255.0 * largestCode(bits) * 16;
            EXPECT_NEAR(sum, share, 1.0) << bits << " bits, " << value;
        }
}

// A pixel that is read and stored again without a blend keeps its code in the 2x2 matrix; the lowest and
// highest cells of 4x4 move some codes by one, which is half of why doubled and halved masks creep.
TEST(VoodooDither, MovesCodesInOuterCellsOnly) {
    for (const int bits : {5, 6})
        for (int cell = 0; cell < 16; ++cell)
            for (int code = 0; code <= largestCode(bits); ++code) {
                const int again = voodooDithered(replicated(code, bits), bits, cell);
                EXPECT_LE(std::abs(again - code), cell < 3 || cell > 12 ? 1 : 0) << bits << " " << cell;
            }
    EXPECT_EQ(voodooDithered(replicated(2, 5), 5, 0), 1);
    EXPECT_EQ(voodooDithered(replicated(16, 5), 5, 15), 17);
}

TEST(VoodooDither, SubtractionIsHalfAStep) {
    EXPECT_EQ(ditherSubtraction(5, 0), 7);
    EXPECT_EQ(ditherSubtraction(5, 15), 0);
    EXPECT_EQ(ditherSubtraction(6, 0), 3);
    EXPECT_EQ(ditherSubtraction(6, 15), 0);
    // Some version of MAME shifts once by two.
    for (int cell = 0; cell < 16; ++cell) EXPECT_EQ(ditherSubtraction(6, cell), (15 - cell) >> 2);
}

TEST(VirgeDither, NeverPassesTheLargestCode) {
    std::array<int, 8> seen{};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) ++seen[static_cast<std::size_t>(virgeCell(x, y))];
    for (const int count : seen) EXPECT_EQ(count, 2);
    for (int value = 0; value <= 255; ++value)
        for (int cell = 0; cell < 8; ++cell) {
            EXPECT_LE(virgeDithered(value, cell), 31);
            EXPECT_GE(virgeDithered(value, cell), value >> 3);
        }
}

// 86VIRGE: up to 248 the cell is added and the low three bits dropped, above it nothing is added.
TEST(VirgeDither, AddsItsCellToAllValuesUpTo248) {
    for (int value = 0; value <= 255; ++value)
        for (int cell = 0; cell < 8; ++cell)
            EXPECT_EQ(virgeDithered(value, cell), (value > 248 ? 248 : value + cell) / 8) << value;
}

/// How often each cell occurs in the 4 x 4 pixels.
std::map<int, int> countsOf(DitherMode mode) {
    std::map<int, int> counts;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) ++counts[ditherCell(mode, x, y)];
    return counts;
}

TEST(SignedDither, MatricesHoldEachCellTwice) {
    std::map<int, int> expected;
    for (int cell = -4; cell <= 3; ++cell) expected[cell] = 2;
    for (const DitherMode mode : {DitherMode::Gs, DitherMode::Psx, DitherMode::Ge})
        EXPECT_EQ(countsOf(mode), expected) << name(mode);
}

// PSXSPX: the last two rows are the first two, moved by two pixels.
TEST(SignedDither, PlayStationsRowsRepeatMovedByTwo) {
    const std::array<int, 4> first{-4, 0, -3, 1}, second{2, -2, 3, -1};
    for (int x = 0; x < 4; ++x) {
        const auto at = static_cast<std::size_t>(x), moved = static_cast<std::size_t>((x + 2) % 4);
        EXPECT_EQ(ditherCell(DitherMode::Psx, x, 0), first[at]);
        EXPECT_EQ(ditherCell(DitherMode::Psx, x, 1), second[at]);
        EXPECT_EQ(ditherCell(DitherMode::Psx, x, 2), first[moved]);
        EXPECT_EQ(ditherCell(DitherMode::Psx, x, 3), second[moved]);
    }
}

// The register's three bits as ps2sdk writes them, with bit 2 as the sign.
TEST(SignedDither, Ps2sMatrixIsThatOfItsRegister) {
    const std::array<int, 16> dimx{4, 2, 5, 3, 0, 6, 1, 7, 5, 3, 4, 2, 1, 7, 0, 6};
    for (int i = 0; i < 16; ++i) {
        const int bits = dimx[static_cast<std::size_t>(i)];
        EXPECT_EQ(ditherCell(DitherMode::Gs, i % 4, i / 4), bits - (bits & 4) * 2);
    }
}

// All values, before and beyond the clamp, and all cells, by real numbers.
TEST(SignedDither, AddsClampsAndCuts) {
    for (const int bits : {4, 5, 6, 8})
        for (int value = -255; value <= 510; ++value)
            for (int cell = -8; cell <= 7; ++cell) {
                const double sum = std::fmin(std::fmax(value + cell, 0.0), 255.0);
                EXPECT_EQ(signedDithered(value, bits, cell),
                          static_cast<int>(std::floor(sum * std::ldexp(1.0, bits - 8))))
                    << value << " " << cell;
            }
}

TEST(RdpDither, MatricesHoldTheirCells) {
    std::map<int, int> twice;
    for (int cell = 0; cell < 8; ++cell) twice[cell] = 2;
    EXPECT_EQ(countsOf(DitherMode::RdpMagic), twice);
    EXPECT_EQ(countsOf(DitherMode::RdpBayer), twice);
    EXPECT_EQ(ditherCell(DitherMode::RdpMagic, 1, 0), 6);
    EXPECT_EQ(ditherCell(DitherMode::RdpMagic, 0, 3), 7);
    EXPECT_EQ(ditherCell(DitherMode::RdpBayer, 1, 0), 4);
    EXPECT_EQ(ditherCell(DitherMode::RdpBayer, 0, 3), 7);
}

// In 5 bits it is an addition of 7 - cell that ends at 31: cell 7 only drops the low bits. In 8 bits a value
// moves only up, and onto a multiple of 8 or 255.
TEST(RdpDither, RoundsUpWhereTheLowBitsPassTheCell) {
    for (int value = 0; value <= 255; ++value)
        for (int cell = 0; cell < 8; ++cell) {
            const int after = rdpDithered(value, cell);
            EXPECT_EQ(after >> 3, std::min((value + 7 - cell) / 8, 31)) << value << " " << cell;
            if (after != value) {
                EXPECT_GT(after, value);
                EXPECT_TRUE(after % 8 == 0 || after == 255);
            }
        }
}

TEST(DitherCell, IsThatOfTheModeEverywhere) {
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            EXPECT_EQ(ditherCell(DitherMode::Off, x, y), 0);
            EXPECT_EQ(ditherCell(DitherMode::Matrix4x4Subtract, x, y),
                      voodooCell(DitherMode::Matrix4x4, x, y));
            EXPECT_EQ(ditherCell(DitherMode::Matrix2x2, x, y), voodooCell(DitherMode::Matrix2x2, x, y));
            EXPECT_EQ(ditherCell(DitherMode::Virge, x, y), virgeCell(x, y));
            for (std::size_t m = 0; m < names<DitherMode>().size(); ++m) {
                const auto mode = static_cast<DitherMode>(m);
                EXPECT_EQ(ditherCell(mode, x, y), ditherCell(mode, x + 4, y + 4));
            }
        }
}

}  // namespace pixel_test
}  // namespace gnomon
