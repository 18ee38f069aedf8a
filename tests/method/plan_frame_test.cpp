// Plans as values: their lengths in the paper's terms, their order, and what of them the chip decides.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>

#include "method/method.h"

namespace gnomon {
namespace {

using testing::ElementsAre;

Profile chip(const std::string& id) {
    return loadProfile(std::filesystem::path(GNOMON_SOURCE) / "profiles" / (id + ".toml"));
}

FrameShape shapeOf(int volumes, int width, int height) {
    return {.width = width, .height = height, .lights = {{.volumes = volumes}}};
}

constexpr int kVolumes = 3;
const FrameShape kFrame = shapeOf(kVolumes, 321, 241);

Plan planOf(const std::string& method, Shade shade = Shade::Attenuated, const std::string& chipId = "ideal",
            const FrameShape& frame = kFrame) {
    Axes axes = findMethod(method)->axes;
    axes.shade = shade;
    return planFrame(axes, frame, chip(chipId));
}

std::vector<Pass> passesOf(const Plan& plan, PassKind kind) {
    std::vector<Pass> passes;
    std::copy_if(plan.passes.begin(), plan.passes.end(), std::back_inserter(passes),
                 [&](const Pass& pass) { return pass.kind == kind; });
    return passes;
}

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
    const Plan plan = planFrame(axes, kFrame, chip("ideal"));
    EXPECT_EQ(countPasses(plan), (PassCounts{.scene = 2, .volume = 1}));
    const Pass volumes = passesOf(plan, PassKind::Volume).front();
    EXPECT_EQ(volumes.blend.source, BlendFactor::OneMinusDstColor);
    EXPECT_EQ(volumes.blend.destination, BlendFactor::Zero);
    EXPECT_EQ(volumes.colour, glm::vec4(1));
    EXPECT_EQ(plan.passes.front().colour.r, 1) << "lit pixels start at 1";
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

FrameShape twoLights() {
    return {.width = 256, .height = 256, .lights = {{.volumes = 2}, {.volumes = 3}}};
}

int scenePasses(const Plan& plan, Shading shading) {
    return int(std::count_if(plan.passes.begin(), plan.passes.end(), [&](const Pass& pass) {
        return pass.kind == PassKind::Scene && pass.shading == shading;
    }));
}

TEST(SeveralLights, GetTheAmbientPartOnceAndAMaskEach) {
    for (const NamedMethod& method : namedMethods()) {
        SCOPED_TRACE(method.id);
        const Plan plan = planFrame(method.axes, twoLights(), chip("ideal"));
        EXPECT_EQ(scenePasses(plan, Shading::Ambient), 1);
        EXPECT_EQ(scenePasses(plan, Shading::Lit), 0);
        if (method.axes.store == Store::None) continue;
        ASSERT_EQ(plan.masks.size(), 2u);
        EXPECT_EQ(plan.masks[0].light, 0);
        EXPECT_EQ(plan.masks[1].light, 1);
        EXPECT_LT(plan.masks[0].after, plan.masks[1].after);
    }
}

TEST(SeveralLights, GetNoAmbientPartWhereShadowsAndAllElseAreBlack) {
    for (const NamedMethod& method : namedMethods()) {
        if (method.axes.store == Store::None) continue;
        Axes axes = method.axes;
        axes.shade = Shade::Black;
        EXPECT_EQ(scenePasses(planFrame(axes, twoLights(), chip("ideal")), Shading::Ambient), 0) << method.id;
    }
}

TEST(SeveralLights, AddWhereTheStencilLetsThem) {
    Axes axes = findMethod("carmack")->axes;
    axes.shade = Shade::Ambient;
    const Plan plan = planFrame(axes, twoLights(), chip("ideal"));
    std::vector<int> lights;
    for (const Pass& pass : plan.passes) {
        if (pass.shading != Shading::Diffuse) continue;
        lights.push_back(pass.light);
        EXPECT_EQ(pass.blend.source, BlendFactor::One);
        EXPECT_EQ(pass.blend.destination, BlendFactor::One);
        EXPECT_EQ(pass.stencil.function, Compare::Equal);
    }
    EXPECT_THAT(lights, ElementsAre(0, 1));
    // Section by section: clear, ambient, count 0, light 0, clear, count 1, light 1.
    EXPECT_EQ(countPasses(plan), (PassCounts{.scene = 3, .volume = 4}));
}

TEST(SeveralLights, AddHalfWhereShadowsAreAttenuated) {
    const Plan plan = planFrame(findMethod("heidmann")->axes, twoLights(), chip("ideal"));
    EXPECT_EQ(scenePasses(plan, Shading::HalfDiffuse), 2);
    EXPECT_EQ(scenePasses(plan, Shading::RestDiffuse), 2);
    for (const Pass& pass : plan.passes) {
        EXPECT_EQ(pass.shading == Shading::RestDiffuse,
                  pass.kind == PassKind::Scene && pass.stencil.function == Compare::Equal);
    }
}

TEST(SeveralLights, KeepTheFrameSoFarInATextureOnTheScreenOnly) {
    const auto frameTextures = [](const char* id) {
        const Plan plan = planFrame(findMethod(id)->axes, twoLights(), chip("ideal"));
        std::vector<PassKind> kinds;
        for (const Pass& pass : plan.passes)
            if (pass.frameTexture) kinds.push_back(pass.kind);
        return kinds;
    };
    for (const char* id : {"roettger-screen", "screen-texture", "counter", "williams"})
        EXPECT_THAT(frameTextures(id), ElementsAre(PassKind::Copy, PassKind::Rectangle)) << id;
    for (const char* id : {"heidmann", "parity", "roettger-alpha"})
        EXPECT_THAT(frameTextures(id), testing::IsEmpty()) << id;
    EXPECT_EQ(planOf("roettger-screen").frameTextureWidth, 0) << "one light needs none";
}

TEST(SeveralLights, AreRefusedOnTheScreenWhereTheFrameIsTooLargeATexture) {
    const Profile voodoo = chip("voodoo2");
    FrameShape frame = twoLights();
    const Axes axes = findMethod("roettger-screen")->axes;
    EXPECT_THAT(missing(voodoo, planFrame(axes, frame, voodoo)), testing::IsEmpty());
    frame.width = 320, frame.height = 240;
    const auto lacks = missing(voodoo, planFrame(axes, frame, voodoo));
    ASSERT_EQ(lacks.size(), 1u);
    EXPECT_EQ(lacks[0].what, "a texture of 512x256 for the frame so far (256 at most)");
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

}  // namespace
}  // namespace gnomon
