// What a chip lacks for a plan, capability by capability, on chips made for the purpose.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/plan.h"

namespace gnomon {

void PrintTo(const Missing& m, std::ostream* out) {
    *out << m.key << ": " << m.what;
}

namespace missing_test {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using enum BlendFactor;

/// Everything that the plans of this file ask for; each test takes one thing away.
Profile able() {
    Profile p;
    p.colourFormats = {{"8888", 8, 8, 8, 8}};
    p.alphaBits = 8;
    p.blendWritesAlpha = true;
    p.writeMask = WriteMask::Channel;
    p.depth = true;
    p.depthBits = {24};
    p.depthFunctions = {Compare::Less, Compare::Lequal};
    p.stencilBits = 8;
    p.stencilWrap = p.twoSidedStencil = true;
    p.sourceFactors = p.destinationFactors = {Zero, One, SrcColor, DstColor, SrcAlpha, DstAlpha};
    p.alphaSourceFactors = p.alphaDestinationFactors = p.sourceFactors;
    p.blendEquations = {BlendEquation::Add, BlendEquation::Max};
    p.textureUnits = 1;
    p.maxTextureSize = 1024;
    p.textureNonPowerOfTwo = true;
    p.frameTexture = FrameTexture::Copy;
    return p;
}

Plan planOf(Pass pass) {
    return {.passes = {std::move(pass)},
            .width = 64,
            .height = 48,
            .maskWidth = 64,
            .maskHeight = 48,
            .textureWidth = 64,
            .textureHeight = 48};
}

Pass volumeWith(BlendFactor source, BlendFactor destination, ColourWrite write = kWriteColour) {
    return {.kind = PassKind::Volume,
            .write = write,
            .blend = {.enabled = true, .source = source, .destination = destination}};
}

Pass counting(StencilOp front, StencilOp back) {
    return {.kind = PassKind::Volume,
            .write = kWriteNothing,
            .stencil = {.enabled = true, .front = {.onPass = front}, .back = {.onPass = back}}};
}

Pass copyOf(MaskTexture texture) {
    return {.kind = PassKind::Copy, .texture = texture};
}

/// The keys alone.
std::vector<std::string> lacks(const Profile& profile, const Plan& plan) {
    std::vector<std::string> keys;
    for (const Missing& m : missing(profile, plan)) keys.push_back(m.key);
    return keys;
}

TEST(Missing, IsEmptyForAPlanThatAsksForNothing) {
    EXPECT_THAT(missing(Profile{}, {}), IsEmpty());
}

TEST(Missing, NamesWhatAndWhereFrom) {
    Profile p = able();
    p.stencilBits = 0;
    p.facts = {{"stencil_bits", "0", "M-TDFX: Napalm only"}};
    EXPECT_THAT(missing(p, planOf(counting(StencilOp::Incr, StencilOp::Incr))),
                ElementsAre(Missing{"stencil_bits", "stencil", "M-TDFX: Napalm only"}));
}

TEST(Missing, NamesEachLackOnceInTheOrderOfThePlan) {
    Profile p = able();
    p.stencilBits = 0;
    p.depthFunctions = {};
    Plan plan = planOf(counting(StencilOp::Incr, StencilOp::Incr));
    plan.passes.push_back({.kind = PassKind::Scene, .depthTest = true});
    plan.passes.push_back(counting(StencilOp::Decr, StencilOp::Decr));
    EXPECT_THAT(lacks(p, plan), ElementsAre("stencil_bits", "depth_functions"));
}

TEST(Missing, TellsApartTwoPairsOfTheSameCapability) {
    Profile p = able();
    p.sourceFactors = {One};
    Plan plan = planOf(volumeWith(DstColor, One));
    plan.passes.push_back(volumeWith(DstColor, Zero));
    EXPECT_THAT(missing(p, plan), ElementsAre(Field(&Missing::what, "blend dst_color one"),
                                              Field(&Missing::what, "blend dst_color zero")));
}

TEST(Missing, WantsDepthForItsTestItsWriteAndItsClear) {
    Profile p = able();
    p.depth = false;
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Scene, .depthTest = true})), ElementsAre("depth_bits"));
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Scene, .depthWrite = true})), ElementsAre("depth_bits"));
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Clear, .clearsDepth = true})), ElementsAre("depth_bits"));
}

