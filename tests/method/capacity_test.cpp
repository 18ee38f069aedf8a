// How deep volumes may nest before a count fails, held to the counts' own arithmetic.

#include "method/capacity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "method/count_step.h"
#include "plans.h"
#include "profile/frame_channel.h"

namespace gnomon {
namespace capacity_test {

using Of = Capacity::Of;

Capacity capacityOf(const Axes& axes, const std::string& chipId = "ideal") {
    return capacity(axes, chip(chipId), false);
}
Capacity capacityOf(const std::string& method, const std::string& chipId = "ideal") {
    return capacityOf(findMethod(method)->axes, chipId);
}

TEST(Capacity, OfACountIsWhereItsRangeEnds) {
    const Profile ideal = chip("ideal");
    for (const Store store : {Store::Stencil, Store::Alpha, Store::Screen})
        for (const Overflow overflow : {Overflow::Wrap, Overflow::Saturate})
            for (const Start start : {Start::Zero, Start::Middle}) {
                const Axes axes{.store = store, .start = start, .overflow = overflow};
                const Capacity c = capacity(axes, ideal, false);
                const CountRange range = countRange(axes, ideal, false);
                EXPECT_EQ(c.of, range.wraps ? Of::Overlap : Of::Fronts) << c.phrase;
                // A count that clamps must tell all entries and exits apart, one that wraps what is left of
                // them.
                for (int exits = 0; exits <= c.most; ++exits)
                    EXPECT_EQ(countsAsShadow(c.most, exits, range), exits < c.most) << c.phrase;
                EXPECT_FALSE(countsAsShadow(c.most + 1, range.wraps ? 0 : c.most, range)) << c.phrase;
            }
}

TEST(Capacity, OfAStencilIs255ByItsBits) {
    Axes heidmann = findMethod("heidmann")->axes;
    heidmann.overflow = Overflow::Saturate;
    EXPECT_EQ(capacityOf(heidmann).most, 255);
    EXPECT_EQ(capacityOf(heidmann).of, Of::Fronts);
    heidmann.overflow = Overflow::Wrap;
    EXPECT_EQ(capacityOf(heidmann).most, 255);
    EXPECT_EQ(capacityOf(heidmann).of, Of::Overlap);
}

// The N64 counts in steps of two codes in 5 bits (hardware.md 4.3): 16 of them are none.
TEST(Capacity, OfACountThatWrapsFollowsItsStep) {
    Profile n64;
    n64.blendUnits = {BlendUnit::Rdp};
    n64.blendEquations = {BlendEquation::AddWrap};
    n64.colourFormats = {{"", 5, 5, 5, 0}};
    const Axes screen{.store = Store::Screen};
    EXPECT_EQ(capacity(screen, n64, false).most, 15);
    EXPECT_EQ(capacity(screen, n64, false).of, Of::Overlap);
}

TEST(Capacity, OfACounterIs16Bits) {
    EXPECT_EQ(capacityOf("counter").most, 65535);
    EXPECT_EQ(capacityOf("counter").of, Of::Overlap);
}

TEST(Capacity, OfDoublingIsItsLevels) {
    Axes axes = findMethod("roettger-screen")->axes;
    for (const int levels : {1, 2, 5}) {
        axes.levels = levels;
        EXPECT_EQ(capacityOf(axes).most, levels);
        EXPECT_EQ(capacityOf(axes).of, Of::Levels);
    }
}

/// Whether a pixel that enters so many volumes is lit again once it has left all of them, and not before.
bool halvesReversibly(int entries, int bits) {
    const FrameChannel channel{.bits = bits};
    int code = largestCode(bits);
    for (int i = 0; i < entries; ++i) code = apply(channel, MaskOperation::Halve, code).value();
    for (int exits = 0; exits <= entries; ++exits) {
        const bool isShadow = 2 * code <= largestCode(bits) + 1;
        if (isShadow != (exits < entries)) return false;
        code = apply(channel, MaskOperation::Double, code).value();
    }
    return true;
}

TEST(Capacity, OfHalvingIsTheBitsOfItsChannel) {
    for (const char* id : {"ideal", "voodoo2"}) {
        const Capacity c = capacityOf("roettger-screen-max", id);
        EXPECT_EQ(c.most, id == std::string("ideal") ? 8 : 5);
        for (int entries = 1; entries <= c.most; ++entries)
            EXPECT_TRUE(halvesReversibly(entries, c.most)) << id << " " << entries;
        EXPECT_FALSE(halvesReversibly(c.most + 1, c.most)) << id;
        EXPECT_EQ(c.of, Of::Levels);
    }
}

TEST(Capacity, OfParityIsOneVolumeWhereAStencilDoesNotKeepThemApart) {
    EXPECT_EQ(capacityOf("parity").of, Of::Nothing);
    const Axes screen{.store = Store::Screen, .arithmetic = Arithmetic::Parity};
    EXPECT_EQ(capacityOf(screen).of, Of::Overlap);
    EXPECT_EQ(capacityOf(screen).most, 1);
}

TEST(Capacity, OfWhatCountsNothingHasNoLimit) {
    for (const char* id : {"none", "williams"}) EXPECT_EQ(capacityOf(id).of, Of::Nothing) << id;
}

TEST(CountedFrom, IsInfinityForZfail) {
    EXPECT_EQ(countedFrom(findMethod("carmack")->axes), CountedFrom::Infinity);
    EXPECT_EQ(countedFrom(findMethod("heidmann")->axes), CountedFrom::Eye);
}

TEST(NestingWarning, NamesCapacityAndBound) {
    const Nesting deep{.fronts = 300, .overlap = 5, .levels = 7};
    EXPECT_EQ(nestingWarning(capacityOf("roettger-screen"), deep),
              "resolves 2 levels; up to 7 volumes or fronts may nest");
    EXPECT_EQ(nestingWarning(capacityOf({.store = Store::Screen, .arithmetic = Arithmetic::Parity}), deep),
              "tells one volume from none; up to 5 volumes may overlap");
    Axes saturating = findMethod("heidmann")->axes;
    saturating.overflow = Overflow::Saturate;
    EXPECT_EQ(nestingWarning(capacityOf(saturating), deep),
              "counts 255 in the stencil and saturates; up to 300 fronts may lie on an eye ray");
}

TEST(NestingWarning, IsNotThereUpToTheCapacity) {
    EXPECT_EQ(nestingWarning(capacityOf("roettger-screen"), {.fronts = 9, .overlap = 9, .levels = 2}),
              std::nullopt);
    EXPECT_EQ(nestingWarning(capacityOf("none"), {.fronts = 9, .overlap = 9, .levels = 9}), std::nullopt);
}

}  // namespace capacity_test
}  // namespace gnomon
