// missing() foretells the capability layer: a plan lacks nothing exactly when drawing it raises nothing.
// Plans of any size are drawn on a surface of a few pixels: every call is made as on a large one, and what is
// judged are calls.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gl/capability.h"
#include "gl/renderer.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {
namespace missing_test {

constexpr int kSide = 8;

/// How @p plan ends on @p profile: the capability that a violation names, or nothing.
std::string refusedFor(Surface& surface, const Profile& profile, const Plan& plan, const Frame& frame) {
    try {
        render(surface, profile, plan, frame.surfaces, frame.lights());
    } catch (const CapabilityViolation& violation) {
        return violation.capability;
    }
    return "";
}

std::vector<std::string> keysOf(const std::vector<Missing>& missing) {
    std::vector<std::string> keys;
    for (const Missing& m : missing) keys.push_back(m.key);
    return keys;
}

void expectForetold(Surface& surface, const Profile& profile, const Plan& plan, const Frame& frame) {
    const auto keys = keysOf(missing(profile, plan));
    const std::string refused = refusedFor(surface, profile, plan, frame);
    if (keys.empty())
        EXPECT_EQ(refused, "") << "though nothing was missing";
    else
        EXPECT_THAT(keys, testing::Contains(refused)) << "not among what was missing";
}

struct Size {
    int width = 0, height = 0;
};

class EachChip : public testing::TestWithParam<std::string> {};

TEST_P(EachChip, IsRefusedExactlyThePlansThatMissSomething) {
    const Profile profile = chip(GetParam());
    TestSurface surface(bufferFormatOf(profile), kSide, kSide, arithmeticOf(profile, {}));
    const Frame frame = frameOf(twoBoxes(), kSide, kSide);
    ASSERT_EQ(frame.volumes().size(), 2u);
    int refused = 0, drawn = 0;
    for (const auto& [width, height] : {Size{kSide, kSide},
                                        {64, 64},
                                        {256, 16},
                                        {16, 480},
                                        {320, 240},
                                        {512, 512},
                                        {640, 481},
                                        {800, 600},
                                        {801, 600},
                                        {1024, 768},
                                        {2200, 1200}})
        for (const Axes& axes : allMethods()) {
            const Plan plan = planFrame(axes, shapeOf(2, width, height), profile);
            SCOPED_TRACE(testing::Message() << describe(axes) << " " << width << "x" << height);
            ++(missing(profile, plan).empty() ? drawn : refused);
            expectForetold(surface, profile, plan, frame);
        }
    EXPECT_GT(drawn, 0);
    EXPECT_EQ(refused > 0, profile.id != "ideal");
}

TEST_P(EachChip, IsRefusedExactlyThePlansWithoutVolumesThatMissSomething) {
    const Profile profile = chip(GetParam());
    TestSurface surface(bufferFormatOf(profile), kSide, kSide, arithmeticOf(profile, {}));
    Frame frame = frameOf(twoBoxes(), kSide, kSide);
    frame.light.volumes = std::make_shared<FrameVolumes>();
    for (const Axes& axes : allMethods()) {
        SCOPED_TRACE(describe(axes));
        expectForetold(surface, profile, planFrame(axes, shapeOf(0, kSide, kSide), profile), frame);
    }
}

// A surface as large as the plan, as in use.
TEST_P(EachChip, IsRefusedTheSamePlansOnSurfacesOfTheirSize) {
    const Profile profile = chip(GetParam());
    TestSurface surface(bufferFormatOf(profile), 61, 43, arithmeticOf(profile, {}));
    const Frame frame = frameOf(twoBoxes(), 61, 43);
    for (const NamedMethod& method : namedMethods())
        for (const Shade shade : {Shade::Black, Shade::Ambient, Shade::Attenuated}) {
            Axes axes = method.axes;
            axes.shade = shade;
            SCOPED_TRACE(describe(axes));
            expectForetold(surface, profile, planFrame(axes, shapeOf(2, 61, 43), profile), frame);
        }
}

// Precision is the one lack that no call shows: a mask of 8 levels runs in 5 bits, and gives wrong values.
TEST_P(EachChip, LacksBitsForDeepMasksWithoutAnyCallThatShowsIt) {
    const Profile profile = chip(GetParam());
    TestSurface surface(bufferFormatOf(profile), kSide, kSide, arithmeticOf(profile, {}));
    const Frame frame = frameOf(twoBoxes(), kSide, kSide);
    for (const int levels : {1, 5, 6, 8})
        for (const Axes& axes : allMethods(levels)) {
            SCOPED_TRACE(describe(axes));
            const Plan plan = planFrame(axes, shapeOf(2, kSide, kSide), profile);
            auto lacks = keysOf(missing(profile, plan));
            const auto bits = std::remove(lacks.begin(), lacks.end(), "colour_formats");
            const bool isDeep =
                axes.store == Store::Screen && axes.arithmetic == Arithmetic::Double && levels > 5;
            EXPECT_EQ(bits != lacks.end(),
                      (isDeep || axes.store == Store::Counter) && profile.id.starts_with("voodoo"));
            lacks.erase(bits, lacks.end());
            EXPECT_EQ(refusedFor(surface, profile, plan, frame).empty(), lacks.empty());
        }
}

INSTANTIATE_TEST_SUITE_P(Chips, EachChip,
                         testing::Values("geforce2mx", "ideal", "ps2", "tnt", "voodoo1", "voodoo2",
                                         "voodoo3"),
                         [](const auto& test) { return test.param; });

/// Chips that differ in what counts and parity in colour and alpha ask for.
std::vector<Profile> madeChips() {
    const Profile base = chip("geforce2mx");
    Profile flipper = base, noConstant = base, stencilAlpha = base, addsOnly = base;
    flipper.logicOps = true;
    flipper.alphaFunctions = {Compare::Greater, Compare::Notequal};
    noConstant.alphaFunctions = {Compare::Greater};
    for (const BlendFactor f : {BlendFactor::ConstantAlpha, BlendFactor::ConstantColor})
        noConstant.destinationFactors.erase(f);
    stencilAlpha.logicOps = true;
    stencilAlpha.blendWritesAlpha = false;
    stencilAlpha.alphaFunctions = flipper.alphaFunctions;
    addsOnly.blendEquations = {BlendEquation::Add};
    addsOnly.alphaFunctions = {Compare::Less};
    return {flipper, noConstant, stencilAlpha, addsOnly};
}

TEST(MadeChips, AreRefusedExactlyThePlansThatMissSomething) {
    int chipIndex = 0, refused = 0;
    for (const Profile& profile : madeChips()) {
        TestSurface surface(bufferFormatOf(profile), kSide, kSide, arithmeticOf(profile, {}));
        const Frame frame = frameOf(twoBoxes(), kSide, kSide);
        for (Axes axes : allMethods())
            for (const Overflow overflow : {Overflow::Either, Overflow::Saturate})
                for (const Start start : {Start::Zero, Start::Middle}) {
                    axes.overflow = overflow, axes.start = start;
                    if (contradiction(axes)) continue;
                    SCOPED_TRACE(testing::Message() << describe(axes) << " on chip " << chipIndex);
                    const Plan plan = planFrame(axes, shapeOf(2, kSide, kSide), profile);
                    refused += !missing(profile, plan).empty();
                    expectForetold(surface, profile, plan, frame);
                }
        ++chipIndex;
    }
    EXPECT_GT(refused, 100);
}

// The planner asks for what the chip has: counts and parity run on the first in every way.
TEST(MadeChips, RunCountsAndParityWhereTheyCan) {
    const auto lacks = [](const Profile& profile, const char* id, Apply apply) {
        Axes axes = findMethod(id)->axes;
        axes.apply = apply;
        return keysOf(missing(profile, planFrame(axes, shapeOf(2, kSide, kSide), profile)));
    };
    const std::vector<Profile> chips = madeChips();
    for (const char* id : {"screen-count", "alpha-count", "screen-parity"})
        for (const Apply apply : {Apply::Blend, Apply::Texture}) {
            EXPECT_THAT(lacks(chips[0], id, apply), testing::IsEmpty()) << id;
            EXPECT_THAT(lacks(chips[1], id, apply), testing::IsEmpty()) << id;
        }
    EXPECT_THAT(lacks(chips[2], "screen-count", Apply::Texture), testing::IsEmpty());
    EXPECT_THAT(lacks(chips[2], "alpha-count", Apply::Texture), testing::ElementsAre("blend_writes_alpha"));
    Axes parity = findMethod("screen-parity")->axes;
    parity.store = Store::Alpha;
    EXPECT_THAT(keysOf(missing(chips[2], planFrame(parity, shapeOf(2, kSide, kSide), chips[2]))),
                testing::ElementsAre("blend_writes_alpha"));
    EXPECT_THAT(lacks(chips[3], "screen-count", Apply::Texture), testing::ElementsAre("blend_equations"));
}

TEST(Ideal, RunsEveryMethodAtEverySize) {
    const Profile ideal = chip("ideal");
    for (const int side : {1, 321, 4096})
        for (const Axes& axes : allMethods())
            EXPECT_THAT(missing(ideal, planFrame(axes, shapeOf(3, side, side), ideal)), testing::IsEmpty())
                << describe(axes);
}

}  // namespace missing_test
}  // namespace gnomon