TEST(Missing, WantsTheDepthFunctionOfATest) {
    const Plan plan = planOf({.kind = PassKind::Scene, .depthTest = true, .depthFunction = Compare::Greater});
    EXPECT_THAT(missing(able(), plan), ElementsAre(Field(&Missing::what, "depth function greater")));
}

TEST(Missing, LeavesAloneTheDepthFunctionWithoutATest) {
    EXPECT_THAT(lacks(able(), planOf({.kind = PassKind::Scene, .depthFunction = Compare::Greater})),
                IsEmpty());
}

TEST(Missing, WantsStencilForItsClear) {
    Profile p = able();
    p.stencilBits = 0;
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Clear, .clearsStencil = true})),
                ElementsAre("stencil_bits"));
}

TEST(Missing, WantsTwoSidedStencilWhereSidesDiffer) {
    Profile p = able();
    p.twoSidedStencil = false;
    EXPECT_THAT(lacks(p, planOf(counting(StencilOp::Incr, StencilOp::Decr))),
                ElementsAre("two_sided_stencil"));
    EXPECT_THAT(lacks(p, planOf(counting(StencilOp::Incr, StencilOp::Incr))), IsEmpty());
}

TEST(Missing, WantsWrappingForOperationsThatWrapOnEitherSideAndResult) {
    Profile p = able();
    p.stencilWrap = false;
    EXPECT_THAT(lacks(p, planOf(counting(StencilOp::IncrWrap, StencilOp::Keep))),
                ElementsAre("stencil_wrap"));
    EXPECT_THAT(lacks(p, planOf(counting(StencilOp::Keep, StencilOp::DecrWrap))),
                ElementsAre("stencil_wrap"));
    Pass onDepthFail = counting(StencilOp::Keep, StencilOp::Keep);
    onDepthFail.stencil.front.onDepthFail = StencilOp::IncrWrap;
    EXPECT_THAT(lacks(p, planOf(onDepthFail)), ElementsAre("stencil_wrap"));
}

TEST(Missing, WantsAWayFromFrameToTextureForACopy) {
    Profile p = able();
    p.frameTexture = FrameTexture::None;
    EXPECT_THAT(lacks(p, planOf(copyOf(MaskTexture::Rgb))), ElementsAre("frame_texture"));
}

TEST(Missing, WantsTexturesForACopyAndSaysNothingOfTheirSizeThen) {
    Profile p = able();
    p.textureUnits = p.maxTextureSize = 0;
    EXPECT_THAT(lacks(p, planOf(copyOf(MaskTexture::Rgb))), ElementsAre("texture_units"));
}

TEST(Missing, WantsTexturesAsLargeAsTheMasksOnEitherSide) {
    Plan plan = planOf(copyOf(MaskTexture::Rgb));
    plan.textureWidth = 1024, plan.textureHeight = 1;
    EXPECT_THAT(lacks(able(), plan), IsEmpty());
    plan.textureWidth = 1, plan.textureHeight = 2048;
    EXPECT_THAT(missing(able(), plan),
                ElementsAre(Field(&Missing::what, "a texture of 1x2048 for the mask (1024 at most)")));
}

TEST(Missing, WantsTheTexturesAspectUpToItsLimit) {
    Profile p = able();
    p.maxTextureAspect = 8;
    Plan plan = planOf(copyOf(MaskTexture::Rgb));
    plan.textureWidth = 32, plan.textureHeight = 256;
    EXPECT_THAT(lacks(p, plan), IsEmpty());
    plan.textureWidth = 16;
    EXPECT_THAT(lacks(p, plan), ElementsAre("max_texture_aspect"));
}

