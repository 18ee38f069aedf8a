// Plans as values: their lengths in the paper's terms, their order, and what of them the chip decides.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "plans.h"

namespace gnomon {
namespace plan_frame_test {

using testing::ElementsAre;

struct Published {
    const char* method;
    Shade shade;
    int scene, rectangles;
};
void PrintTo(const Published& p, std::ostream* out) {
    *out << p.method << " " << name(p.shade);
}

class Table1 : public testing::TestWithParam<Published> {};

// Roettger et al. 2002, Table 1; in brackets there, and -max here, with the maximum blend equation.
TEST_P(Table1, IsTheLengthOfThePlan) {
    const auto& [method, shade, scene, rectangles] = GetParam();
    EXPECT_EQ(countPasses(planOf(method, shade)),
              (PassCounts{.scene = scene, .volume = 2 * kVolumes, .rectangle = rectangles}));
}

INSTANTIATE_TEST_SUITE_P(Roettger2002, Table1,
                         testing::Values(Published{"roettger-alpha", Shade::Black, 1, 4},
                                         Published{"roettger-alpha", Shade::Ambient, 2, 4},
                                         Published{"roettger-alpha", Shade::Attenuated, 1, 4},
                                         Published{"roettger-alpha-max", Shade::Attenuated, 1, 2},
                                         Published{"roettger-screen", Shade::Black, 2, 3},
                                         Published{"roettger-screen", Shade::Ambient, 3, 3},
                                         Published{"roettger-screen", Shade::Attenuated, 2, 3},
                                         Published{"roettger-screen-max", Shade::Attenuated, 2, 1}),
                         [](const auto& test) {
                             std::string id = test.param.method + ("-" + name(test.param.shade));
                             std::replace(id.begin(), id.end(), '-', '_');
                             return id;
                         });

TEST(PlanFrame, DrawsTheUnshadowedSceneOnce) {
    EXPECT_EQ(countPasses(planOf("none")), PassCounts{.scene = 1});
}

// Section 4.3: L - 1 doublings leave 1/2 and 1, then the inverse, then one more.
TEST(PlanFrame, NormalisesLLevelsWithLPlusOneRectangles) {
    Axes axes = findMethod("roettger-screen")->axes;
    for (const Shade shade : {Shade::Black, Shade::Ambient, Shade::Attenuated})
        for (int levels = 1; levels <= 8; ++levels) {
            axes.levels = levels, axes.shade = shade;
            const Plan plan = planFrame(axes, kFrame, chip("ideal"));
            EXPECT_EQ(countPasses(plan).rectangle, levels + 1);
            EXPECT_EQ(plan.passes.front().colour.r, 1.0f / float(1 << levels)) << "where lit pixels start";
            EXPECT_EQ(plan.smallestMaskBits, levels);
        }
}

TEST(PlanFrame, CopiesAMaskTextureOnceAndAppliesItOnce) {
    for (const char* id : {"screen-texture", "roettger-half", "roettger-quarter"})
        EXPECT_EQ(countPasses(planOf(id)),
                  (PassCounts{.scene = 2, .volume = 6, .rectangle = 3 + 1, .copy = 1}))
            << id;
}

// Section 4.2: front faces of a volume, then its back faces, volume by volume.
TEST(PlanFrame, BlendsFrontsBeforeBacksOfEachVolume) {
    for (const char* id : {"roettger-alpha", "roettger-alpha-max", "roettger-screen", "screen-texture"}) {
        const auto volumes = passesOf(planOf(id), PassKind::Volume);
        ASSERT_EQ(volumes.size(), 6u);
        for (int i = 0; i < 6; ++i) {
            EXPECT_EQ(volumes[std::size_t(i)].volume, i / 2) << id;
            EXPECT_EQ(volumes[std::size_t(i)].faces, i % 2 ? Faces::Back : Faces::Front) << id;
        }
    }
}

TEST(PlanFrame, DoublesAtFrontsAndHalvesAtBacksOrTheOtherWayRound) {
    const Blend twice{.enabled = true, .source = BlendFactor::DstColor, .destination = BlendFactor::One};
    const Blend times{.enabled = true, .source = BlendFactor::DstColor, .destination = BlendFactor::Zero};
    const auto doubling = passesOf(planOf("roettger-screen"), PassKind::Volume);
    EXPECT_EQ(doubling[0].blend, twice);
    EXPECT_EQ(doubling[1].blend, times);
    const auto halving = passesOf(planOf("roettger-screen-max"), PassKind::Volume);
    EXPECT_EQ(halving[0].blend, times);
    EXPECT_EQ(halving[1].blend, twice);
}

// A decrement that clamps at 0 before its increment would lose a count.
TEST(PlanFrame, CountsUpBeforeDown) {
    const auto volumes = passesOf(planOf("heidmann", Shade::Attenuated, "tnt"), PassKind::Volume);
    ASSERT_EQ(volumes.size(), 2u);
    EXPECT_EQ(volumes[0].faces, Faces::Front);
    EXPECT_EQ(volumes[0].stencil.front.onPass, StencilOp::IncrWrap);
    EXPECT_EQ(volumes[1].faces, Faces::Back);
    EXPECT_EQ(volumes[1].stencil.front.onPass, StencilOp::DecrWrap);
}

TEST(PlanFrame, CountsAllVolumesInOnePassWithTwoSidedStencil) {
    const auto volumes = passesOf(planOf("heidmann"), PassKind::Volume);
    ASSERT_EQ(volumes.size(), 1u);
    EXPECT_EQ(volumes[0].faces, Faces::Both);
    EXPECT_EQ(volumes[0].volume, kAllVolumes);
    EXPECT_EQ(volumes[0].stencil.front.onPass, StencilOp::IncrWrap);
    EXPECT_EQ(volumes[0].stencil.back.onPass, StencilOp::DecrWrap);
}

TEST(PlanFrame, SaturatesWhereTheStencilDoesNotWrap) {
    Profile clamping = chip("ideal");
    clamping.stencilWrap = false;
    const Plan plan = planFrame(findMethod("heidmann")->axes, kFrame, clamping);
    const auto volumes = passesOf(plan, PassKind::Volume);
    // Both sides in one pass would let a clamped decrement come before its increment.
    ASSERT_EQ(volumes.size(), 2u);
    EXPECT_EQ(volumes[0].stencil.front.onPass, StencilOp::Incr);
    EXPECT_EQ(volumes[1].stencil.front.onPass, StencilOp::Decr);
}

TEST(PlanFrame, DrawsNoVolumePassWithoutVolumes) {
    for (const NamedMethod& method : namedMethods()) {
        const Plan plan = planFrame(method.axes, shapeOf(0, 64, 64), chip("ideal"));
        // ++ZP looks for the eye's own count all the same.
        EXPECT_EQ(countPasses(plan).volume, method.id == "eisemann" ? 1 : 0) << method.id;
    }
}

TEST(PlanFrame, AddsTheAmbientPartInAPassOfItsOwn) {
    for (const NamedMethod& method : namedMethods()) {
        if (method.axes.store == Store::None) continue;
        const Plan plan = planOf(method.id, Shade::Ambient);
        EXPECT_EQ(countPasses(plan).scene, countPasses(planOf(method.id, Shade::Black)).scene + 1);
        EXPECT_EQ(plan.passes.back().shading, Shading::Ambient) << method.id;
        EXPECT_TRUE(std::none_of(plan.passes.begin(), plan.passes.end(), [](const Pass& p) {
            return p.shading == Shading::Lit;
        })) << method.id;
    }
}

TEST(PlanFrame, RoundsAMasksSizeUp) {
    const Plan half = planOf("roettger-half"), quarter = planOf("roettger-quarter");
    EXPECT_EQ(half.maskWidth, 161);
    EXPECT_EQ(half.maskHeight, 121);
    EXPECT_EQ(quarter.maskWidth, 81);
    EXPECT_EQ(quarter.maskHeight, 61);
}

TEST(PlanFrame, TakesTexturesOfPowersOfTwoUnlessOthersAreAllowed) {
    const Plan tnt = planOf("roettger-half", Shade::Attenuated, "tnt");
    EXPECT_EQ(tnt.textureWidth, 256);
    EXPECT_EQ(tnt.textureHeight, 128);
    const Plan ideal = planOf("roettger-half");
    EXPECT_EQ(ideal.textureWidth, 161);
    EXPECT_EQ(ideal.textureHeight, 121);
    for (const char* id : {"voodoo1", "ps2", "tnt", "geforce2mx"})
        for (int side = 1; side < 1100; side += 73) {
            const Plan plan = planOf("screen-texture", Shade::Black, id, shapeOf(1, side, 2 * side));
            EXPECT_TRUE(std::has_single_bit(unsigned(plan.textureWidth)) && plan.textureWidth >= side &&
                        plan.textureWidth < 2 * side)
                << id << " " << side;
            EXPECT_TRUE(std::has_single_bit(unsigned(plan.textureHeight)) && plan.textureHeight >= 2 * side)
                << id << " " << side;
        }
}

TEST(PlanFrame, HasNoTextureWithoutACopy) {
    EXPECT_EQ(planOf("roettger-screen").textureWidth, 0);
    EXPECT_EQ(planOf("heidmann").textureHeight, 0);
}

// No product of two colours there; the mask's intensity becomes the alpha with which it is applied.
TEST(PlanFrame, AppliesATextureByAlphaOnlyWhereColoursDontMultiply) {
    const auto applied = [](const char* id) {
        return passesOf(planOf("screen-texture", Shade::Black, id), PassKind::Rectangle).back();
    };
    EXPECT_EQ(applied("tnt").texture, MaskTexture::Rgb);
    EXPECT_EQ(applied("tnt").blend.destination, BlendFactor::SrcColor);
    EXPECT_EQ(applied("ps2").texture, MaskTexture::Intensity);
    EXPECT_EQ(applied("ps2").blend.destination, BlendFactor::SrcAlpha);
}

// All that was counted, and nothing yet of the picture: the pass before the tap writes the mask.
TEST(PlanFrame, SaysWhereAndWhenTheMaskIsReady) {
    const auto place = [](const char* id) { return planOf(id).maskPlace(); };
    EXPECT_EQ(place("none"), MaskPlace::None);
    EXPECT_EQ(place("heidmann"), MaskPlace::Stencil);
    EXPECT_EQ(place("roettger-alpha"), MaskPlace::Alpha);
    EXPECT_EQ(place("roettger-screen"), MaskPlace::Colour);
    EXPECT_EQ(place("roettger-half"), MaskPlace::Texture);

    const Plan stencil = planOf("heidmann"), screen = planOf("roettger-screen");
    EXPECT_EQ(stencil.passes[stencil.masks.front().after - 1].kind, PassKind::Volume);
    EXPECT_EQ(screen.passes[screen.masks.front().after - 1].kind, PassKind::Rectangle);
    EXPECT_EQ(screen.passes[screen.masks.front().after].kind, PassKind::Scene);
}

// Half way between 1/2 and 1 where shadows are attenuated, else between 0 and 1.
TEST(PlanFrame, SetsTheThresholdHalfWayBetweenTheMasksValues) {
    EXPECT_EQ(planOf("roettger-screen", Shade::Attenuated).threshold, 0.75);
    EXPECT_EQ(planOf("roettger-screen", Shade::Black).threshold, 0.5);
    EXPECT_EQ(planOf("roettger-screen", Shade::Ambient).threshold, 0.5);
}

TEST(PlanFrame, MakesTheMaskAloneAtItsOwnResolution) {
    const Plan plan = planOf("roettger-half");
    bool copied = false;
    for (const Pass& pass : plan.passes) {
        copied |= pass.kind == PassKind::Copy;
        const bool draws = pass.kind != PassKind::Clear && pass.kind != PassKind::Copy;
        EXPECT_EQ(pass.target == Target::Mask, draws && !copied) << pass.label;
    }
    EXPECT_TRUE(copied);
}

TEST(DepthMap, IsOneSquareForADirectionalLightAndACubeForAPointLight) {
    for (const bool directional : {false, true}) {
        FrameShape frame = kFrame;
        frame.lights = {{.directional = directional}};
        const Plan plan = planFrame(findMethod("williams")->axes, frame, chip("ideal"));
        std::vector<int> faces;
        for (const Pass& pass : passesOf(plan, PassKind::Scene)) {
            if (pass.target != Target::DepthMap) continue;
            faces.push_back(pass.mapFace);
            EXPECT_TRUE(pass.depthTest && pass.depthWrite && !pass.write.any());
        }
        if (directional)
            EXPECT_THAT(faces, ElementsAre(0));
        else
            EXPECT_THAT(faces, ElementsAre(0, 1, 2, 3, 4, 5));
        EXPECT_EQ(countPasses(plan), (PassCounts{.scene = int(faces.size()) + 2}));
        EXPECT_EQ(plan.mapSize, kDefaultMapSize);
        EXPECT_EQ(plan.mapBias, kDefaultMapBias);
    }
}

/// The methods of the paths that lack nothing on @p chipId at 256x256, in their order.
std::vector<std::string> runnable(const std::string& chipId) {
    const Profile profile = chip(chipId);
    std::vector<std::string> ids;
    for (const Axes& axes : pathCandidates())
        if (missing(profile, planFrame(axes, shapeOf(2, 256, 256), profile)).empty())
            ids.push_back(methodId(axes));
    return ids;
}

// Issue 2: which of the paper's ways is left on each chip.
TEST(Paths, AreThoseThatTheChipsLeave) {
    EXPECT_THAT(runnable("voodoo1"), ElementsAre("roettger-screen", "screen-texture"));
    EXPECT_THAT(runnable("voodoo2"), ElementsAre("roettger-screen", "screen-texture"));
    EXPECT_THAT(runnable("voodoo3"), ElementsAre("roettger-screen", "screen-texture"));
    EXPECT_THAT(runnable("ps2"), ElementsAre("screen-texture"));
    EXPECT_THAT(runnable("tnt"),
                ElementsAre("heidmann", "roettger-alpha", "roettger-screen", "screen-texture"));
    EXPECT_THAT(runnable("geforce2mx"),
                ElementsAre("heidmann", "roettger-alpha", "roettger-screen", "screen-texture"));
    EXPECT_THAT(runnable("ideal"),
                ElementsAre("heidmann", "roettger-alpha", "roettger-screen", "screen-texture"));
}

}  // namespace plan_frame_test
}  // namespace gnomon
