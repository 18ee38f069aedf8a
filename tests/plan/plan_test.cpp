#include "plan/plan.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace plan_test {

TEST(CountPasses, CountsByKindAndLeavesClearsOut) {
    Plan plan;
    for (const auto& [kind, times] :
         {std::pair(PassKind::Clear, 5), std::pair(PassKind::Scene, 1), std::pair(PassKind::Volume, 4),
          std::pair(PassKind::Rectangle, 3), std::pair(PassKind::Copy, 2)})
        for (int i = 0; i < times; ++i) plan.passes.push_back({.kind = kind});
    EXPECT_EQ(countPasses(plan), (PassCounts{.scene = 1, .volume = 4, .rectangle = 3, .copy = 2}));
}

TEST(CountPasses, IsNothingForAnEmptyPlan) {
    EXPECT_EQ(countPasses({}), PassCounts{});
}

TEST(DescribeState, SpeaksOfDepthBlendAndWritesInOpenGLsWords) {
    const Pass pass{
        .kind = PassKind::Volume,
        .depthTest = true,
        .depthFunction = Compare::Lequal,
        .blend = {.enabled = true, .source = BlendFactor::DstColor, .destination = BlendFactor::One}};
    EXPECT_EQ(describeState(pass), "depth LEQUAL, blend DST_COLOR ONE, colour 1, write RGB");
}

// ---- Scissors ----

const std::vector<MaskWindow> kWindows{{}, {{12, 40, 96, 64}, {{12, 40, 32, 32}, {40, 40, 68, 64}, {}}}};

Pass boundedPass(PassKind kind, Extent extent, int volume = kAllVolumes) {
    Pass pass{.kind = kind, .light = 1, .volume = volume};
    pass.extent = extent;
    return pass;
}

TEST(ScissorOf, IsTheLightsOrTheVolumes) {
    EXPECT_EQ(scissorOf(boundedPass(PassKind::Rectangle, Extent::Whole), kWindows), std::nullopt);
    EXPECT_EQ(scissorOf(boundedPass(PassKind::Rectangle, Extent::Shadows), kWindows), kWindows[1].all);
    EXPECT_EQ(scissorOf(boundedPass(PassKind::Volume, Extent::Shadows, 0), kWindows), kWindows[1].all);
    EXPECT_EQ(scissorOf(boundedPass(PassKind::Volume, Extent::Volumes, 1), kWindows), kWindows[1].volumes[1]);
    EXPECT_EQ(scissorOf(boundedPass(PassKind::Volume, Extent::Volumes), kWindows), kWindows[1].all);
    EXPECT_TRUE(scissorOf(boundedPass(PassKind::Volume, Extent::Volumes, 2), kWindows)->empty());
    Pass other = boundedPass(PassKind::Clear, Extent::Shadows);
    other.light = 0;
    EXPECT_TRUE(scissorOf(other, kWindows)->empty());
}

TEST(ScissorOf, NeverBoundsACopy) {
    EXPECT_EQ(scissorOf(boundedPass(PassKind::Copy, Extent::Shadows), kWindows), std::nullopt);
}

TEST(DescribeState, SaysWhereAPassIsBounded) {
    EXPECT_EQ(describeState(boundedPass(PassKind::Rectangle, Extent::Shadows), kWindows),
              "scissor 12,40 96x64, colour 1, write RGB");
    EXPECT_EQ(describeState(boundedPass(PassKind::Clear, Extent::Shadows), kWindows),
              "scissor 12,40 96x64, colour 1");
    EXPECT_EQ(describeState(boundedPass(PassKind::Volume, Extent::Volumes, 0), kWindows),
              "scissor 12,40 32x32, colour 1, write RGB");
    EXPECT_EQ(describeState(boundedPass(PassKind::Volume, Extent::Volumes), kWindows),
              "scissor of each volume within 12,40 96x64, colour 1, write RGB");
    EXPECT_EQ(describeState(boundedPass(PassKind::Volume, Extent::Volumes, 2), kWindows),
              "empty scissor, colour 1, write RGB");
    EXPECT_EQ(describeState(boundedPass(PassKind::Volume, Extent::Whole), kWindows), "colour 1, write RGB");
    EXPECT_EQ(describeState(boundedPass(PassKind::Copy, Extent::Shadows), kWindows), "colour to RGB");
    Pass masked = boundedPass(PassKind::Rectangle, Extent::Shadows);
    masked.target = Target::Mask;
    EXPECT_EQ(describeState(masked, kWindows), "mask's viewport, scissor 12,40 96x64, colour 1, write RGB");
}