TEST(Missing, WantsFreeTextureSizesForASideThatIsNoPowerOfTwo) {
    Profile p = able();
    p.textureNonPowerOfTwo = false;
    EXPECT_THAT(lacks(p, planOf(copyOf(MaskTexture::Rgb))), ElementsAre("texture_non_power_of_two"));
}

TEST(Missing, NamesAlphaBesideDepthForEachUseOfAlpha) {
    Profile p = able();
    p.alphaExcludesDepth = true;
    const auto besideDepth =
        ElementsAre(Missing{"alpha_excludes_depth", "destination alpha beside depth", "not in the profile"});
    EXPECT_THAT(missing(p, planOf({.kind = PassKind::Clear, .write = kWriteAll})), besideDepth);
    EXPECT_THAT(missing(p, planOf(volumeWith(DstColor, One, kWriteAlpha))), besideDepth);
    EXPECT_THAT(missing(p, planOf(volumeWith(Zero, DstAlpha))), besideDepth);
    EXPECT_THAT(missing(p, planOf(volumeWith(DstAlpha, Zero))), besideDepth);
    EXPECT_THAT(missing(p, planOf(copyOf(MaskTexture::Alpha))), besideDepth);
    EXPECT_THAT(missing(p, planOf(volumeWith(DstColor, One))), IsEmpty());
}

TEST(Missing, WantsAlphaPlanesForWritesAndCopiesOfAlpha) {
    Profile p = able();
    p.alphaBits = 0;
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Clear, .write = kWriteAll})), ElementsAre("alpha_bits"));
    EXPECT_THAT(lacks(p, planOf(copyOf(MaskTexture::Alpha))), ElementsAre("alpha_bits"));
}

TEST(Missing, WantsABlenderThatWritesAlphaForBlendedAlphaOnly) {
    Profile p = able();
    p.blendWritesAlpha = false;
    EXPECT_THAT(lacks(p, planOf(volumeWith(DstColor, One, kWriteAlpha))), ElementsAre("blend_writes_alpha"));
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Rectangle, .write = kWriteAlpha})), IsEmpty());
}

TEST(Missing, WantsAlphaFactorsOfTheirOwn) {
    Profile p = able();
    p.alphaSourceFactors = p.alphaDestinationFactors = {Zero, One};
    EXPECT_THAT(lacks(p, planOf(volumeWith(DstColor, One, kWriteAlpha))),
                ElementsAre("alpha_source_factors"));
    EXPECT_THAT(lacks(p, planOf(volumeWith(One, One, kWriteAlpha))), IsEmpty());
}

// OpenGL: a colour factor means the alpha value of its side there.
TEST(Missing, TakesAColourFactorInAlphaForTheAlphaFactor) {
    Profile p = able();
    p.alphaSourceFactors = p.alphaDestinationFactors = {One, DstAlpha};
    EXPECT_THAT(lacks(p, planOf(volumeWith(DstColor, One, kWriteAlpha))), IsEmpty());
}

TEST(Missing, WantsAMaskPerChannelForRedAlone) {
    Profile p = able();
    p.writeMask = WriteMask::Group;
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Clear, .write = {true, false, false, false}})),
                ElementsAre("write_mask"));
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Clear, .write = kWriteAlpha})), IsEmpty());
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Clear, .write = kWriteColour})), IsEmpty());
}

TEST(Missing, WantsAMaskPerGroupForColourWithoutAlpha) {
    Profile p = able();
    p.writeMask = WriteMask::Fixed;
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Clear, .write = kWriteColour})),
                ElementsAre("write_mask"));
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Clear, .write = kWriteAll})), IsEmpty());
    EXPECT_THAT(lacks(p, planOf({.kind = PassKind::Clear, .write = kWriteNothing})), IsEmpty());
}

