// Section 4 of hardware.md: the values that its authors worked out by hand or by enumeration, and whole
// pixels.

#include "profile/frame_channel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "profile/words.h"

namespace gnomon {
namespace frame_channel_test {

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

// Rows whose small codes are called exact: every power of two doubles and halves to its neighbour.
TEST(Table41SmallCodes, AreExactWhereItSaysSo) {
    for (const FrameChannel& c :
         {FrameChannel{VoodooMame, 5}, FrameChannel{Voodoo86Box, 5}, FrameChannel{VoodooMame, 6},
          FrameChannel{Voodoo86Box, 6}, FrameChannel{Gs, 8}, FrameChannel{Gs, 5}, FrameChannel{Psx, 5},
          FrameChannel{Ge, 8}, FrameChannel{Ge, 5}, FrameChannel{Ge, 4}})
        for (int code = 1; code < 1 << (c.bits - 1); code *= 2) {
            EXPECT_EQ(once(c, Double, code), 2 * code) << name(c.unit) << c.bits;
            EXPECT_EQ(once(c, Halve, 2 * code), code) << name(c.unit) << c.bits;
        }
}

// Dreamcast, and Flipper in 8 bits: 2v - 1 from 1 to 127, at either constant for 1/2.
TEST(Table41SmallCodes, DoubleToOneTooFewOnPowerVr) {
    for (const BlendUnit unit : {PowerVr, Flipper}) {
        for (int v = 1; v < 128; ++v) EXPECT_EQ(once({unit, 8}, Double, v), 2 * v - 1);
        EXPECT_EQ(once({unit, 8}, Double, 0), 0);
        for (int v = 128; v < 256; ++v) EXPECT_EQ(once({unit, 8}, Double, v), 255);
        EXPECT_EQ(once({unit, 8}, Double, 1, 127), 1);
    }
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
    // PSP: twice the source's alpha of 1/2 (the factor 2 SA, on the destination's side) doubles as well.
    for (const auto& [from, to] : {std::pair(64, 128), std::pair(128, 255), std::pair(255, 255)})
        EXPECT_EQ(blend(Ge, {0, from, Weight::zero(), Weight::of(2 * 255)}), to) << from;
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
        EXPECT_THAT(afterTrips({unit, 6}, Halve, Double, 63, 1), ElementsAre(63));
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
        bool always = true, up = true;
        for (int code = 0; code < 63; ++code)
            up = up && *blend(Flipper, {step, replicated(code, 6)}) >> 2 == code + 1;
        EXPECT_FALSE(up) << step;
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

// Every mode that a chip has, at every pixel of its matrix, over all values: what stored() does is the mode's
// own function, and no mode touches widths that its chip doesn't dither.
TEST(FrameChannel, StoresByItsModeAtEveryCell) {
    using enum DitherMode;
    for (std::size_t m = 0; m < names<DitherMode>().size(); ++m)
        for (const int bits : {1, 4, 5, 6, 8})
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 4; ++x)
                    for (int value = 0; value <= 255; ++value) {
                        const auto mode = static_cast<DitherMode>(m);
                        const int cell = ditherCell(mode, x, y);
                        int expected = value >> (8 - bits);
                        if (isVoodooDither(mode) && (bits == 5 || bits == 6))
                            expected = voodooDithered(value, bits, cell);
                        if (mode == Virge && bits == 5) expected = virgeDithered(value, cell);
                        if (mode == Gs && bits == 5) expected = signedDithered(value, 5, cell);
                        if (mode == Ge) expected = signedDithered(value, bits, cell);
                        if (mode == RdpMagic || mode == RdpBayer)
                            expected = rdpDithered(value, cell) >> (8 - bits);
                        ASSERT_EQ(stored({IdealRound, bits, mode, cell}, value), expected)
                            << name(mode) << " " << bits << " " << value;
                    }
}

// PCSX2 and PPSSPP: the cell comes before the clamp, so that a sum of 300 stays white, and -4 doesn't make
// it 251.
TEST(FrameChannel, AddsSignedCellsBeforeTheClamp) {
    EXPECT_EQ(stored({BlendUnit::Gs, 5, DitherMode::Gs, -4}, 300), 31);
    EXPECT_EQ(stored({BlendUnit::Gs, 5, DitherMode::Gs, -4}, 255), 31);
    EXPECT_EQ(stored({BlendUnit::Gs, 5, DitherMode::Gs, -4}, 251), 30);
    EXPECT_EQ(stored({BlendUnit::Ge, 8, DitherMode::Ge, -4}, 300), 255);
    EXPECT_EQ(stored({BlendUnit::Ge, 8, DitherMode::Ge, -4}, 255), 251);
    EXPECT_EQ(stored({BlendUnit::Ge, 8, DitherMode::Ge, 3}, -20), 0);
    // With COLCLAMP 0 the sum with its cell wraps.
    EXPECT_EQ(stored({BlendUnit::GsWrap, 5, DitherMode::Gs, 3}, 255), 0);
    EXPECT_EQ(stored({BlendUnit::Gs, 5, DitherMode::Gs, 3}, 255, true), 0);
    EXPECT_EQ(stored({BlendUnit::Gs, 5, DitherMode::Gs, -4}, 0, true), 31);
    // In a whole pixel: 200 + 100, at the pixel with -4.
    const FrameState psp{.unit = Ge, .format = {"8888", 8, 8, 8, 8}, .dither = DitherMode::Ge};
    const BlendState adding{BlendFactor::One, BlendFactor::One};
    EXPECT_THAT(blendInto(psp, adding, {200, 20, 0, 0}, {100, 10, 0, 7}),
                Optional(ElementsAre(255, 26, 0, 7)));
}

// PSXSPX: dithering is of the shading, before the blend.
TEST(FrameChannel, PlayStationDithersWhatEnters) {
    for (int cell = -4; cell <= 3; ++cell)
        for (int value = 0; value <= 255; ++value) {
            const FrameChannel channel{BlendUnit::Psx, 5, DitherMode::Psx, cell};
            EXPECT_EQ(enteringSource(channel, value), signedDithered(value, 5, cell) * 8);
            EXPECT_EQ(stored(channel, value), value / 8);
        }
    EXPECT_EQ(enteringSource({BlendUnit::Psx, 5}, 77), 77);
}

// Flat polygons are how masks are drawn there, and those never dither.
TEST(FrameChannel, PlayStationsMasksDontDither) {
    for (int code = 0; code < 32; ++code)
        for (const MaskOperation operation : {Double, Halve, Increment, Decrement})
            EXPECT_EQ(apply({BlendUnit::Psx, 5, DitherMode::Psx, -4}, operation, code),
                      apply({BlendUnit::Psx, 5}, operation, code));
}

TEST(FrameChannel, CountsWithSumsThatWrap) {
    for (const auto& [unit, bits, step] :
         {std::tuple(IdealRound, 5, 1), std::tuple(IdealFloor, 8, 1), std::tuple(IdealRound, 6, 1),
          std::tuple(Gs, 8, 1), std::tuple(Gs, 5, 1), std::tuple(GsWrap, 8, 1), std::tuple(Rdp, 5, 2)})
        for (int code = 0; code <= largestCode(bits); ++code) {
            const int most = largestCode(bits);
            EXPECT_EQ(once({unit, bits}, IncrementWrap, code), (code + step) & most) << name(unit);
            EXPECT_EQ(once({unit, bits}, DecrementWrap, code), (code - step) & most) << name(unit);
        }
    for (const BlendUnit unit : {VoodooMame, PowerVr, Flipper, Ge, Nv2a, ProductsRound, Virge})
        EXPECT_EQ(apply({unit, 8}, IncrementWrap, 3), std::nullopt) << name(unit);
}

// The logic operation works on codes, whatever the blend unit.
TEST(FrameChannel, InvertsBitsExactly) {
    for (const int bits : {5, 6, 8})
        for (int code = 0; code <= largestCode(bits); ++code)
            EXPECT_EQ(once({PowerVr, bits}, InvertBits, code), largestCode(bits) - code);
}

// The four settings of a PS2 pixel, over all their inputs.
TEST(GsPixel, BlendsByPabeOnlyFromHalfTheRange) {
    for (int alpha = 0; alpha <= 255; ++alpha) {
        EXPECT_TRUE(gsBlends(false, alpha));
        EXPECT_EQ(gsBlends(true, alpha), alpha > 127);
        FrameState frame{.unit = Gs, .format = {"8888", 8, 8, 8, 8}};
        frame.gs.pabe = true;
        const BlendState adding{BlendFactor::One, BlendFactor::One};
        const int red = (*blendInto(frame, adding, {10, 0, 0, alpha}, {100, 0, 0, 0}))[0];
        EXPECT_EQ(red, alpha >= 128 ? 110 : 10) << alpha;
    }
}

TEST(GsPixel, SetsTheTopBitOfAlphaByFba) {
    for (int alpha = 0; alpha <= 255; ++alpha) {
        EXPECT_EQ(gsAlpha(false, alpha), alpha);
        EXPECT_EQ(gsAlpha(true, alpha), alpha % 128 + 128);
        for (const auto& [format, expected] : {std::pair(ColourFormat{"8888", 8, 8, 8, 8}, alpha % 128 + 128),
                                               std::pair(ColourFormat{"5551", 5, 5, 5, 1}, 1),
                                               std::pair(ColourFormat{"888", 8, 8, 8, 0}, 0)}) {
            FrameState frame{.unit = Gs, .format = format};
            frame.gs.fba = true;
            EXPECT_EQ((*blendInto(frame, {}, {0, 0, 0, alpha}, {}))[3], expected) << format.name;
        }
    }
}

// Bit by bit, over all values of 8 bits and masks of every single bit, and some whole ones.
TEST(GsPixel, KeepsTheBitsOfItsMask) {
    for (const int mask : {0x00, 0x01, 0x02, 0x04, 0x08, 0x10, 0x20, 0x40, 0x80, 0x55, 0xf0, 0xff})
        for (int next = 0; next <= 255; ++next)
            for (int old = 0; old <= 255; ++old) {
                int expected = 0;
                for (int bit = 1; bit < 256; bit *= 2)
                    if ((mask & bit ? old : next) & bit) expected += bit;
                ASSERT_EQ(gsMasked(next, old, mask), expected);
            }
    // All of alpha and half of green; a 16-bit frame takes the top bits of the mask.
    FrameState frame{.unit = Gs, .format = {"8888", 8, 8, 8, 8}};
    frame.gs.mask = {0, 0x0f, 0, 0xff};
    EXPECT_THAT(blendInto(frame, {}, {1, 0xaa, 3, 4}, {9, 0x55, 9, 9}), Optional(ElementsAre(1, 0xa5, 3, 9)));
    frame.format = {"5551", 5, 5, 5, 1};
    frame.gs.mask = {0xf8, 0x08, 0x07, 0x80};
    EXPECT_THAT(blendInto(frame, {}, {255, 255, 255, 255}, {3, 0, 3, 0}),
                Optional(ElementsAre(3, 30, 31, 0)));
}

TEST(GsPixel, TestsOneBitOfAlphaByDate) {
    for (const bool datm : {false, true}) {
        const GsPixel testing{.date = true, .datm = datm}, off{.datm = datm};
        for (int alpha = 0; alpha <= 255; ++alpha) {
            EXPECT_EQ(gsDatePasses(testing, alpha, 8), (alpha >= 128) == datm) << alpha;
            EXPECT_TRUE(gsDatePasses(off, alpha, 8));
            FrameState frame{.unit = Gs, .format = {"8888", 8, 8, 8, 8}, .gs = testing};
            const Rgba codes{5, 6, 7, alpha}, source{9, 9, 9, 9};
            EXPECT_EQ(blendInto(frame, {}, source, codes), (alpha >= 128) == datm ? source : codes);
        }
        for (const int alpha : {0, 1}) EXPECT_EQ(gsDatePasses(testing, alpha, 1), (alpha == 1) == datm);
        EXPECT_TRUE(gsDatePasses(testing, 0, 0));
    }
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

}  // namespace frame_channel_test
}  // namespace gnomon
