// Plans by way of counting: where faces are counted, from what, and what happens at the limit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "plans.h"

namespace gnomon {
namespace plan_counts_test {

using testing::ElementsAre;

// Faces behind the surface, counted from infinity: back faces go in, front faces out. The far cap lies at
// depth 1 and must fail there (LEQUAL); a light cap has its surface's depth and must fail there too (LESS).
TEST(ZfailInAStencil, CountsSidesAndThenLightCapsWhereDepthFails) {
    const auto volumes = passesOf(planOf("carmack"), PassKind::Volume);
    ASSERT_EQ(volumes.size(), 2u);
    for (const Pass& pass : volumes) {
        EXPECT_EQ(pass.faces, Faces::Both);
        EXPECT_EQ(pass.stencil.front, (StencilSide{.onDepthFail = StencilOp::DecrWrap}));
        EXPECT_EQ(pass.stencil.back, (StencilSide{.onDepthFail = StencilOp::IncrWrap}));
        EXPECT_FALSE(pass.write.any());
        EXPECT_TRUE(pass.depthTest && !pass.depthWrite);
    }
    EXPECT_EQ(volumes[0].parts, Part::Sides | Part::FarCap);
    EXPECT_EQ(volumes[0].depthFunction, Compare::Lequal);
    EXPECT_EQ(volumes[1].parts, Parts(Part::LightCap));
    EXPECT_EQ(volumes[1].depthFunction, Compare::Less);
}

TEST(ZfailInAStencil, CountsAllUpBeforeAnyDownWithoutTwoSides) {
    const auto volumes = passesOf(planOf("carmack", Shade::Attenuated, "tnt"), PassKind::Volume);
    ASSERT_EQ(volumes.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        const StencilSide side{.onDepthFail = i < 2 ? StencilOp::IncrWrap : StencilOp::DecrWrap};
        EXPECT_EQ(volumes[i].faces, i < 2 ? Faces::Back : Faces::Front) << i;
        EXPECT_EQ(volumes[i].stencil.front, side) << i;
        EXPECT_EQ(volumes[i].stencil.back, side) << i;
        EXPECT_EQ(volumes[i].depthFunction, i % 2 == 0 ? Compare::Lequal : Compare::Less) << i;
    }
}

TEST(ZfailByBlending, DoublesAtBacksAndHalvesAtFrontsBehindTheSurface) {
    for (const char* id : {"alpha-zfail", "screen-zfail"}) {
        const auto volumes = passesOf(planOf(id), PassKind::Volume);
        ASSERT_EQ(volumes.size(), 4u * kVolumes);
        for (std::size_t i = 0; i < volumes.size(); ++i) {
            const bool enters = i % 4 < 2, cap = i % 2 == 1;
            EXPECT_EQ(volumes[i].volume, int(i / 4)) << id << i;
            EXPECT_EQ(volumes[i].faces, enters ? Faces::Back : Faces::Front) << id << i;
            EXPECT_EQ(volumes[i].blend.destination, enters ? BlendFactor::One : BlendFactor::Zero) << id << i;
            EXPECT_EQ(volumes[i].depthFunction, cap ? Compare::Gequal : Compare::Greater) << id << i;
            EXPECT_EQ(volumes[i].parts, cap ? Parts(Part::LightCap) : Part::Sides | Part::FarCap) << id << i;
            EXPECT_EQ(volumes[i].write, id[0] == 'a' ? kWriteAlpha : kWriteColour);
        }
    }
}

// hardware.md, section 1: a PlayStation 2 passes never, all, or nearer; farther is all and then the nearer
// ones taken back.
TEST(ZfailByBlending, CountsAllAndTakesTheNearerBackWhereNoFartherFragmentPasses) {
    Axes axes = findMethod("screen-zfail")->axes;
    axes.apply = Apply::Texture;
    const Profile ps2 = chip("ps2");
    const Plan plan = planFrame(axes, shapeOf(1, 256, 256), ps2);
    EXPECT_THAT(missing(ps2, plan), testing::IsEmpty());
    const auto volumes = passesOf(plan, PassKind::Volume);
    ASSERT_EQ(volumes.size(), 8u);
    const BlendFactor up = BlendFactor::One, down = BlendFactor::Zero;
    const std::array<BlendFactor, 8> steps{up, down, up, down, down, up, down, up};
    const std::array<Compare, 4> tests{Compare::Always, Compare::Lequal, Compare::Always, Compare::Less};
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(volumes[i].faces, i < 4 ? Faces::Back : Faces::Front) << i;
        EXPECT_EQ(volumes[i].blend.destination, steps[i]) << i;
        EXPECT_EQ(volumes[i].depthFunction, tests[i % 4]) << i;
        EXPECT_EQ(volumes[i].parts.has(Part::LightCap), i % 4 >= 2) << i;
    }
}

TEST(Parity, FoldsEachVolumeIntoTheNextBitAndStartsAnew) {
    const Plan plan = planOf("parity");
    EXPECT_EQ(countPasses(plan), (PassCounts{.scene = 1, .volume = kVolumes, .rectangle = kVolumes + 1}));
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const Pass& pass = plan.passes[i];
        if (pass.kind != PassKind::Volume) continue;
        EXPECT_EQ(pass.stencil.front, (StencilSide{.onPass = StencilOp::Invert}));
        EXPECT_EQ(pass.stencil.front, pass.stencil.back);
        EXPECT_EQ(pass.stencil.writeMask, 1u);
        EXPECT_EQ(pass.faces, Faces::Both);
        const Pass &fold = plan.passes.at(i + 1), &anew = plan.passes.at(i + 2);
        EXPECT_EQ(fold.kind, PassKind::Rectangle);
        EXPECT_EQ(fold.stencil.front.onPass, StencilOp::Replace);
        EXPECT_EQ(fold.stencil.readMask, 1u);
        EXPECT_EQ(fold.stencil.writeMask, 2u);
        EXPECT_EQ(fold.stencil.function, Compare::Equal);
        EXPECT_EQ(unsigned(fold.stencil.reference) & 3u, 3u) << "compared with bit 0, replaces bit 1";
        EXPECT_TRUE(anew.clearsStencil);
        EXPECT_EQ(anew.stencil.writeMask, 1u);
        EXPECT_FALSE(anew.write.any() || anew.clearsDepth);
    }
}