TEST(Missing, WantsTheFunctionOfAnAlphaTestThatIsOn) {
    Profile p = able();
    p.alphaFunctions = {Compare::Greater};
    Pass pass{.kind = PassKind::Rectangle,
              .alphaTest = {.enabled = true, .function = Compare::Notequal, .reference = 0}};
    EXPECT_THAT(missing(p, planOf(pass)), ElementsAre(Field(&Missing::what, "alpha test notequal")));
    EXPECT_THAT(lacks(p, planOf(pass)), ElementsAre("alpha_functions"));
    pass.alphaTest.function = Compare::Greater;
    EXPECT_THAT(lacks(p, planOf(pass)), IsEmpty());
    pass.alphaTest = {.enabled = false, .function = Compare::Less};
    EXPECT_THAT(lacks(p, planOf(pass)), IsEmpty());
}

TEST(Missing, WantsLogicOperationsAndNoBlenderToInvert) {
    Profile p = able();
    p.blendEquations = {};
    Pass pass = volumeWith(OneMinusDstColor, Zero);
    pass.logicInvert = true;
    EXPECT_THAT(missing(p, planOf(pass)), ElementsAre(Field(&Missing::what, "logic operations")));
    p.logicOps = true;
    EXPECT_THAT(lacks(p, planOf(pass)), IsEmpty()) << "a logic operation takes the place of blending";
    pass.write = kWriteAlpha;
    EXPECT_THAT(lacks(p, planOf(pass)), IsEmpty());
    p.blendWritesAlpha = false;
    EXPECT_THAT(lacks(p, planOf(pass)), ElementsAre("blend_writes_alpha"));
}

TEST(Missing, WantsTheBlendEquation) {
    Profile p = able();
    p.blendEquations = {BlendEquation::Add};
    Pass pass = volumeWith(One, One);
    pass.blend.equation = BlendEquation::Max;
    EXPECT_THAT(missing(p, planOf(pass)), ElementsAre(Field(&Missing::what, "blend equation max")));
}

TEST(Missing, LeavesAloneTheFactorsOfAMaximum) {
    Pass pass = volumeWith(OneMinusDstColor, ConstantAlpha);
    pass.blend.equation = BlendEquation::Max;
    EXPECT_THAT(lacks(able(), planOf(pass)), IsEmpty());
}

TEST(Missing, LeavesAloneABlenderThatIsOff) {
    Pass pass = volumeWith(OneMinusDstColor, Zero);
    pass.blend.enabled = false;
    EXPECT_THAT(lacks(able(), planOf(pass)), IsEmpty());
}

TEST(Missing, AllowsAPairByEitherTheProductOfSetsOrTheList) {
    Profile p = able();
    p.sourceFactors = p.destinationFactors = {};
    p.blendPairs = {{DstColor, One}};
    EXPECT_THAT(lacks(p, planOf(volumeWith(DstColor, One))), IsEmpty());
    EXPECT_THAT(lacks(p, planOf(volumeWith(DstColor, Zero))), ElementsAre("blend_pairs"));
}

/// As the PlayStation 2: doubling only while the source colour is one grey.
Profile constantOnly() {
    Profile p = able();
    p.sourceFactors = p.destinationFactors = {};
    p.blendPairs = {{One, One}};
    p.constantSourcePairs = {{DstColor, Zero}};
    return p;
}

TEST(Missing, AllowsAConstantPairForOneGreyOnly) {
    const Profile p = constantOnly();
    Pass pass = volumeWith(DstColor, Zero);
    EXPECT_THAT(lacks(p, planOf(pass)), IsEmpty());
    pass.kind = PassKind::Rectangle;
    EXPECT_THAT(lacks(p, planOf(pass)), IsEmpty());
    pass.colour = {0.5f, 0.5f, 0.4f, 1};
    EXPECT_THAT(lacks(p, planOf(pass)), ElementsAre("blend_pairs"));
}

TEST(Missing, RefusesAConstantPairForSceneAndTexture) {
    const Profile p = constantOnly();
    Pass pass = volumeWith(DstColor, Zero);
    pass.kind = PassKind::Scene;
    EXPECT_THAT(missing(p, planOf(pass)),
                ElementsAre(Field(&Missing::what, HasSubstr("dst_color zero with a varying source colour"))));
    pass.kind = PassKind::Rectangle, pass.texture = MaskTexture::Rgb;
    EXPECT_THAT(lacks(p, planOf(pass)), ElementsAre("blend_pairs"));
}

