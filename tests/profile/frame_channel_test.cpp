// Section 4 of hardware.md: the values that its authors worked out by hand or by enumeration, and whole
// pixels.

#include "profile/frame_channel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "profile/words.h"

namespace gnomon {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::Optional;
using enum BlendUnit;
using enum MaskOperation;

/// Codes of 1/4, 1/2 and 1.
std::vector<int> quarterHalfOne(int bits) {
    return {1 << (bits - 2), 1 << (bits - 1), largestCode(bits)};
}

/// One row of table 4.1: DBL of 1/4, 1/2, 1; HALF of 1, 1/2, 1/4; INV of 1/4, 1/2, 1. Empty: the row has
/// none.
struct Row {
    std::string name;
    FrameChannel channel;
    int half = 128;
    std::vector<int> doubled{}, halved{}, inverted{};
};
void PrintTo(const Row& row, std::ostream* out) {
    *out << row.name;
}

class Table41 : public testing::TestWithParam<Row> {};

TEST_P(Table41, ComesOutOfTheFunctions) {
    const auto& [name, channel, half, doubled, halved, inverted] = GetParam();
    const std::vector<int> up = quarterHalfOne(channel.bits), down(up.rbegin(), up.rend());
    const auto all = [&, &c = channel, h = half](MaskOperation operation, const std::vector<int>& codes) {
        std::vector<int> results;
        for (const int code : codes) results.push_back(apply(c, operation, code, h).value_or(-1));
        return results;
    };
    if (!doubled.empty()) {
        EXPECT_EQ(all(Double, up), doubled);
    }
    if (!halved.empty()) {
        EXPECT_EQ(all(Halve, down), halved);
    }
    if (!inverted.empty()) {
        EXPECT_EQ(all(Invert, up), inverted);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Hardware, Table41,
    testing::Values(Row{"VoodooMame5", {VoodooMame, 5}, 128, {16, 31, 31}, {16, 8, 4}, {23, 15, 0}},
                    Row{"Voodoo86Box5", {Voodoo86Box, 5}, 128, {16, 31, 31}, {16, 8, 4}, {23, 15, 0}},
                    Row{"VoodooMame5Half127", {VoodooMame, 5}, 127, {16, 31, 31}, {15, 8, 4}, {23, 15, 0}},
                    Row{"Voodoo86Box5Half127", {Voodoo86Box, 5}, 127, {16, 31, 31}, {15, 8, 4}, {23, 15, 0}},
                    Row{"VoodooMame6", {VoodooMame, 6}, 128, {32, 63, 63}, {32, 16, 8}, {47, 31, 0}},
                    Row{"Voodoo86Box6", {Voodoo86Box, 6}, 128, {32, 63, 63}, {32, 16, 8}, {47, 31, 0}},
                    Row{"Voodoo86Box6Half127", {Voodoo86Box, 6}, 127, {32, 63, 63}, {31, 16, 8}, {47, 31, 0}},
                    Row{"Ps2Ct32", {Gs, 8}, 0, {128, 255, 255}, {127, 64, 32}, {191, 127, 0}},
                    Row{"Ps2Ct16", {Gs, 5}, 0, {16, 31, 31}, {15, 8, 4}, {23, 15, 0}},
                    Row{"N64In16", {Rdp, 5}, 0, {15, 31, 29}, {15, 8, 4}, {}},
                    Row{"N64In32", {Rdp, 8}, 0, {126, 252, 246}, {127, 64, 32}, {}},
                    Row{"Ps1", {Psx, 5}, 0, {16, 31, 31}, {15, 8, 4}, {}},
                    Row{"Dreamcast", {PowerVr, 8}, 128, {127, 255, 255}, {128, 64, 32}, {191, 126, 0}},
                    Row{"DreamcastHalf127", {PowerVr, 8}, 127, {127, 255, 255}, {127, 63, 31}, {191, 126, 0}},
                    Row{"Flipper8", {Flipper, 8}, 128, {127, 255, 255}, {128, 64, 32}, {191, 126, 0}},
                    Row{"Flipper6", {Flipper, 6}, 128, {32, 63, 63}, {32, 16, 8}, {47, 31, 0}},
                    Row{"Psp8888", {Ge, 8}, 128, {128, 255, 255}, {128, 64, 32}, {191, 127, 0}},
                    Row{"Psp8888Half127", {Ge, 8}, 127, {128, 255, 255}, {127, 63, 32}, {}},
                    Row{"Psp565", {Ge, 5}, 128, {16, 31, 31}, {16, 8, 4}, {23, 15, 0}},
                    Row{"Psp4444", {Ge, 4}, 128, {8, 15, 15}, {8, 4, 2}, {11, 7, 0}},
                    Row{"ViRGE8Alpha127", {Virge, 8}, 128, {}, {128, 64, 32}, {}},
                    Row{"ViRGE8Alpha128", {Virge, 8}, 127, {}, {127, 63, 31}, {}},
                    Row{"ViRGE555Alpha127", {Virge, 5}, 128, {}, {16, 8, 4}, {}},
                    Row{"ViRGE555Alpha128", {Virge, 5}, 127, {}, {15, 8, 4}, {}},
                    Row{"Riva128", {Nv3, 5}, 0, {}, {15, 8, 4}, {}},
                    Row{"Ds", {Ds, 6}, 0, {}, {31, 16, 8}, {}},
                    Row{"IdealFloor5", {IdealFloor, 5}, 0, {16, 31, 31}, {15, 8, 4}, {}},
                    Row{"IdealFloor6", {IdealFloor, 6}, 0, {32, 63, 63}, {31, 16, 8}, {}},
                    Row{"IdealFloor8", {IdealFloor, 8}, 0, {128, 255, 255}, {127, 64, 32}, {}},
                    Row{"IdealRound5", {IdealRound, 5}, 0, {16, 31, 31}, {16, 8, 4}, {}},
                    Row{"IdealRound6", {IdealRound, 6}, 0, {32, 63, 63}, {32, 16, 8}, {}},
                    Row{"IdealRound8", {IdealRound, 8}, 0, {128, 255, 255}, {128, 64, 32}, {}}),
    [](const auto& test) { return test.param.name; });

int once(const FrameChannel& channel, MaskOperation operation, int code, int half = 128) {
    return apply(channel, operation, code, half).value_or(-1);
}

/// All results over the cells of the 4x4 matrix.
std::set<int> overCells(FrameChannel channel, DitherMode dither, std::vector<MaskOperation> operations,
                        int code) {
    channel.dither = dither;
    std::set<int> results;
    for (channel.cell = 0; channel.cell < 16; ++channel.cell) {
        int c = code;
        for (const MaskOperation operation : operations) c = once(channel, operation, c);
        results.insert(c);
    }
    return results;
}

std::vector<MaskOperation> trips(int count, MaskOperation first, MaskOperation second) {
    std::vector<MaskOperation> all;
    for (int i = 0; i < count; ++i) all.insert(all.end(), {first, second});
    return all;
}

// The column "small codes" of table 4.1.
TEST(Table41SmallCodes, ComeOutOfTheFunctions) {
    const FrameChannel mame5{VoodooMame, 5}, box5{Voodoo86Box, 5}, box6{Voodoo86Box, 6};
    for (const auto& [from, to] : {std::pair(4, 2), std::pair(2, 1), std::pair(1, 0)}) {
        EXPECT_EQ(once(mame5, Halve, from), to);
        EXPECT_EQ(once(box5, Halve, from), to);
    }
    for (const FrameChannel& c : {mame5, box5, FrameChannel{VoodooMame, 6}, box6})
        for (int code = 1; code < 1 << (c.bits - 1); code *= 2) {
            EXPECT_EQ(once(c, Double, code), 2 * code);
            EXPECT_EQ(once(c, Halve, 2 * code), code);
        }
    EXPECT_EQ(once(mame5, Halve, 2, 127), 1);
    EXPECT_EQ(once(mame5, Halve, 1, 127), 0);
    EXPECT_EQ(once(box5, Halve, 2, 127), 0);
    EXPECT_EQ(once(box6, Halve, 8, 127), 3);
    EXPECT_EQ(once(box6, Halve, 4, 127), 1);
    EXPECT_EQ(once(box6, Halve, 2, 127), 0);
    EXPECT_EQ(once({Rdp, 5}, Double, 1), 1);
    EXPECT_EQ(once({Rdp, 5}, Double, 4), 7);
    EXPECT_EQ(once({Rdp, 8}, Double, 32), 63);
    EXPECT_EQ(once({PowerVr, 8}, Double, 1), 1);
    for (const auto& [from, to] : {std::pair(8, 15), std::pair(4, 7), std::pair(2, 3), std::pair(1, 1)})
        EXPECT_EQ(once({Flipper, 6}, Double, from), to);
    EXPECT_EQ(once({Ge, 8}, Halve, 16, 127), 8);
    EXPECT_EQ(once({Virge, 8}, Halve, 2, 127), 0);
    EXPECT_EQ(once({Virge, 5}, Halve, 2, 128), 1);
    EXPECT_EQ(once({IdealFloor, 8}, Halve, 1), 0);
    EXPECT_EQ(once({IdealRound, 8}, Halve, 1), 1);
    EXPECT_EQ(once({IdealRound, 5}, Halve, 1), 1);
    for (int code = 0; code < 32; ++code) EXPECT_EQ(once({Nv3, 5}, Halve, code), code / 2);
    for (int code = 0; code < 64; ++code) EXPECT_EQ(once({Ds, 6}, Halve, code), code / 2);
}

// The rows of table 4.1 that no mask operation stands for.
TEST(Table41OtherWays, ComeOutOfTheFunctions) {
    // N64 in two cycles: the second adds the missing 1/32 of the frame.
    const auto doubledTwice = [](int code) {
        const int m = code << 3, first = blendRdp(m, 31, m, 31);
        return blendRdp(m, 1, first, 31) >> 3;
    };
    for (const auto& [from, to] :
         {std::pair(8, 16), std::pair(16, 0), std::pair(31, 29), std::pair(4, 8), std::pair(2, 3)})
        EXPECT_EQ(doubledTwice(from), to) << from;
    // PS2: the frame as a texture over itself.
    for (const auto& [from, to] :
         {std::pair(64, 127), std::pair(128, 255), std::pair(255, 255), std::pair(32, 63)})
        EXPECT_EQ(modulateGs(from, 0xff), to) << from;
    for (const auto& [from, to] : {std::pair(255, 127), std::pair(128, 64), std::pair(64, 32)})
        EXPECT_EQ(modulateGs(from, 0x40), to) << from;
    // RIVA 128: weights of the destination's own colour.
    for (const auto& [from, to] : {std::pair(31, 16), std::pair(16, 8), std::pair(8, 4), std::pair(1, 0)})
        EXPECT_EQ(blendNv3(16, from, from, false, true), to) << from;
    for (const auto& [from, to] : {std::pair(8, 13), std::pair(16, 23), std::pair(31, 31)})
        EXPECT_EQ(blendNv3(31, from, from), to) << from;
}

TEST(Table41Dither, ComesOutOfTheFunctions) {
    using enum DitherMode;
    const FrameChannel five{VoodooMame, 5}, six{VoodooMame, 6};
    for (const DitherMode mode : {Matrix4x4, Matrix4x4Subtract}) {
        EXPECT_THAT(overCells(five, mode, {Double}, 8), ElementsAre(16, 17));
        EXPECT_THAT(overCells(five, mode, {Double}, 16), ElementsAre(31));
        EXPECT_THAT(overCells(five, mode, {Double}, 31), ElementsAre(31));
        EXPECT_THAT(overCells(five, mode, {Halve}, 31), ElementsAre(15, 16));
        EXPECT_THAT(overCells(five, mode, {Halve}, 16), ElementsAre(8));
        EXPECT_THAT(overCells(five, mode, {Halve}, 8), ElementsAre(4));
    }
    EXPECT_THAT(overCells(five, Matrix4x4, {Double}, 2), ElementsAre(3, 4));
    EXPECT_THAT(overCells(five, Matrix4x4, {Halve}, 1), ElementsAre(0, 1));
    EXPECT_THAT(overCells(five, Matrix4x4Subtract, {Double}, 1), ElementsAre(2, 3));
    EXPECT_THAT(overCells(six, Matrix4x4, {Double}, 16), ElementsAre(32, 33));
    EXPECT_THAT(overCells(six, Matrix4x4, {Double}, 32), ElementsAre(63));
    EXPECT_THAT(overCells(six, Matrix4x4, {Halve}, 63), ElementsAre(31, 32));
    EXPECT_THAT(overCells(six, Matrix4x4, {Halve}, 32), ElementsAre(16, 17));
    EXPECT_THAT(overCells(six, Matrix4x4, {Halve}, 16), ElementsAre(8, 9));
    EXPECT_THAT(overCells(six, Matrix4x4, {Double}, 4), ElementsAre(7, 8));
}

/// The codes after each trip of @p first and @p second.
std::vector<int> afterTrips(const FrameChannel& channel, MaskOperation first, MaskOperation second, int code,
                            int count, int half = 128) {
    std::vector<int> codes;
    for (int i = 0; i < count; ++i) {
        code = once(channel, second, once(channel, first, code, half), half);
        codes.push_back(code);
    }
    return codes;
}

TEST(Table42, ComesOutOfTheFunctions) {
    for (const BlendUnit unit : {VoodooMame, Voodoo86Box}) {
        for (const int bits : {5, 6})
            for (int code = 1; code <= 1 << (bits - 1); code *= 2)
                EXPECT_THAT(afterTrips({unit, bits}, Double, Halve, code, 1), ElementsAre(code));
        EXPECT_THAT(afterTrips({unit, 5}, Halve, Double, 31, 1), ElementsAre(31));
        EXPECT_THAT(afterTrips({unit, 5}, Double, Halve, 8, 1, 127), ElementsAre(8));
        EXPECT_THAT(afterTrips({unit, 5}, Double, Halve, 16, 1, 127), ElementsAre(15));
        EXPECT_THAT(afterTrips({unit, 5}, Halve, Double, 31, 1, 127), ElementsAre(30));
    }
    EXPECT_THAT(afterTrips({Gs, 8}, Double, Halve, 64, 1), ElementsAre(64));
    EXPECT_THAT(afterTrips({Gs, 8}, Halve, Double, 255, 1), ElementsAre(254));
    EXPECT_THAT(afterTrips({Gs, 5}, Double, Halve, 8, 1), ElementsAre(8));
    EXPECT_THAT(afterTrips({Gs, 5}, Halve, Double, 31, 1), ElementsAre(30));
    for (const BlendUnit unit : {PowerVr, Flipper}) {
        EXPECT_THAT(afterTrips({unit, 8}, Double, Halve, 64, 4), ElementsAre(63, 62, 61, 60));
        EXPECT_THAT(afterTrips({unit, 8}, Halve, Double, 255, 2), ElementsAre(255, 255));
        EXPECT_THAT(afterTrips({unit, 8}, Halve, Double, 128, 3), ElementsAre(127, 125, 123));
    }
    EXPECT_THAT(afterTrips({Flipper, 6}, Double, Halve, 16, 2), ElementsAre(16, 16));
    EXPECT_THAT(afterTrips({Flipper, 6}, Double, Halve, 32, 2), ElementsAre(32, 32));
    EXPECT_THAT(afterTrips({Flipper, 6}, Double, Halve, 8, 2), ElementsAre(7, 6));
    EXPECT_THAT(afterTrips({Flipper, 6}, Halve, Double, 63, 2), ElementsAre(63, 63));
    EXPECT_THAT(afterTrips({Ge, 8}, Double, Halve, 64, 1), ElementsAre(64));
    EXPECT_THAT(afterTrips({Ge, 8}, Halve, Double, 255, 1), ElementsAre(255));
    EXPECT_EQ(once({Rdp, 5}, Double, 8), 15);
    EXPECT_THAT(afterTrips({Rdp, 5}, Double, Halve, 8, 1), ElementsAre(7));
    EXPECT_THAT(afterTrips({Rdp, 5}, Halve, Double, 31, 1), ElementsAre(29));
}

TEST(Table42Dither, DriftsOverEightTrips) {
    using enum DitherMode;
    const FrameChannel five{VoodooMame, 5};
    const auto range = [&](DitherMode mode, MaskOperation first, MaskOperation second, int code) {
        const std::set<int> all = overCells(five, mode, trips(8, first, second), code);
        return std::pair(*all.begin(), *all.rbegin());
    };
    EXPECT_EQ(range(Matrix4x4, Double, Halve, 8), std::pair(8, 9));
    EXPECT_EQ(range(Matrix4x4, Double, Halve, 16), std::pair(13, 16));
    EXPECT_EQ(range(Matrix4x4, Halve, Double, 31), std::pair(26, 31));
    EXPECT_EQ(range(Matrix4x4Subtract, Double, Halve, 8), std::pair(8, 16));
    EXPECT_EQ(range(Matrix4x4Subtract, Double, Halve, 4), std::pair(4, 12));
    EXPECT_EQ(range(Matrix4x4Subtract, Halve, Double, 31), std::pair(31, 31));
}

TEST(Section43, AdditiveCountersAreExact) {
    for (int code = 0; code < 32; ++code) {
        EXPECT_EQ(once({GsWrap, 5}, Increment, code), (code + 1) % 32);
        EXPECT_EQ(once({GsWrap, 5}, Decrement, code), (code + 31) % 32);
        // Any constant from 0xf8 on takes one away by a sum that wraps.
        for (int step = 0xf8; step <= 0xff; ++step)
            EXPECT_EQ(blendGs({GsInput::Source, GsInput::Zero, 0x80, GsInput::Destination}, step, code << 3,
                              false) >>
                          3,
                      (code + 31) % 32);
        EXPECT_EQ(once({Rdp, 5}, Increment, code), (code + 2) % 32);
        EXPECT_EQ(once({Rdp, 5}, Decrement, code), (code + 30) % 32);
        EXPECT_EQ(blendRdp(9, 31, code << 3, 31) >> 3, (code + 1) % 32);
        EXPECT_EQ(once({Psx, 5}, Increment, code), std::min(code + 1, 31));
        EXPECT_EQ(once({Psx, 5}, Decrement, code), std::max(code - 1, 0));
    }
    for (int code = 0; code < 256; ++code) {
        EXPECT_EQ(once({GsWrap, 8}, Increment, code), (code + 1) % 256);
        EXPECT_EQ(once({GsWrap, 8}, Decrement, code), (code + 255) % 256);
        EXPECT_EQ(once({Gs, 8}, Increment, code), std::min(code + 1, 255));
    }
    for (int code = 0; code < 64; ++code) {
        EXPECT_EQ(once({Flipper, 6}, Increment, code), std::min(code + 1, 63));
        EXPECT_EQ(once({Flipper, 6}, Decrement, code), std::max(code - 1, 0));
    }
    // The N64 reaches no constant that takes one code away.
    for (int p = 0; p < 256; ++p) {
        bool always = true;
        for (int code = 0; code < 32; ++code)
            always = always && blendRdp(p, 31, code << 3, 31) >> 3 == (code + 31) % 32;
        EXPECT_FALSE(always) << p;
    }
    // Nor does a smaller step do on Flipper.
    for (const int step : {1, 2, 3}) {
        bool always = true;
        for (int code = 1; code < 64; ++code) {
            const auto less = blend(Flipper, {step, replicated(code, 6), Weight::one(), Weight::one(),
                                              BlendOperation::ReverseSubtract});
            always = always && *less >> 2 == code - 1;
        }
        EXPECT_FALSE(always) << step;
    }
}

// design.md, "Facts measured".
TEST(IdealGl, KeepsTheLevelsOfEightBits) {
    const FrameChannel eight{IdealRound, 8};
    std::vector<int> codes{64};
    for (const MaskOperation operation : {Double, Double, Halve, Halve})
        codes.push_back(once(eight, operation, codes.back()));
    EXPECT_THAT(codes, ElementsAre(64, 128, 255, 128, 64));
}

// Whatever its unit, a frame that is read and stored without dithering keeps its codes.
TEST(FrameChannel, StoresWhatItReads) {
    for (std::size_t u = 0; u < names<BlendUnit>().size(); ++u)
        for (const int bits : {4, 5, 6, 7, 8}) {
            const FrameChannel channel{static_cast<BlendUnit>(u), bits};
            for (int code = 0; code <= largestCode(bits); ++code)
                EXPECT_EQ(stored(channel, readBack(channel, code)), code);
        }
}

TEST(FrameChannel, ResultsAreCodes) {
    for (std::size_t u = 0; u < names<BlendUnit>().size(); ++u)
        for (const int bits : {4, 5, 6, 8})
            for (const MaskOperation operation : {Double, Halve, Invert, Increment, Decrement})
                for (const int half : {127, 128})
                    for (int code = 0; code <= largestCode(bits); ++code) {
                        const auto result = apply({static_cast<BlendUnit>(u), bits}, operation, code, half);
                        if (!result) continue;
                        ASSERT_GE(*result, 0);
                        ASSERT_LE(*result, largestCode(bits)) << name(static_cast<BlendUnit>(u)) << bits;
                    }
}

const ColourFormat k565{"565", 5, 6, 5, 0}, k5551{"5551", 5, 5, 5, 1}, k8888{"8888", 8, 8, 8, 8};

TEST(BlendInto, WidensAndCutsEachChannel) {
    const FrameState voodoo{.unit = VoodooMame, .format = k565};
    const BlendState doubling{BlendFactor::DstColor, BlendFactor::One};
    EXPECT_THAT(blendInto(voodoo, doubling, {255, 255, 255, 255}, {8, 16, 1, 0}),
                Optional(ElementsAre(16, 32, 2, 0)));
    // A source of zero leaves its channel alone: the neutral value of section 1.
    EXPECT_THAT(blendInto(voodoo, doubling, {0, 255, 0, 255}, {8, 16, 1, 0}),
                Optional(ElementsAre(8, 32, 1, 0)));
}

TEST(BlendInto, DithersByPosition) {
    FrameState voodoo{.unit = VoodooMame, .format = k565, .dither = DitherMode::Matrix4x4};
    const BlendState opaque{BlendFactor::One, BlendFactor::Zero};
    std::set<int> reds;
    for (voodoo.x = 0; voodoo.x < 4; ++voodoo.x)
        for (voodoo.y = 0; voodoo.y < 4; ++voodoo.y)
            reds.insert((*blendInto(voodoo, opaque, {100, 0, 0, 0}, {}))[0]);
    EXPECT_THAT(reds, ElementsAre(12, 13));
}

TEST(BlendInto, LeavesAlphaAsTheChipDoes) {
    const BlendState fading{BlendFactor::SrcAlpha, BlendFactor::OneMinusSrcAlpha};
    const Rgba source{200, 200, 200, 64}, codes{40, 40, 40, 99};
    // The PS2 writes the source's alpha, and 64 is one half; the PSP keeps its stencil.
    EXPECT_THAT(blendInto({.unit = Gs, .format = k8888}, fading, source, codes),
                Optional(ElementsAre(120, 120, 120, 64)));
    EXPECT_EQ((*blendInto({.unit = Ge, .format = k8888}, fading, source, codes))[3], 99);
    EXPECT_EQ((*blendInto({.unit = IdealRound, .format = k8888}, fading, source, codes))[3],
              (64 * 64 + 99 * 191 + 127) / 255);
}

// One bit of alpha is 1 in OpenGL's 255ths, and 128 on the PS2; without the bit it counts as 1 (section 2.5).
TEST(BlendInto, ReadsAlphaOfOneBit) {
    const BlendState scaling{BlendFactor::Zero, BlendFactor::DstAlpha};
    for (const BlendUnit unit : {Gs, IdealRound}) {
        const FrameState frame{.unit = unit, .format = k5551};
        EXPECT_EQ((*blendInto(frame, scaling, {}, {21, 21, 21, 1}))[0], 21);
        EXPECT_EQ((*blendInto(frame, scaling, {}, {21, 21, 21, 0}))[0], 0);
        EXPECT_EQ((*blendInto({.unit = unit, .format = k565}, scaling, {}, {21, 21, 21, 0}))[0], 21);
    }
}

}  // namespace
}  // namespace gnomon