TEST(DescribeState, SaysThatAPassIsBoundedWhereTheWindowsAreNotKnown) {
    EXPECT_EQ(describeState(boundedPass(PassKind::Rectangle, Extent::Shadows)),
              "scissor, colour 1, write RGB");
    EXPECT_EQ(describeState(boundedPass(PassKind::Volume, Extent::Volumes)),
              "scissor of each volume, colour 1, write RGB");
}

TEST(Missing, AsksForNothingMoreWhereAPassIsBounded) {
    Profile none;
    none.textureUnits = 1;
    for (const PassKind kind : {PassKind::Clear, PassKind::Volume, PassKind::Rectangle}) {
        Plan plan{.passes = {boundedPass(kind, Extent::Whole)}};
        plan.passes.front().blend = {.enabled = true, .source = BlendFactor::DstColor};
        const std::vector<Missing> whole = missing(none, plan);
        plan.passes.front().extent = Extent::Shadows, plan.windows = kWindows;
        EXPECT_EQ(missing(none, plan), whole);
    }
}

TEST(DescribeState, NamesAnEquationThatIsNotASum) {
    Pass pass{.kind = PassKind::Volume,
              .colour = glm::vec4(8, 4, 8, 4) / 255.0f,
              .blend = {.enabled = true, .source = BlendFactor::One, .destination = BlendFactor::One}};
    pass.blend.equation = BlendEquation::ReverseSubtract;
    EXPECT_EQ(describeState(pass), "blend REVERSE_SUBTRACT ONE ONE, colour 0.0314 0.0157 0.0314, write RGB");
    pass.blend.equation = BlendEquation::AddWrap, pass.write = kWriteAlpha;
    EXPECT_EQ(describeState(pass), "blend ADD_WRAP ONE ONE, alpha 0.0157, write A");
}

TEST(DescribeState, TellsTheConstantOfAFactorThatIsOne) {
    Pass pass{.kind = PassKind::Scene,
              .blend = {.enabled = true,
                        .source = BlendFactor::Zero,
                        .destination = BlendFactor::ConstantAlpha,
                        .constant = 0.5f}};
    EXPECT_EQ(describeState(pass), "blend ZERO CONSTANT_ALPHA, constant 0.5, write RGB");
}

TEST(DescribeState, NamesALogicOperationWithoutAColour) {
    const Pass pass{.kind = PassKind::Volume, .logicInvert = true};
    EXPECT_EQ(describeState(pass), "logic op INVERT, write RGB");
}

TEST(DescribeState, TellsAnAlphaTestAndTheColourUnderATextureOfAlpha) {
    Pass pass{.kind = PassKind::Rectangle,
              .colour = glm::vec4(0.5f),
              .alphaTest = {.enabled = true, .function = Compare::Notequal, .reference = 0.376f},
              .texture = MaskTexture::Intensity};
    EXPECT_EQ(describeState(pass), "alpha NOTEQUAL 0.376, mask texture, write RGB");
    pass.texture = MaskTexture::Alpha;
    EXPECT_EQ(describeState(pass), "alpha NOTEQUAL 0.376, mask texture, colour 0.5, write RGB");
}

