#include "profile/pixel.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

namespace gnomon {
namespace {

constexpr std::array kBits{1, 4, 5, 6, 7, 8};

TEST(Pixel, StoresWhatItReads) {
    for (const int bits : kBits)
        for (int code = 0; code <= largestCode(bits); ++code) {
            EXPECT_EQ(truncated(replicated(code, bits), bits), code) << bits;
            EXPECT_EQ(truncated(shifted(code, bits), bits), code) << bits;
            EXPECT_EQ(rounded(replicated(code, bits), bits), code) << bits;
        }
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

TEST(GsDither, ClampsBeforeItCuts) {
    EXPECT_EQ(gsDithered(255, 3), 31);
    EXPECT_EQ(gsDithered(0, -4), 0);
    EXPECT_EQ(gsDithered(8, -4), 0);
    EXPECT_EQ(gsDithered(5, 3), 1);
}

}  // namespace
}  // namespace gnomon
