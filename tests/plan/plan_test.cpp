#include "plan/plan.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

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
}

TEST(DescribeState, SaysThatARectangleCarriesTheMasksTexture) {
    const Pass pass{
        .kind = PassKind::Rectangle,
        .blend = {.enabled = true, .source = BlendFactor::Zero, .destination = BlendFactor::SrcColor},
        .texture = MaskTexture::Rgb};
    EXPECT_EQ(describeState(pass), "blend ZERO SRC_COLOR, mask texture, write RGB");
}

}  // namespace
}  // namespace gnomon