TEST(Parity, NeedsNoFoldForOneVolume) {
    const Plan plan = planOf("parity", Shade::Attenuated, "tnt", shapeOf(1, 64, 48));
    EXPECT_EQ(countPasses(plan), (PassCounts{.scene = 1, .volume = 1, .rectangle = 1}));
}

TEST(Parity, BehindTheSurfaceInvertsWhereDepthFails) {
    Axes axes = findMethod("parity")->axes;
    axes.count = Count::Zfail;
    const auto volumes = passesOf(planFrame(axes, shapeOf(1, 64, 48), chip("tnt")), PassKind::Volume);
    ASSERT_EQ(volumes.size(), 2u);
    for (const Pass& pass : volumes)
        EXPECT_EQ(pass.stencil.front, (StencilSide{.onDepthFail = StencilOp::Invert}));
    EXPECT_EQ(volumes[0].depthFunction, Compare::Lequal);
    EXPECT_EQ(volumes[1].depthFunction, Compare::Less);
}

TEST(Parity, InvertsAColourOncePerFace) {
    const Axes axes{
        .store = Store::Screen, .arithmetic = Arithmetic::Parity, .levels = 0, .shade = Shade::Black};
    for (const bool logicOps : {false, true}) {
        Profile profile = chip("ideal");
        profile.logicOps = logicOps;
        const Plan plan = planFrame(axes, kFrame, profile);
        EXPECT_EQ(countPasses(plan), (PassCounts{.scene = 2, .volume = 1}));
        const Pass volumes = passesOf(plan, PassKind::Volume).front();
        EXPECT_EQ(volumes.logicInvert, logicOps) << "exact on every chip";
        EXPECT_EQ(volumes.blend, logicOps ? Blend{}
                                          : (Blend{.enabled = true,
                                                   .source = BlendFactor::OneMinusDstColor,
                                                   .destination = BlendFactor::Zero}));
        EXPECT_THAT(volumes.label,
                    testing::HasSubstr(logicOps ? "invert by logic operation" : "invert by blending"));
        EXPECT_EQ(volumes.colour, glm::vec4(1));
        EXPECT_EQ(volumes.write, kWriteColour);
        EXPECT_EQ(plan.passes.front().colour.r, 1) << "lit pixels start at 1";
    }
}