TEST(Missing, NamesTheSideOfTheFrameThatIsTooLong) {
    Profile p = able();
    p.maxWidth = 64, p.maxHeight = 48;
    Plan plan = planOf({});
    EXPECT_THAT(lacks(p, plan), IsEmpty());
    plan.width = 65;
    EXPECT_THAT(lacks(p, plan), ElementsAre("max_width"));
    plan.width = 64, plan.height = 49;
    EXPECT_THAT(lacks(p, plan), ElementsAre("max_height"));
}

TEST(Missing, WantsMemoryForTheFrame) {
    Profile p = able();
    p.frameBytes = 64 * 48 * 12;
    Plan plan = planOf({});
    EXPECT_THAT(lacks(p, plan), IsEmpty());
    ++plan.height;
    EXPECT_THAT(lacks(p, plan), ElementsAre("frame_bytes"));
}

TEST(Missing, WantsBitsForTheMasksArithmeticWhereItStands) {
    Profile p = able();
    p.colourFormats = {{"565", 5, 6, 5, 0}};
    Plan plan = planOf({});
    plan.masks = {{.place = MaskPlace::Colour}}, plan.smallestMaskBits = 5;
    EXPECT_THAT(lacks(p, plan), IsEmpty());
    plan.smallestMaskBits = 6;
    EXPECT_THAT(lacks(p, plan), ElementsAre("colour_formats"));
    plan.masks = {{.place = MaskPlace::Alpha}};
    EXPECT_THAT(lacks(p, plan), IsEmpty());
    plan.masks = {{.place = MaskPlace::Texture}};
    plan.passes = {copyOf(MaskTexture::Alpha)};
    EXPECT_THAT(lacks(p, plan), IsEmpty());
    plan.passes = {copyOf(MaskTexture::Rgb)};
    EXPECT_THAT(lacks(p, plan), ElementsAre("colour_formats"));
}

/// A chip with programs, which able() is not.
Profile programmable() {
    Profile p = able();
    p.shaders = p.geometryShaders = p.atomicCounters = p.framebufferFetch = true;
    p.depthClamp = p.depthTextures = true;
    return p;
}

TEST(Missing, WantsProgramsAndAFrameBufferThatTheyRead) {
    for (const Program program : {Program::CountFaces, Program::ShadeCount}) {
        const Plan plan = planOf({.kind = PassKind::Volume, .program = program});
        Profile p = programmable();
        EXPECT_THAT(lacks(p, plan), IsEmpty());
        p.framebufferFetch = false;
        EXPECT_THAT(missing(p, plan),
                    ElementsAre(Field(&Missing::what, "a fragment program that reads the frame buffer")));
        p.shaders = false;
        EXPECT_THAT(lacks(p, plan), ElementsAre("shaders", "framebuffer_fetch"));
    }
}

TEST(Missing, WantsGeometryShadersAndAtomicCountersForSilhouettes) {
    Pass pass{.kind = PassKind::Volume, .drawn = Drawn::Silhouettes, .countsBlockers = true};
    Profile p = programmable();
    EXPECT_THAT(lacks(p, planOf(pass)), IsEmpty());
    p.geometryShaders = false;
    EXPECT_THAT(lacks(p, planOf(pass)), ElementsAre("geometry_shaders"));
    p.geometryShaders = true, p.atomicCounters = false;
    EXPECT_THAT(lacks(p, planOf(pass)), ElementsAre("atomic_counters"));
    pass.countsBlockers = false;
    EXPECT_THAT(lacks(p, planOf(pass)), IsEmpty());
}

