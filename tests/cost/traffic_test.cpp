// What a pass moves on a chip: each figure here is worked out by hand from pixels and word sizes.

#include "cost/traffic.h"

#include <gtest/gtest.h>

#include "profile/shipped.h"

namespace gnomon {

void PrintTo(const PassTraffic& t, std::ostream* out) {
    *out << t.fragments << " fragments, " << t.passed << " passed, " << t.triangles << " triangles, depth "
         << t.depthRead << " " << t.depthWritten << ", colour " << t.colourRead << " " << t.colourWritten
         << ", texture " << t.textureWritten << ", bus " << t.busBytes;
}

namespace traffic_test {

using enum BlendFactor;

// 32 bits of colour, and of depth with stencil; 16 and 16.
const Profile k32 = chip("geforce2mx"), k16 = chip("voodoo2");

Blend doubling() {
    return {.enabled = true, .source = DstColor, .destination = One};
}

/// A pass that counts volumes of 100 fragments, 33 vertices.
Pass counting(Blend blend, ColourWrite write) {
    return {.kind = PassKind::Volume, .depthTest = true, .write = write, .blend = blend};
}
const DrawnAmount kHundred{.pixels = {.volume = 100}, .vertices = 33};

// 3.1 of the sheet of hardware facts: 6 and 12 bytes per fragment of a mask, of which 2 and 4 if it fails.
TEST(TrafficOfMask, IsThreeWordsPerFragmentThatPasses) {
    const Pass pass = counting(doubling(), kWriteColour);
    EXPECT_EQ(trafficOf(pass, k16, kHundred).bytes(), 600);
    EXPECT_EQ(trafficOf(pass, k32, kHundred).bytes(), 1200);
    EXPECT_EQ(trafficOf(pass, k32, kHundred, 0).bytes(), 400);
    EXPECT_EQ(trafficOf(pass, k16, kHundred, 0).bytes(), 200);
    EXPECT_EQ(trafficOf(pass, k32, kHundred, 70), (PassTraffic{.fragments = 100,
                                                               .passed = 70,
                                                               .triangles = 11,
                                                               .depthRead = 400,
                                                               .colourRead = 280,
                                                               .colourWritten = 280}));
    EXPECT_EQ(trafficOf(counting(doubling(), kWriteAlpha), k32, kHundred).bytes(), 1200);
}

TEST(TrafficOfMask, TakesNoMoreFragmentsAsPassedThanWereDrawn) {
    EXPECT_EQ(trafficOf(counting(doubling(), kWriteColour), k32, kHundred, 130).passed, 100);
}

TEST(TrafficOfStencil, IsTheDepthWordReadAndWrittenBack) {
    Pass pass = counting({}, kWriteNothing);
    pass.stencil = {
        .enabled = true, .front = {.onPass = StencilOp::IncrWrap}, .back = {.onPass = StencilOp::IncrWrap}};
    EXPECT_EQ(trafficOf(pass, k32, kHundred).bytes(), 800);
    EXPECT_EQ(trafficOf(pass, k32, kHundred, 30).bytes(), 400 + 30 * 4);
    pass.stencil.front = pass.stencil.back = {.onDepthFail = StencilOp::IncrWrap};
    EXPECT_EQ(trafficOf(pass, k32, kHundred, 30).bytes(), 400 + 70 * 4) << "z-fail writes those that fail";
    pass.stencil.front = pass.stencil.back = {};
    EXPECT_EQ(trafficOf(pass, k32, kHundred, 30).bytes(), 400) << "a test alone writes nothing";
    pass.depthTest = false;
    EXPECT_EQ(trafficOf(pass, k32, kHundred, 30).bytes(), 400) << "the stencil lies in the depth word";
}

TEST(TrafficOfScene, WritesDepthWithColourAndReadsNoColour) {
    const DrawnAmount amount{.pixels = {.scene = 50}, .vertices = 300};
    const Pass pass{.kind = PassKind::Scene, .depthTest = true, .depthWrite = true};
    EXPECT_EQ(trafficOf(pass, k32, amount, 40), (PassTraffic{.fragments = 50,
                                                             .passed = 40,
                                                             .triangles = 100,
                                                             .depthRead = 200,
                                                             .depthWritten = 160,
                                                             .colourWritten = 160}));
    Pass depthOnly = pass;
    depthOnly.write = kWriteNothing;
    EXPECT_EQ(trafficOf(depthOnly, k32, amount, 40).bytes(), 360);
    Pass always = pass;
    always.depthFunction = Compare::Always;
    EXPECT_EQ(trafficOf(always, k32, amount, 50).depthRead, 0) << "nothing to compare with";
}

TEST(TrafficOfColour, IsReadWhereTheOldValueMatters) {
    const DrawnAmount amount{.pixels = {.rectangle = 10}, .vertices = 4};
    const auto readBy = [&](Blend blend, ColourWrite write = kWriteColour, const Profile& on = k32) {
        const Pass pass{.kind = PassKind::Rectangle, .write = write, .blend = blend};
        return trafficOf(pass, on, amount).colourRead;
    };
    EXPECT_EQ(readBy({}), 0);
    EXPECT_EQ(readBy({.enabled = true, .source = One, .destination = Zero}), 0);
    EXPECT_EQ(readBy({.enabled = true, .source = DstAlpha, .destination = Zero}), 40);
    EXPECT_EQ(readBy({.enabled = true, .source = Zero, .destination = SrcColor}), 40);
    EXPECT_EQ(readBy({.enabled = true, .source = One, .destination = Zero, .equation = BlendEquation::Max}),
              40);
    EXPECT_EQ(readBy({}, kWriteAlpha), 0) << "a byte of its own";
    const Profile vsa = chip("vsa100-16");
    EXPECT_EQ(readBy({}, {.red = true, .green = false, .blue = false}, vsa), 20) << "565: bytes are shared";

    Pass inverted{.kind = PassKind::Rectangle};
    inverted.logicInvert = true;
    EXPECT_EQ(trafficOf(inverted, k32, amount).colourRead, 40);
    EXPECT_EQ(trafficOf(inverted, k32, amount).triangles, 2);
}

TEST(TrafficOfClear, WritesEachWordOnce) {
    const DrawnAmount amount{.pixels = {.clear = 1000}};
    Pass pass{.kind = PassKind::Clear, .clearsDepth = true, .clearsStencil = true};
    EXPECT_EQ(trafficOf(pass, k32, amount).bytes(), 8000) << "stencil and depth are one word";
    EXPECT_EQ(trafficOf(pass, k16, amount).bytes(), 4000);
    pass.write = kWriteNothing;
    EXPECT_EQ(trafficOf(pass, k32, amount).bytes(), 4000);
}

TEST(TrafficOfCopy, IsMemoryOrBusOrNothing) {
    const DrawnAmount amount{.pixels = {.copy = 64}};
    const Pass colour{.kind = PassKind::Copy, .texture = MaskTexture::Rgb};
    const Pass alpha{.kind = PassKind::Copy, .texture = MaskTexture::Alpha};
    EXPECT_EQ(trafficOf(colour, k32, amount),
              (PassTraffic{.fragments = 64, .colourRead = 256, .textureWritten = 256}));
    EXPECT_EQ(trafficOf(alpha, k32, amount).bytes(), 64 * (4 + 1));
    EXPECT_EQ(trafficOf(colour, k16, amount), (PassTraffic{.busBytes = 64 * (2 + 2)})) << "read and sent";
    EXPECT_EQ(trafficOf(colour, chip("ps2"), amount), PassTraffic{});
}

}  // namespace traffic_test
}  // namespace gnomon
