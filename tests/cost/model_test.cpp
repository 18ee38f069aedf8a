// What passes and frames take on a chip, by hand from rates that are round.

#include "cost/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "profile/shipped.h"

namespace gnomon {

void PrintTo(Resource resource, std::ostream* out) {
    *out << name(resource);
}

namespace model_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// 100 pixels, 800 bytes, 2 triangles, 50 bytes over the bus in a microsecond.
Profile roundChip() {
    Profile device;
    device.colourFormats = {{.name = "8888", .red = 8, .green = 8, .blue = 8, .alpha = 8}};
    device.alphaBits = 8;
    device.depth = true, device.depthBits = {24};
    device.frameTexture = FrameTexture::Host;
    device.megapixelsPerSecond = 100, device.gigabytesPerSecond = 0.8;
    device.megatrianglesPerSecond = 2, device.busMegabytesPerSecond = 50;
    return device;
}

TEST(PassCost, IsThatOfTheResourceOfWhichItNeedsMost) {
    const Profile device = roundChip();
    const auto costOf = [&](const PassTraffic& t) { return passCost(PassKind::Volume, t, device); };
    const PassCost fill = costOf({.fragments = 100'000, .triangles = 1'000, .depthRead = 400'000});
    EXPECT_DOUBLE_EQ(fill.fillMs, 1);
    EXPECT_DOUBLE_EQ(fill.bandwidthMs, 0.5);
    EXPECT_DOUBLE_EQ(fill.triangleMs, 0.5);
    EXPECT_DOUBLE_EQ(fill.ms(), 1) << "inside a pass they overlap";
    EXPECT_EQ(fill.limit(), Resource::Fill);
    EXPECT_EQ(costOf({.fragments = 100'000, .colourWritten = 1'200'000}).limit(), Resource::Bandwidth);
    EXPECT_DOUBLE_EQ(costOf({.fragments = 100'000, .colourWritten = 1'200'000}).ms(), 1.5);
    EXPECT_EQ(costOf({.fragments = 10, .triangles = 10}).limit(), Resource::Triangles);
    EXPECT_DOUBLE_EQ(costOf({.busBytes = 100'000}).ms(), 2);
    EXPECT_EQ(costOf({.busBytes = 100'000}).limit(), Resource::Bus);
    EXPECT_EQ(costOf({}).limit(), std::nullopt);
}

TEST(PassCost, OfAFrameOnTheChipPaysNoBandwidth) {
    Profile device = roundChip();
    device.onChipFrame = true;
    const PassCost cost =
        passCost(PassKind::Volume, {.fragments = 100'000, .colourWritten = 9'000'000}, device);
    EXPECT_DOUBLE_EQ(cost.ms(), 1);
    EXPECT_EQ(cost.limit(), Resource::Fill);
}

/// A clear of 100,000 pixels, a mask pass of as many of which a quarter passes, and a read-back of 1,000.
struct ThreePasses {
    ThreePasses() {
        plan.passes = {
            {.kind = PassKind::Clear, .clearsDepth = true},
            {.kind = PassKind::Volume,
             .depthTest = true,
             .blend = {.enabled = true, .source = BlendFactor::DstColor, .destination = BlendFactor::One}},
            {.kind = PassKind::Copy, .texture = MaskTexture::Rgb}};
        amounts = {{.pixels = {.clear = 100'000}},
                   {.pixels = {.volume = 100'000}, .vertices = 600},
                   {.pixels = {.copy = 1'000}}};
    }
    Plan plan{};
    std::vector<DrawnAmount> amounts{};
    std::vector<std::int64_t> passed{0, 25'000, 0};
};

TEST(FrameCost, IsTheSumOfItsPasses) {
    const ThreePasses s;
    const FrameCost cost = frameCost(s.plan, roundChip(), s.amounts, s.passed);
    // Clear: 1 ms of fill, 1 ms of 8 bytes each. Mask: 1 ms of fill, 400,000 + 25,000 x 8 bytes = 0.75 ms.
    // Copy: 8 bytes each at 50 MB/s.
    ASSERT_EQ(cost.passes.size(), 3u);
    EXPECT_DOUBLE_EQ(cost.passes[0].ms(), 1);
    EXPECT_DOUBLE_EQ(cost.passes[1].fillMs, 1);
    EXPECT_DOUBLE_EQ(cost.passes[1].bandwidthMs, 0.75);
    EXPECT_DOUBLE_EQ(cost.passes[1].triangleMs, 0.1);
    EXPECT_DOUBLE_EQ(cost.passes[2].busMs, 0.16);
    EXPECT_DOUBLE_EQ(cost.chipMs(), 2.16);
    EXPECT_DOUBLE_EQ(cost.ms(), 2.16);
    EXPECT_DOUBLE_EQ(cost.framesPerSecond(), 1000 / 2.16);
    EXPECT_EQ(cost.bytes(), 800'000 + 600'000);
    EXPECT_EQ(cost.limit(), Resource::Fill);
    EXPECT_TRUE(cost.isComplete());
    EXPECT_TRUE(cost.countsPassed);
}

TEST(FrameCost, WithoutCountsTakesAllFragmentsAsPassed) {
    const ThreePasses s;
    const FrameCost cost = frameCost(s.plan, roundChip(), s.amounts);
    EXPECT_DOUBLE_EQ(cost.passes[1].bandwidthMs, 1.5);
    EXPECT_FALSE(cost.countsPassed);
    EXPECT_EQ(cost.limit(), Resource::Bandwidth) << "1.5 ms of it, 1 ms of fill, 0.16 ms of the bus";
}

TEST(FrameCost, OverlapsWithTheHost) {
    const ThreePasses s;
    const FrameCost fast = frameCost(s.plan, roundChip(), s.amounts, s.passed, 2);
    EXPECT_DOUBLE_EQ(fast.ms(), 2.16);
    EXPECT_EQ(fast.limit(), Resource::Fill);
    const FrameCost slow = frameCost(s.plan, roundChip(), s.amounts, s.passed, 10);
    EXPECT_DOUBLE_EQ(slow.framesPerSecond(), 100);
    EXPECT_EQ(slow.limit(), Resource::Host);
}

TEST(FrameCost, NamesWhatTheProfileLacksInsteadOfInventingIt) {
    const ThreePasses s;
    Profile device = roundChip();
    device.megatrianglesPerSecond = device.busMegabytesPerSecond = 0;
    const FrameCost cost = frameCost(s.plan, device, s.amounts, s.passed);
    EXPECT_THAT(cost.missing, ElementsAre("no triangle rate in the profile (megatriangles_per_second)",
                                          "no bus rate in the profile (bus_megabytes_per_second)"));
    EXPECT_DOUBLE_EQ(cost.ms(), 2);
    device.frameTexture = FrameTexture::Direct;
    device.megapixelsPerSecond = device.gigabytesPerSecond = 0;
    const FrameCost none = frameCost(s.plan, device, s.amounts, s.passed);
    EXPECT_THAT(none.missing, ElementsAre("no fill rate in the profile (megapixels_per_second)",
                                          "no bandwidth in the profile (gigabytes_per_second)",
                                          "no triangle rate in the profile (megatriangles_per_second)"))
        << "nothing goes over the bus";
    EXPECT_EQ(none.limit(), std::nullopt);
    EXPECT_EQ(none.framesPerSecond(), 0);
    device.onChipFrame = true;
    EXPECT_EQ(frameCost(s.plan, device, s.amounts).missing.size(), 2u) << "no bandwidth is called for";
}

// hardware.md 3.1's table: what bounds a mask fragment on each chip.
TEST(ModelOfAChip, BoundsMaskFragmentsAsTheSheetOfFactsDoes) {
    struct Row {
        const char* id;
        double megapixels;
        Resource limit;
    };
    const Pass pass{
        .kind = PassKind::Volume,
        .depthTest = true,
        .blend = {.enabled = true, .source = BlendFactor::DstColor, .destination = BlendFactor::One}};
    const DrawnAmount million{.pixels = {.volume = 1'000'000}};
    for (const Row& row :
         {Row{"voodoo1", 50, Resource::Fill}, Row{"voodoo2", 90, Resource::Fill},
          Row{"riva128", 100, Resource::Fill}, Row{"tnt", 147, Resource::Bandwidth},
          Row{"tnt-565", 180, Resource::Fill}, Row{"tnt2", 200, Resource::Bandwidth},
          Row{"geforce256", 400, Resource::Bandwidth}, Row{"geforce2mx", 221, Resource::Bandwidth},
          Row{"geforce2mx-565", 350, Resource::Fill}, Row{"vsa100-16", 333, Resource::Fill},
          Row{"vsa100-32", 225, Resource::Bandwidth}, Row{"xbox", 533, Resource::Bandwidth},
          Row{"g200", 75, Resource::Bandwidth}, Row{"rage128", 137, Resource::Bandwidth},
          Row{"gamecube", 648, Resource::Fill}, Row{"ps2", 2400, Resource::Fill},
          Row{"dreamcast", 100, Resource::Fill}, Row{"i740", 66, Resource::Fill}}) {
        const Profile device = chip(row.id);
        const PassCost cost = passCost(pass.kind, trafficOf(pass, device, million), device);
        EXPECT_NEAR(1000 / cost.ms(), row.megapixels, 0.5) << row.id << ": it is given in whole Mpixel/s";
        EXPECT_EQ(cost.limit(), row.limit) << row.id;
    }
}

TEST(ModelRates, NameTheirSources) {
    EXPECT_THAT(modelRates(chip("geforce2mx")),
                ElementsAre("fill 350 Mpixel/s [SYSREQ]", "bandwidth 2.656 GB/s [SYSREQ]",
                            "triangles 20 Mtriangle/s [PLANETHW]"));
    EXPECT_THAT(modelRates(chip("voodoo1")).back(), HasSubstr("bus 133 MB/s [derived: MUELLER"));
    EXPECT_THAT(modelRates(chip("gamecube"))[1],
                testing::StartsWith("bandwidth without limit, the frame is on the chip [DOLPHIN"));
    EXPECT_THAT(modelRates(chip("ideal")), IsEmpty());
}

}  // namespace model_test
}  // namespace gnomon