TEST(Missing, WantsDepthClampWhereAPassClamps) {
    Pass pass = counting(StencilOp::Incr, StencilOp::Incr);
    pass.depthClamp = true;
    Profile p = able();
    EXPECT_THAT(lacks(p, planOf(pass)), ElementsAre("depth_clamp"));
    p.depthClamp = true;
    EXPECT_THAT(lacks(p, planOf(pass)), IsEmpty());
}

TEST(Missing, WantsDepthTexturesAndAsLargeOnesAsTheMap) {
    Plan plan = planOf(
        {.kind = PassKind::Clear, .clearsDepth = true, .write = kWriteNothing, .target = Target::DepthMap});
    plan.mapSize = 1024;
    Profile p = programmable();
    EXPECT_THAT(lacks(p, plan), IsEmpty());
    plan.mapSize = 2048;
    EXPECT_THAT(
        missing(p, plan),
        ElementsAre(Field(&Missing::what, "a texture of 2048x2048 for the depth map (1024 at most)")));
    p.depthTextures = false;
    EXPECT_THAT(lacks(p, plan), ElementsAre("depth_textures"));
}

TEST(Missing, WantsProgramsToCompareWithADepthMap) {
    const Plan plan = planOf({.kind = PassKind::Scene, .shading = Shading::Mask});
    EXPECT_THAT(lacks(able(), plan), ElementsAre("shaders"));
    EXPECT_THAT(lacks(programmable(), plan), IsEmpty());
}

TEST(Missing, WantsATextureForTheFrameSoFarAsLargeAsTheFrameAndNotAsTheMask) {
    Pass copy = copyOf(MaskTexture::Rgb);
    copy.frameTexture = true;
    Plan plan = planOf(copy);
    plan.frameTextureWidth = 1024, plan.frameTextureHeight = 512;
    plan.textureWidth = plan.textureHeight = 4096;
    Profile p = able();
    EXPECT_THAT(lacks(p, plan), IsEmpty());
    p.maxTextureSize = 512;
    EXPECT_THAT(
        missing(p, plan),
        ElementsAre(Field(&Missing::what, "a texture of 1024x512 for the frame so far (512 at most)")));
    p.maxTextureSize = 1024, p.frameTexture = FrameTexture::None;
    EXPECT_THAT(lacks(p, plan), ElementsAre("frame_texture"));
}

TEST(Missing, RefusesAConstantPairForAProgramsColour) {
    Profile p = constantOnly();
    p.shaders = p.framebufferFetch = true;
    Pass pass = volumeWith(DstColor, Zero);
    pass.program = Program::CountFaces;
    EXPECT_THAT(lacks(p, planOf(pass)), ElementsAre("blend_pairs"));
}

// A Voodoo with 2 MiB: 640x480 is the largest frame with depth.
TEST(FrameBytes, CountTwoColourBuffersAndDepth) {
    Profile p;
    p.colourFormats = {{"565", 5, 6, 5, 0}};
    p.depthBits = {16};
    EXPECT_EQ(frameBytes(p, 640, 480), 640 * 480 * 6);
    EXPECT_LT(frameBytes(p, 640, 480), 2 << 20);
    EXPECT_GT(frameBytes(p, 800, 600), 2 << 20);
}

TEST(FrameBytes, KeepDepthOf24BitsInAWord) {
    Profile p;
    p.colourFormats = {{"888", 8, 8, 8, 0}};
    p.depthBits = {24};
    EXPECT_EQ(frameBytes(p, 10, 1), 10 * 12);
}

TEST(FrameBytes, CountNoDepthWhereThereIsNone) {
    Profile p;
    p.colourFormats = {{"8888", 8, 8, 8, 8}};
    EXPECT_EQ(frameBytes(p, 10, 1), 10 * 8);
}

TEST(FrameBytes, HoldFramesBeyondTwoGibibytes) {
    Profile p;
    p.colourFormats = {{"8888", 8, 8, 8, 8}};
    p.depthBits = {24};
    EXPECT_EQ(frameBytes(p, 65536, 65536), std::int64_t(12) << 32);
}

}  // namespace missing_test
}  // namespace gnomon
