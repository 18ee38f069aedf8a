#include "profile/depth.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

namespace gnomon {
namespace depth_test {

TEST(LinearDepth, EndsAtZeroAndTheLargestCode) {
    for (const int bits : {15, 16, 24}) {
        EXPECT_EQ(linearDepth(0, bits), 0u);
        EXPECT_EQ(linearDepth(std::uint64_t{1} << 32, bits), (1u << bits) - 1);
    }
}

// |code / most - depth / 2^32| is at most half a step.
TEST(LinearDepth, IsTheNearestCode) {
    std::uint64_t random = 1;
    for (int i = 0; i < 20'000; ++i) {
        random = random * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u;
        const auto depth = static_cast<std::int64_t>(random >> 32);
        for (const int bits : {16, 24}) {
            const std::int64_t most = (std::int64_t{1} << bits) - 1;
            const std::int64_t code = linearDepth(static_cast<std::uint64_t>(depth), bits);
            EXPECT_LE(std::abs((code << 32) - depth * most), std::int64_t{1} << 31);
        }
    }
}

TEST(LinearDepth, LeastDepthIsTheFirstOfItsCode) {
    for (std::uint32_t code = 0; code < 65536; ++code) {
        const std::uint64_t least = leastLinearDepth(code, 16);
        EXPECT_EQ(linearDepth(least, 16), code);
        if (code > 0) {
            EXPECT_EQ(linearDepth(least - 1, 16), code - 1);
        }
    }
    for (std::uint32_t code = 1; code < 1u << 24; code += 997) {
        const std::uint64_t least = leastLinearDepth(code, 24);
        EXPECT_EQ(linearDepth(least, 24), code);
        EXPECT_EQ(linearDepth(least - 1, 24), code - 1);
    }
}

TEST(VoodooZ, TakesTheWholePart) {
    EXPECT_EQ(voodooZ(0x12345 << 8), 0x1234u);
    EXPECT_EQ(voodooZ(-1), 0u);
    EXPECT_EQ(voodooZ(0x7fffffff), 0xffffu);
}

TEST(VoodooW, GrowsWithDistance) {
    EXPECT_EQ(voodooW(std::uint64_t{1} << 48), 0u);
    EXPECT_EQ(voodooW(0), 0xffffu);
    std::uint32_t last = 0;
    for (double w = 1.0001; w < 60'000; w *= 1.00007) {
        const std::uint32_t code = voodooW(static_cast<std::uint64_t>(0x1p48 / w));
        EXPECT_GE(code, last);
        last = code;
    }
}

TEST(VoodooW, LeastInverseIsTheFirstOfItsCode) {
    for (std::uint32_t code = 1; code <= 0xfffe; ++code) {
        const std::uint64_t least = leastVoodooInverseW(code);
        EXPECT_EQ(voodooW(least), code);
        EXPECT_EQ(voodooW(least - 1), code + 1);
    }
}

// Written as a number: w = 1 / inverse lies between 2^e and 2^(e+1), and the mantissa runs down from the
// octave's upper end in 4,096 steps.
TEST(VoodooW, IsFourBitsOfExponentAndTwelveOfMantissa) {
    for (int exponent = 0; exponent < 16; ++exponent)
        for (int step = 0; step < 4096; step += 7) {
            const double inverse = (2 - (step + 0.5) / 4096) / (2 << exponent);
            const auto code = static_cast<std::uint32_t>(exponent * 4096 + step + 1);
            EXPECT_EQ(voodooW(static_cast<std::uint64_t>(inverse * 0x1p48)), std::min(code, 0xffffu));
        }
}

TEST(N64Depth, ReadsTheLeastDepthOfEachCode) {
    std::map<std::uint32_t, std::uint32_t> least;
    for (std::uint32_t z = 0; z < 1u << 18; ++z) least.try_emplace(n64Depth(z), z);
    EXPECT_EQ(least.size(), 1u << 14);
    for (const auto& [code, z] : least) EXPECT_EQ(n64DepthRead(code), z) << code;
}

TEST(N64Depth, KeepsOrder) {
    for (std::uint32_t z = 1; z < 1u << 18; ++z) EXPECT_GE(n64Depth(z), n64Depth(z - 1));
}

// Half of the range has the coarsest step, and the far end the finest: z nears 1 slowly.
TEST(N64Depth, HasFinerStepsFarAway) {
    EXPECT_EQ(n64DepthRead(1), 64u);
    EXPECT_EQ(n64DepthRead(1 << 11), 0x20000u);
    EXPECT_EQ(n64DepthRead((1 << 14) - 1), 0x3ffffu);
    EXPECT_EQ(n64DepthRead((1 << 14) - 2), 0x3fffeu);
}

}  // namespace depth_test
}  // namespace gnomon