TEST(ZpPlus, CountsNearCapsFirstWithoutADepthTest) {
    for (const char* id : {"ideal", "tnt"}) {
        const auto volumes = passesOf(planOf("hornus", Shade::Attenuated, id), PassKind::Volume);
        ASSERT_EQ(volumes.size(), id == std::string("tnt") ? 3u : 2u);
        EXPECT_EQ(volumes[0].parts, Parts(Part::NearCap));
        EXPECT_FALSE(volumes[0].depthTest || volumes[0].depthWrite);
        EXPECT_EQ(volumes[0].faces, Faces::Both);
        EXPECT_EQ(volumes[0].stencil.front, (StencilSide{.onPass = StencilOp::IncrWrap}));
        EXPECT_EQ(volumes[0].stencil.back, volumes[0].stencil.front);
        for (std::size_t i = 1; i < volumes.size(); ++i) {
            EXPECT_EQ(volumes[i].parts, Part::Sides | Part::FarCap);
            EXPECT_EQ(volumes[i].depthFunction, Compare::Lequal);
        }
    }
}

TEST(PlusPlusZp, CountsBlockersInOnePixelAndStartsAllOthersThere) {
    const Plan plan = planOf("eisemann");
    const auto isBlockers = [](const Pass& pass) { return pass.drawn == Drawn::Blockers; };
    const auto at = std::find_if(plan.passes.begin(), plan.passes.end(), isBlockers);
    ASSERT_NE(at, plan.passes.end());
    EXPECT_EQ(std::count_if(plan.passes.begin(), plan.passes.end(), isBlockers), 1);
    EXPECT_EQ(at->target, Target::OnePixel);
    EXPECT_FALSE(at->depthTest || at->depthWrite || at->write.any());
    EXPECT_EQ(at->stencil.front, (StencilSide{.onPass = StencilOp::IncrWrap}));
    const Pass &start = at[1], &faces = at[2];
    EXPECT_EQ(start.kind, PassKind::Clear);
    EXPECT_TRUE(start.clearsStencil && start.stencilIsBlockers);
    EXPECT_FALSE(start.clearsDepth || start.write.any());
    EXPECT_EQ(faces.parts, Part::Sides | Part::FarCap | Part::NearFaces);
}

TEST(PlusPlusZp, ClampsDepthWhereTheChipDoesAndLeavesItToTheHostElsewhere) {
    const auto clamps = [](const Plan& plan) {
        return std::any_of(plan.passes.begin(), plan.passes.end(),
                           [](const Pass& pass) { return pass.depthClamp; });
    };
    EXPECT_TRUE(clamps(planOf("eisemann")));
    EXPECT_FALSE(clamps(planOf("eisemann", Shade::Attenuated, "tnt")));
    EXPECT_FALSE(clamps(planOf("carmack")));
    Axes whole = findMethod("eisemann")->axes;
    EXPECT_FALSE(cutStyleOf(whole, true).flatten);
    EXPECT_TRUE(cutStyleOf(whole, false).flatten);
    whole.clip = Clip::None;
    EXPECT_TRUE(clamps(planFrame(whole, kFrame, chip("tnt")))) << "the host leaves sides whole";
}

TEST(AtomicZp, ComparesWithWhatTheShaderCounted) {
    const Plan plan = planOf("atomiczp");
    EXPECT_EQ(countPasses(plan), (PassCounts{.scene = 1, .volume = 1, .rectangle = 1}));
    const Pass volumes = passesOf(plan, PassKind::Volume).front();
    EXPECT_EQ(volumes.drawn, Drawn::Silhouettes);
    EXPECT_TRUE(volumes.depthClamp);
    EXPECT_EQ(volumes.stencil.front, (StencilSide{.onPass = StencilOp::IncrWrap}));
    EXPECT_EQ(volumes.stencil.back, (StencilSide{.onPass = StencilOp::DecrWrap}));
    ASSERT_EQ(plan.masks.size(), 1u);
    EXPECT_TRUE(plan.masks.front().test.minusBlockers);
    EXPECT_TRUE(passesOf(plan, PassKind::Rectangle).front().stencil.minusBlockers);
    EXPECT_FALSE(planOf("heidmann").masks.front().test.minusBlockers);
}