TEST(Passes, ComparesTheValueWithTheReference) {
    using enum Compare;
    const auto outcome = [](Compare function) {
        std::string text;
        for (const float value : {0.25f, 0.5f, 0.75f}) text += passes(function, value, 0.5f) ? 'y' : 'n';
        return text;
    };
    EXPECT_EQ(outcome(Never), "nnn");
    EXPECT_EQ(outcome(Less), "ynn");
    EXPECT_EQ(outcome(Equal), "nyn");
    EXPECT_EQ(outcome(Lequal), "yyn");
    EXPECT_EQ(outcome(Greater), "nny");
    EXPECT_EQ(outcome(Notequal), "yny");
    EXPECT_EQ(outcome(Gequal), "nyy");
    EXPECT_EQ(outcome(Always), "yyy");
}

TEST(DescribeState, TellsADepthWrite) {
    const Pass pass{.kind = PassKind::Scene, .depthTest = true, .depthWrite = true, .write = kWriteNothing};
    EXPECT_EQ(describeState(pass), "depth LESS write, write nothing");
}

TEST(DescribeState, TellsStencilForBothSidesOnceWhereTheyAgree) {
    Pass pass{
        .kind = PassKind::Volume,
        .write = kWriteNothing,
        .stencil = {
            .enabled = true, .front = {.onPass = StencilOp::Incr}, .back = {.onPass = StencilOp::Incr}}};
    EXPECT_EQ(describeState(pass), "stencil ALWAYS 0, op KEEP KEEP INCR, write nothing");
    pass.stencil.back.onPass = StencilOp::DecrWrap;
    EXPECT_EQ(describeState(pass),
              "stencil ALWAYS 0, op front KEEP KEEP INCR back KEEP KEEP DECR_WRAP, write nothing");
}

TEST(DescribeState, TellsWhatFailsTheDepthTest) {
    const StencilSide up{.onDepthFail = StencilOp::IncrWrap}, down{.onDepthFail = StencilOp::DecrWrap};
    const Pass pass{.kind = PassKind::Volume,
                    .depthTest = true,
                    .depthFunction = Compare::Lequal,
                    .write = kWriteNothing,
                    .stencil = {.enabled = true, .front = down, .back = up}};
    EXPECT_EQ(describeState(pass),
              "depth LEQUAL, stencil ALWAYS 0, op front KEEP DECR_WRAP KEEP back KEEP INCR_WRAP KEEP, "
              "write nothing");
}

TEST(DescribeState, TellsMasksOfTheStencilThatAreNotWhole) {
    const StencilSide replace{.onPass = StencilOp::Replace};
    const Pass pass{.kind = PassKind::Rectangle,
                    .write = kWriteNothing,
                    .stencil = {.enabled = true,
                                .function = Compare::Equal,
                                .reference = 3,
                                .readMask = 1,
                                .writeMask = 2,
                                .front = replace,
                                .back = replace}};
    EXPECT_EQ(describeState(pass),
              "stencil EQUAL 3 & 0x1, write mask 0x2, op KEEP KEEP REPLACE, write nothing");
}

TEST(DescribeState, TellsTheStencilThatAClearSets) {
    EXPECT_EQ(describeState({.clearsStencil = true, .stencilValue = 128, .write = kWriteNothing}),
              "stencil 128");
    EXPECT_EQ(describeState({.clearsStencil = true, .stencilIsBlockers = true, .write = kWriteNothing}),
              "stencil to the count of one pixel");
    EXPECT_EQ(describeState({.clearsStencil = true, .write = kWriteNothing, .stencil = {.writeMask = 1}}),
              "stencil 0 in mask 0x1");
}

TEST(DescribeState, NamesTargetsThatAreNotTheWindow) {
    EXPECT_EQ(describeState({.kind = PassKind::Scene, .write = kWriteNothing, .target = Target::Mask}),
              "mask's viewport, write nothing");
    EXPECT_EQ(describeState({.kind = PassKind::Scene, .write = kWriteNothing, .target = Target::DepthMap}),
              "depth map's viewport, write nothing");
    EXPECT_EQ(describeState({.kind = PassKind::Volume, .write = kWriteNothing, .target = Target::OnePixel}),
              "viewport 1x1, write nothing");
}

