// Counts in a colour or alpha buffer: their steps, what wraps and what clamps, the order of their passes, and
// how they meet the scene.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "method/count_step.h"
#include "plans.h"
#include "profile/frame_channel.h"

namespace gnomon {
namespace mask_counts_test {

using testing::ElementsAre;
using testing::HasSubstr;

/// One channel, @p bits wide, of a chip with this unit.
Profile chipOf(BlendUnit unit, int bits) {
    Profile p;
    p.blendUnits = {unit};
    p.colourFormats = {{"", bits, bits, bits, 0}};
    return p;
}

/// @p code after a step that clamps, on the chip's own blend unit.
int clampedStep(const FrameChannel& channel, const CountStep& step, bool up, int code) {
    const auto value =
        blend(channel.unit, {.source = up ? step.up : step.down,
                             .destination = readBack(channel, code),
                             .operation = up ? BlendOperation::Add : BlendOperation::ReverseSubtract});
    return stored(channel, value.value());
}

// hardware.md 4.3 for the 4 of the GameCube's 6 bits.
TEST(CountStep, IsOneCodeUpAndDownForEveryCodeWhereItClamps) {
    for (const BlendUnit unit : {BlendUnit::IdealRound, BlendUnit::ProductsFloor, BlendUnit::Flipper,
                                 BlendUnit::Ge, BlendUnit::Nv2a})
        for (const int bits : {4, 5, 6, 8}) {
            const CountStep step = countStep(chipOf(unit, bits), bits, false, false);
            EXPECT_EQ(step, (CountStep{1 << (8 - bits), 1 << (8 - bits), 1}));
            const FrameChannel channel{.unit = unit, .bits = bits};
            const int most = largestCode(bits);
            for (int code = 0; code <= most; ++code) {
                EXPECT_EQ(clampedStep(channel, step, true, code), std::min(code + 1, most))
                    << name(unit) << " " << bits << " bits, code " << code;
                EXPECT_EQ(clampedStep(channel, step, false, code), std::max(code - 1, 0))
                    << name(unit) << " " << bits << " bits, code " << code;
            }
        }
}

// Castlevania and Crash Tag Team Racing: +8 and 0xFF, modulo 32 (hardware.md 2.5).
TEST(CountStep, IsOneCodeModuloTheChannelOnAPlayStation2) {
    for (const bool doubled : {false, true}) {
        EXPECT_EQ(countStep(chipOf(BlendUnit::Gs, 5), 5, true, doubled), (CountStep{8, 255, 1}));
        EXPECT_EQ(countStep(chipOf(BlendUnit::Gs, 8), 8, true, doubled), (CountStep{1, 255, 1}));
    }
    for (const int bits : {5, 8}) {
        const CountStep step = countStep(chipOf(BlendUnit::Gs, bits), bits, true, false);
        const FrameChannel channel{.unit = BlendUnit::GsWrap, .bits = bits};
        const int values = 1 << bits;
        for (int code = 0; code < values; ++code)
            for (const auto& [source, by] : {std::pair(step.up, 1), std::pair(step.down, values - 1)}) {
                const int sum = blendGs({GsInput::Source, GsInput::Zero, 0x80, GsInput::Destination}, source,
                                        readBack(channel, code), false);
                EXPECT_EQ(stored(channel, sum), (code + by) % values) << bits << " bits, code " << code;
            }
    }
}

TEST(CountStep, IsTheSameModuloTheChannelUpAndDownOnAnN64) {
    EXPECT_EQ(countStep(chipOf(BlendUnit::Rdp, 5), 5, true, false), (CountStep{17, 248, 2}));
    EXPECT_EQ(countStep(chipOf(BlendUnit::Rdp, 8), 8, true, false), (CountStep{10, 255, 9}));
    for (const int bits : {5, 8}) {
        const CountStep step = countStep(chipOf(BlendUnit::Rdp, bits), bits, true, false);
        const FrameChannel channel{.unit = BlendUnit::Rdp, .bits = bits};
        const int values = 1 << bits;
        for (int code = 0; code < values; ++code) {
            const int value = readBack(channel, code);
            EXPECT_EQ(stored(channel, blendRdp(step.up, 31, value, 31)), (code + step.codes) % values);
            EXPECT_EQ(stored(channel, blendRdp(step.down, 31, value, 31)),
                      (code + values - step.codes) % values);
        }
    }
}

// hardware.md 4.1: 2v - 1 leaves one code at one.
TEST(CountStep, IsTwoCodesOnAGameCubeWhereItIsDoubledLater) {
    for (const int bits : {6, 8}) {
        const Profile gamecube = chipOf(BlendUnit::Flipper, bits);
        const CountStep step = countStep(gamecube, bits, false, true);
        EXPECT_EQ(step, (CountStep{2 << (8 - bits), 2 << (8 - bits), 2}));
        const FrameChannel channel{.unit = BlendUnit::Flipper, .bits = bits};
        EXPECT_EQ(apply(channel, MaskOperation::Double, 1), 1);
        for (int code = 0; code + 2 <= largestCode(bits); ++code) {
            EXPECT_EQ(clampedStep(channel, step, true, code), code + 2);
            EXPECT_EQ(clampedStep(channel, step, false, code + 2), code);
        }
    }
    EXPECT_EQ(countStep(chipOf(BlendUnit::VoodooMame, 5), 5, false, true).codes, 1);
}

// By the chip's own arithmetic: lit pixels stay at 0, one volume and more are at the largest code.
TEST(CountDoublings, TakeEveryCountButTheStartToTheLargestCode) {
    for (const BlendUnit unit :
         {BlendUnit::IdealRound, BlendUnit::ProductsFloor, BlendUnit::VoodooMame, BlendUnit::Voodoo86Box,
          BlendUnit::Gs, BlendUnit::Flipper, BlendUnit::Ge, BlendUnit::Nv2a})
        for (const int bits : {4, 5, 6, 8}) {
            const Profile p = chipOf(unit, bits);
            const int codes = countStep(p, bits, false, true).codes;
            for (int code = 0; code <= largestCode(bits); code += codes) {
                int doubled = code;
                for (int i = 0; i < countDoublings(p, bits); ++i)
                    doubled = apply({.unit = unit, .bits = bits}, MaskOperation::Double, doubled).value();
                EXPECT_EQ(doubled, code == 0 ? 0 : largestCode(bits))
                    << name(unit) << " " << bits << " bits, code " << code;
            }
        }
    EXPECT_EQ(countDoublings(chipOf(BlendUnit::IdealRound, 8), 8), 8);
    EXPECT_EQ(countDoublings(chipOf(BlendUnit::Nv2a, 5), 5), 6) << "248 is its 1 of 5 bits";
    EXPECT_EQ(countDoublings(chipOf(BlendUnit::IdealRound, 8), 0), 0) << "no channel, no crash";
}

TEST(CountWraps, WhereTheChipCanUnlessAskedOrStartedOtherwise) {
    const Axes axes = findMethod("screen-count")->axes;
    Profile both = chip("ideal");
    ASSERT_TRUE(both.blendEquations.contains(BlendEquation::AddWrap));
    EXPECT_TRUE(countWraps(axes, both));
    Axes asked = axes;
    asked.overflow = Overflow::Saturate;
    EXPECT_FALSE(countWraps(asked, both));
    Axes middle = axes;
    middle.start = Start::Middle;
    EXPECT_FALSE(countWraps(middle, both));
    both.blendEquations.erase(BlendEquation::AddWrap);
    EXPECT_FALSE(countWraps(axes, both));
    asked.overflow = Overflow::Wrap;
    EXPECT_TRUE(countWraps(asked, both));
}

TEST(CountRange, IsThatOfTheNarrowestChannel) {
    Axes screen = findMethod("screen-count")->axes, alpha = findMethod("alpha-count")->axes;
    Profile p = chip("geforce2mx");
    p.colourFormats = {{"565", 5, 6, 5, 0}};
    EXPECT_EQ(countRange(screen, p, true).largest, 31);
    EXPECT_FALSE(countRange(screen, p, true).wraps);
    EXPECT_EQ(countRange(alpha, p, true).largest, 255);
    screen.start = Start::Middle;
    EXPECT_EQ(countRange(screen, p, true).start, 16);
    Profile n64 = chipOf(BlendUnit::Rdp, 5);
    n64.blendEquations = {BlendEquation::AddWrap};
    screen.start = Start::Zero;
    EXPECT_EQ(countRange(screen, n64, false).step, 2);
    EXPECT_TRUE(countRange(screen, n64, false).wraps);
    EXPECT_EQ(countRange(findMethod("heidmann")->axes, p, false).largest, 255);
}

TEST(CountsAsShadow, IsWrongBeyondTheRangeOnly) {
    const CountRange clamps{.largest = 31}, wraps{.largest = 31, .wraps = true},
        middle{.largest = 31, .start = 16};
    for (int entries = 0; entries <= 31; ++entries)
        for (int exits = 0; exits <= entries; ++exits) {
            EXPECT_EQ(countsAsShadow(entries, exits, clamps), entries != exits);
            EXPECT_EQ(countsAsShadow(entries, exits, wraps), entries != exits);
            EXPECT_EQ(countsAsShadow(entries, exits, middle), entries <= 15 ? entries != exits : exits != 15);
        }
    EXPECT_FALSE(countsAsShadow(32, 31, clamps)) << "of 32 entries 31 are kept";
    EXPECT_TRUE(countsAsShadow(32, 31, wraps));
    EXPECT_TRUE(countsAsShadow(32, 0, clamps));
    EXPECT_FALSE(countsAsShadow(32, 0, wraps));
}

TEST(CountsAsShadow, RunsOutSoonerWithLargerSteps) {
    const CountRange n64{.largest = 31, .step = 2, .wraps = true}, gamecube{.largest = 63, .step = 2};
    EXPECT_TRUE(countsAsShadow(15, 0, n64));
    EXPECT_FALSE(countsAsShadow(16, 0, n64)) << "16 levels";
    EXPECT_TRUE(countsAsShadow(17, 0, n64));
    EXPECT_TRUE(countsAsShadow(31, 30, gamecube));
    EXPECT_FALSE(countsAsShadow(33, 32, gamecube)) << "63 less 64";
    // Nine codes visit all of 256.
    const CountRange n64of8{.largest = 255, .step = 9, .wraps = true};
    for (int net = 1; net < 256; ++net) EXPECT_TRUE(countsAsShadow(net, 0, n64of8)) << net;
    EXPECT_FALSE(countsAsShadow(256, 0, n64of8));
}

/// The named count with another option.
Axes counting(const char* id, Apply apply, Overflow overflow = Overflow::Either, Start start = Start::Zero) {
    Axes axes = findMethod(id)->axes;
    axes.apply = apply, axes.overflow = overflow, axes.start = start;
    return axes;
}

TEST(MaskCount, CountsAllVolumesInTwoPassesWhateverTheirNumber) {
    for (const Overflow overflow : {Overflow::Wrap, Overflow::Saturate})
        for (const int volumes : {1, 7}) {
            const Plan plan = planFrame(counting("screen-count", Apply::Texture, overflow),
                                        shapeOf(volumes, 64, 48), chip("ideal"));
            const auto passes = passesOf(plan, PassKind::Volume);
            ASSERT_EQ(passes.size(), 2u);
            for (const Pass& pass : passes) EXPECT_EQ(pass.volume, kAllVolumes);
            EXPECT_EQ(passes[0].faces, Faces::Front) << "entries first: a difference clamps at 0";
            EXPECT_EQ(passes[1].faces, Faces::Back);
        }
}

TEST(MaskCount, TakesAwayByADifferenceOrByASumThatWraps) {
    const auto passes = [](Overflow overflow) {
        return passesOf(planFrame(counting("screen-count", Apply::Texture, overflow), kFrame, chip("ideal")),
                        PassKind::Volume);
    };
    const Blend sum{.enabled = true, .source = BlendFactor::One, .destination = BlendFactor::One};
    Blend difference = sum, wrapping = sum;
    difference.equation = BlendEquation::ReverseSubtract, wrapping.equation = BlendEquation::AddWrap;
    const auto clamps = passes(Overflow::Saturate), wraps = passes(Overflow::Wrap);
    EXPECT_EQ(clamps[0].blend, sum);
    EXPECT_EQ(clamps[1].blend, difference);
    EXPECT_EQ(clamps[0].colour, glm::vec4(1.0f / 255));
    EXPECT_EQ(clamps[1].colour, glm::vec4(1.0f / 255));
    EXPECT_EQ(wraps[0].blend, wrapping);
    EXPECT_EQ(wraps[1].blend, wrapping);
    EXPECT_EQ(wraps[0].colour, glm::vec4(1.0f / 255));
    EXPECT_EQ(wraps[1].colour, glm::vec4(1));
    EXPECT_THAT(clamps[0].label, HasSubstr("a sum that clamps, so before all others"));
    EXPECT_THAT(clamps[1].label, HasSubstr("a difference that clamps"));
    EXPECT_THAT(wraps[1].label, HasSubstr("a sum that wraps, in any order"));
}

TEST(MaskCount, StepsEachChannelByItsOwnCode) {
    Profile p = chip("geforce2mx");
    p.colourFormats = {{"565", 5, 6, 5, 0}};
    p.alphaBits = 6;
    const Pass up =
        passesOf(planFrame(counting("screen-count", Apply::Blend), kFrame, p), PassKind::Volume).front();
    EXPECT_EQ(up.colour, glm::vec4(8, 4, 8, 4) / 255.0f);
    EXPECT_EQ(up.write, kWriteColour);
    EXPECT_THAT(describeState(up), HasSubstr("colour 0.0314 0.0157 0.0314"));
}

TEST(MaskCount, BehindTheSurfaceCountsBacksUpBeforeAnyFrontDown) {
    Axes axes = counting("alpha-count", Apply::Blend, Overflow::Saturate);
    axes.count = Count::Zfail;
    const auto passes = passesOf(planFrame(axes, kFrame, chip("ideal")), PassKind::Volume);
    ASSERT_EQ(passes.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(passes[i].faces, i < 2 ? Faces::Back : Faces::Front) << i;
        EXPECT_EQ(passes[i].blend.equation, i < 2 ? BlendEquation::Add : BlendEquation::ReverseSubtract);
        EXPECT_EQ(passes[i].depthFunction, i % 2 == 0 ? Compare::Greater : Compare::Gequal) << i;
        EXPECT_EQ(passes[i].parts.has(Part::LightCap), i % 2 == 1) << i;
        EXPECT_EQ(passes[i].write, kWriteAlpha);
    }
}

// hardware.md, section 1: all, and the nearer ones taken back; still all steps up before all steps down.
TEST(MaskCount, BehindTheSurfaceTakesTheNearerBackWhereNoFartherFragmentPasses) {
    Profile p = chip("ideal");
    p.depthFunctions = {Compare::Never, Compare::Less, Compare::Lequal, Compare::Always};
    Axes axes = counting("screen-count", Apply::Texture, Overflow::Saturate);
    axes.count = Count::Zfail;
    std::vector<std::string> steps;
    for (const Pass& pass : passesOf(planFrame(axes, kFrame, p), PassKind::Volume))
        steps.push_back(std::string(pass.blend.equation == BlendEquation::Add ? "+" : "-") +
                        (pass.faces == Faces::Back ? " back " : " front ") +
                        (pass.parts.has(Part::LightCap) ? "cap " : "open ") + name(pass.depthFunction));
    EXPECT_THAT(steps, ElementsAre("+ back open always", "+ back cap always", "+ front open lequal",
                                   "+ front cap less", "- front open always", "- front cap always",
                                   "- back open lequal", "- back cap less"));
}

TEST(MaskCount, IsRefusedAChipThatCanNeitherSubtractNorWrap) {
    const Profile tnt = chip("tnt");
    for (const char* id : {"screen-count", "alpha-count"}) {
        const auto lacks = missing(tnt, planFrame(counting(id, Apply::Blend), shapeOf(2, 256, 256), tnt));
        ASSERT_EQ(lacks.size(), 1u) << id;
        EXPECT_EQ(lacks[0].what, "blend equation reverse_subtract");
    }
    const Axes wrap = counting("screen-count", Apply::Blend, Overflow::Wrap);
    EXPECT_EQ(missing(tnt, planFrame(wrap, shapeOf(2, 256, 256), tnt)).front().what,
              "blend equation add_wrap");
}

TEST(MaskCount, IsRefusedAChannelOfOneBit) {
    Profile p = chip("ideal");
    p.alphaBits = 1;
    const auto lacks = missing(p, planFrame(counting("alpha-count", Apply::Blend), kFrame, p));
    ASSERT_EQ(lacks.size(), 1u);
    EXPECT_EQ(lacks[0].what, "2 bits per channel of the mask (1 at most)");
}

/// Labels of the rectangles, in order.
std::vector<std::string> rectanglesOf(const Plan& plan) {
    std::vector<std::string> labels;
    for (const Pass& pass : passesOf(plan, PassKind::Rectangle))
        labels.push_back(pass.label.substr(0, pass.label.find(':')));
    return labels;
}

// Where doubling is exact one code is at the largest in as many steps as the widest channel has bits.
TEST(MaskCount, IsBlendedOnceItIsDoubledToOneOrZero) {
    Profile p = chip("geforce2mx");
    p.colourFormats = {{"565", 5, 6, 5, 0}};
    p.blendUnits = {BlendUnit::IdealRound};
    Axes axes = counting("screen-count", Apply::Blend);
    EXPECT_THAT(rectanglesOf(planFrame(axes, kFrame, p)),
                ElementsAre("double", "double", "double", "double", "double", "double", "invert", "add 1/2"));
    axes.start = Start::Middle, axes.shade = Shade::Black;
    EXPECT_THAT(rectanglesOf(planFrame(axes, kFrame, p)),
                ElementsAre("take the start away", "double", "double", "double", "double", "double", "double",
                            "invert"));
    EXPECT_EQ(planFrame(axes, kFrame, p).passes.front().colour.r, 128.0f / 255);
    p.blendUnits = {BlendUnit::Nv2a};
    EXPECT_EQ(rectanglesOf(planFrame(axes, kFrame, p)).size(), 1u + 7u + 1u) << "its 1 of 6 bits is 252";
}

// A GameCube has no constant factor: under a texture of intensities the count must be doubled.
TEST(MaskCount, StepsByTwoCodesWhereOneWouldNotDouble) {
    Profile gamecube = chip("ideal");
    gamecube.blendUnits = {BlendUnit::Flipper};
    gamecube.colourFormats = {{"6666", 6, 6, 6, 6}};
    gamecube.alphaBits = 6;
    gamecube.blendEquations = {BlendEquation::Add, BlendEquation::ReverseSubtract};
    const auto step = [&](const char* id) {
        const Plan plan = planFrame(counting(id, Apply::Texture), kFrame, gamecube);
        return passesOf(plan, PassKind::Volume).front().colour.a * 255;
    };
    EXPECT_EQ(step("screen-count"), 4);
    EXPECT_EQ(step("alpha-count"), 4);
    for (const BlendFactor f : {BlendFactor::ConstantAlpha, BlendFactor::ConstantColor})
        gamecube.destinationFactors.erase(f);
    EXPECT_EQ(step("screen-count"), 8);
    EXPECT_EQ(step("alpha-count"), 4) << "an alpha test tells it apart";
}

TEST(MaskCount, GoesOverTheSceneByAnAlphaTestOfItsTexture) {
    for (const char* id : {"screen-count", "alpha-count"})
        for (const Shade shade : {Shade::Black, Shade::Attenuated}) {
            Axes axes = counting(id, Apply::Texture);
            axes.shade = shade;
            const Plan plan = planFrame(axes, kFrame, chip("ideal"));
            const auto rectangles = passesOf(plan, PassKind::Rectangle);
            ASSERT_EQ(rectangles.size(), 1u) << "nothing is doubled";
            EXPECT_EQ(rectangles[0].alphaTest, (AlphaTest{true, Compare::Notequal, 0}));
            EXPECT_EQ(plan.masks.front().alphaTest, rectangles[0].alphaTest);
            EXPECT_EQ(rectangles[0].texture,
                      axes.store == Store::Alpha ? MaskTexture::Alpha : MaskTexture::Intensity);
            EXPECT_TRUE(passesOf(plan, PassKind::Copy).front().nearest) << "between two counts lies no third";
        }
}

// A texture of intensities takes the place of the rectangle's colour: the factor is a constant.
TEST(MaskCount, AttenuatesByAConstantFactorUnderATextureOfIntensities) {
    const auto blendOf = [](const char* id, Shade shade, const Profile& p) {
        Axes axes = counting(id, Apply::Texture);
        axes.shade = shade;
        return passesOf(planFrame(axes, kFrame, p), PassKind::Rectangle).back().blend;
    };
    const float half = 128.0f / 255;
    Profile p = chip("ideal");
    using enum BlendFactor;
    EXPECT_EQ(blendOf("screen-count", Shade::Attenuated, p),
              (Blend{.enabled = true, .source = Zero, .destination = ConstantAlpha, .constant = half}));
    EXPECT_EQ(blendOf("screen-count", Shade::Black, p),
              (Blend{.enabled = true, .source = Zero, .destination = Zero}));
    EXPECT_EQ(blendOf("alpha-count", Shade::Attenuated, p),
              (Blend{.enabled = true, .source = Zero, .destination = SrcColor}));
    EXPECT_EQ(blendOf("alpha-count", Shade::Black, p), Blend{});
    p.destinationFactors.erase(ConstantAlpha);
    EXPECT_EQ(blendOf("screen-count", Shade::Attenuated, p).destination, ConstantColor);
}

TEST(MaskCount, IsNormalisedInItsTextureWhereNoAlphaTestOrConstantTellsItApart) {
    Profile noTest = chip("ideal"), noConstant = noTest, greater = noTest;
    noTest.alphaFunctions = {Compare::Less};
    noConstant.destinationFactors.erase(BlendFactor::ConstantAlpha);
    noConstant.destinationFactors.erase(BlendFactor::ConstantColor);
    greater.alphaFunctions = {Compare::Greater};
    const Axes axes = counting("screen-count", Apply::Texture);
    for (const Profile& p : {noTest, noConstant}) {
        const Plan plan = planFrame(axes, kFrame, p);
        EXPECT_EQ(passesOf(plan, PassKind::Rectangle).size(), 8u + 1u + 1u + 1u);
        EXPECT_FALSE(plan.masks.front().alphaTest.enabled);
        EXPECT_EQ(passesOf(plan, PassKind::Copy).front().texture, MaskTexture::Rgb);
        EXPECT_FALSE(passesOf(plan, PassKind::Copy).front().nearest);
    }
    EXPECT_EQ(planFrame(axes, kFrame, greater).masks.front().alphaTest,
              (AlphaTest{true, Compare::Greater, 0}));
}

// 128 is code 16 of 5 bits, which reads back as 128 or 132; one step more as 136 or 140.
TEST(MaskCount, FromTheMiddleIsToldApartBetweenTheStartAndAStepMore) {
    for (const int bits : {4, 5, 6, 8}) {
        Profile p = chip("ideal");
        p.colourFormats = {{"", bits, bits, bits, 0}};
        const Axes axes = counting("screen-count", Apply::Texture, Overflow::Saturate, Start::Middle);
        const AlphaTest test = planFrame(axes, kFrame, p).masks.front().alphaTest;
        EXPECT_EQ(test.function, Compare::Greater);
        const int start = truncated(128, bits);
        for (const auto& read : {replicated, shifted}) {
            EXPECT_FALSE(passes(test.function, float(read(start, bits)) / 255, test.reference)) << bits;
            EXPECT_TRUE(passes(test.function, float(read(start + 1, bits)) / 255, test.reference)) << bits;
        }
    }
}

TEST(MaskCount, StartsAnewForEachLight) {
    const FrameShape two{.width = 64, .height = 64, .lights = {{.volumes = 2}, {.volumes = 3}}};
    for (const char* id : {"screen-count", "alpha-count"})
        for (const Apply apply : {Apply::Blend, Apply::Texture}) {
            const Plan plan = planFrame(counting(id, apply), two, chip("ideal"));
            EXPECT_EQ(countPasses(plan).volume, 4) << id;
            ASSERT_EQ(plan.masks.size(), 2u);
            EXPECT_EQ(plan.masks[0].alphaTest.enabled, apply == Apply::Texture);
            EXPECT_EQ(plan.masks[1].alphaTest, plan.masks[0].alphaTest);
        }
}

}  // namespace mask_counts_test
}  // namespace gnomon