TEST(CounterStore, CountsBackFacesUpBehindTheSurfaceAndShadesByTheCount) {
    const Plan plan = planOf("counter");
    EXPECT_EQ(countPasses(plan), (PassCounts{.scene = 2, .volume = 2}));
    EXPECT_EQ(plan.passes.front().colour.r, 0) << "the count starts at 0";
    const auto volumes = passesOf(plan, PassKind::Volume);
    for (const Pass& pass : volumes) {
        EXPECT_EQ(pass.program, Program::CountFaces);
        EXPECT_EQ(pass.frontCount, -1);
        EXPECT_FALSE(pass.blend.enabled || pass.stencil.enabled);
    }
    EXPECT_EQ(volumes[0].depthFunction, Compare::Greater);
    EXPECT_EQ(volumes[1].depthFunction, Compare::Gequal);
    EXPECT_EQ(plan.passes.back().program, Program::ShadeCount);
    EXPECT_EQ(plan.maskPlace(), MaskPlace::Counter);
    EXPECT_EQ(plan.smallestMaskBits, 8);
    const Axes before{.store = Store::Counter, .levels = 0, .count = Count::ZpassCap};
    EXPECT_EQ(passesOf(planFrame(before, kFrame, chip("ideal")), PassKind::Volume).front().frontCount, 1);
}

TEST(Start, InTheMiddleClearsToItAndComparesWithIt) {
    Axes axes = findMethod("carmack")->axes;
    axes.start = Start::Middle;
    const Plan plan = planFrame(axes, kFrame, chip("ideal"));
    EXPECT_EQ(plan.passes.front().stencilValue, 128);
    EXPECT_EQ(plan.masks.front().test.reference, 128);
    EXPECT_EQ(passesOf(plan, PassKind::Rectangle).front().stencil.reference, 128);
    Profile narrow = chip("ideal");
    narrow.stencilBits = 4;
    EXPECT_EQ(planFrame(axes, kFrame, narrow).passes.front().stencilValue, 8);
}

TEST(Start, AtABiasClearsToTheVolumesThatHoldTheEyeOfEachLight) {
    Axes axes = findMethod("heidmann")->axes;
    axes.start = Start::Bias;
    FrameShape frame = kFrame;
    frame.lights = {{.volumes = 2, .holdingEye = 3}, {.volumes = 2, .holdingEye = 1}};
    std::vector<int> values;
    for (const Pass& pass : planFrame(axes, frame, chip("ideal")).passes)
        if (pass.clearsStencil) values.push_back(pass.stencilValue);
    EXPECT_THAT(values, ElementsAre(3, 1));
}

TEST(Overflow, WrapsOrSaturatesAsAskedAndIsRefusedWhereItCannot) {
    const auto up = [](Overflow overflow, const Profile& profile) {
        Axes axes = findMethod("heidmann")->axes;
        axes.overflow = overflow;
        return passesOf(planFrame(axes, kFrame, profile), PassKind::Volume).front().stencil.front.onPass;
    };
    Profile clamping = chip("ideal");
    clamping.stencilWrap = false;
    EXPECT_EQ(up(Overflow::Saturate, chip("ideal")), StencilOp::Incr);
    EXPECT_EQ(up(Overflow::Wrap, chip("ideal")), StencilOp::IncrWrap);
    EXPECT_EQ(up(Overflow::Saturate, clamping), StencilOp::Incr);
    EXPECT_EQ(up(Overflow::Wrap, clamping), StencilOp::IncrWrap);
    Axes wrapping = findMethod("heidmann")->axes;
    wrapping.overflow = Overflow::Wrap;
    const auto lacks = missing(clamping, planFrame(wrapping, kFrame, clamping));
    ASSERT_EQ(lacks.size(), 1u);
    EXPECT_EQ(lacks[0].key, "stencil_wrap");
}

// Issue 3, part 2.
TEST(Levels, AreRefusedWhereTheChannelHasTooFewBits) {
    Axes axes = findMethod("roettger-screen")->axes;
    for (int levels = 1; levels <= 8; ++levels) {
        axes.levels = levels;
        for (const auto& [id, bits] : {std::pair("voodoo2", 5), std::pair("tnt", 8)}) {
            const auto lacks = missing(chip(id), planFrame(axes, shapeOf(1, 256, 256), chip(id)));
            EXPECT_EQ(lacks.empty(), levels <= bits) << id << " " << levels;
            if (!lacks.empty()) {
                EXPECT_EQ(lacks.front().what,
                          std::to_string(levels) + " bits per channel of the mask (5 at most)");
            }
        }
    }
}

}  // namespace plan_counts_test
}  // namespace gnomon