TEST(DescribeState, NamesProgramsAndWhatTheyAdd) {
    Pass pass{.kind = PassKind::Volume, .program = Program::CountFaces, .frontCount = -1};
    EXPECT_EQ(describeState(pass), "program: 16 bits of RG, front -1 back +1, write RGB");
    pass = {.kind = PassKind::Scene, .program = Program::ShadeCount};
    EXPECT_EQ(describeState(pass), "program: by the 16 bits of RG, write RGB");
    pass = {.kind = PassKind::Scene, .shading = Shading::Mask};
    EXPECT_EQ(describeState(pass), "depth map compared, write RGB");
}

TEST(DescribeState, SaysOfAtomiczpThatAShaderDrawsAndCounts) {
    const Pass pass{.kind = PassKind::Volume,
                    .drawn = Drawn::Silhouettes,
                    .countsBlockers = true,
                    .depthClamp = true,
                    .write = kWriteNothing,
                    .stencil = {.enabled = true, .minusBlockers = true}};
    EXPECT_EQ(describeState(pass),
              "depth clamp, stencil ALWAYS 0 minus the atomic count, op KEEP KEEP KEEP, geometry shader with "
              "an atomic counter, write nothing");
}

TEST(DescribeState, TellsTheFrameSoFarFromTheMask) {
    const Blend add{.enabled = true, .source = BlendFactor::One, .destination = BlendFactor::One};
    const Pass pass{
        .kind = PassKind::Rectangle, .blend = add, .texture = MaskTexture::Rgb, .frameTexture = true};
    EXPECT_EQ(describeState(pass), "blend ONE ONE, frame texture, write RGB");
}

TEST(DescribeState, NamesAMaximumWithoutItsFactors) {
    const Pass pass{.kind = PassKind::Rectangle,
                    .colour = glm::vec4(0.5f),
                    .write = kWriteAlpha,
                    .blend = {.enabled = true, .equation = BlendEquation::Max}};
    EXPECT_EQ(describeState(pass), "blend MAX, alpha 0.5, write A");
}

TEST(DescribeState, TellsWhatAClearSets) {
    EXPECT_EQ(describeState({.colour = glm::vec4(0.25f), .clearsDepth = true}), "colour 0.25, depth 1");
    EXPECT_EQ(describeState({.clearsDepth = true, .clearsStencil = true, .clearsToBackground = true}),
              "colour of the background, depth 1, stencil 0");
    EXPECT_EQ(describeState({.colour = glm::vec4(0.25f), .clearsToBackground = true, .write = kWriteAll}),
              "colour of the background, alpha 0.25");
    EXPECT_EQ(describeState({.colour = glm::vec4(0.25f), .write = kWriteAlpha}), "alpha 0.25");
}

TEST(DescribeState, TellsTheFormatOfACopy) {
    EXPECT_EQ(describeState({.kind = PassKind::Copy, .texture = MaskTexture::Rgb}), "colour to RGB");
    EXPECT_EQ(describeState({.kind = PassKind::Copy, .texture = MaskTexture::Intensity}),
              "colour to INTENSITY");
    EXPECT_EQ(describeState({.kind = PassKind::Copy, .texture = MaskTexture::Alpha}), "alpha to ALPHA");
    EXPECT_EQ(describeState({.kind = PassKind::Copy, .texture = MaskTexture::Intensity, .nearest = true}),
              "colour to INTENSITY, unfiltered");
}

TEST(DescribeState, SaysThatARectangleCarriesTheMasksTexture) {
    const Pass pass{
        .kind = PassKind::Rectangle,
        .blend = {.enabled = true, .source = BlendFactor::Zero, .destination = BlendFactor::SrcColor},
        .texture = MaskTexture::Rgb};
    EXPECT_EQ(describeState(pass), "blend ZERO SRC_COLOR, mask texture, write RGB");
}

}  // namespace plan_test
}  // namespace gnomon
