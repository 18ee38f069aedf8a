// What clears take along because nobody looks at it.

#include "gl/free_channels.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "gl/renderer.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {

void PrintTo(const FreeChannels& free, std::ostream* out) {
    *out << (free.alpha ? "alpha " : "") << (free.stencil ? "stencil" : "");
}

namespace free_channels_test {

constexpr int kWidth = 20, kHeight = 12;

FreeChannels freeOf(const std::string& method, const std::string& chipId) {
    const Profile profile = chip(chipId);
    const Plan plan = planFrame(findMethod(method)->axes, shapeOf(2, kWidth, kHeight), profile);
    return freeChannels(plan, profile, bufferFormatOf(profile));
}

TEST(FreeChannels, AreThoseThatNoPassUses) {
    EXPECT_EQ(freeOf("none", "ideal"), (FreeChannels{true, true}));
    EXPECT_EQ(freeOf("roettger-screen", "ideal"), (FreeChannels{true, true}));
    EXPECT_EQ(freeOf("roettger-half", "ideal"), (FreeChannels{true, true}));
    EXPECT_EQ(freeOf("roettger-alpha", "ideal"), (FreeChannels{false, true}));
    EXPECT_EQ(freeOf("carmack", "ideal"), (FreeChannels{true, false}));
}

TEST(FreeChannels, AreNoneThatTheChipLacks) {
    EXPECT_EQ(freeOf("roettger-screen", "voodoo2"), (FreeChannels{false, false}));
    EXPECT_EQ(freeOf("roettger-screen", "ps2"), (FreeChannels{true, false}));
}

TEST(FreeChannels, AreNoneThatOnlyABlendFactorReads) {
    const Profile profile = chip("ideal");
    const auto reading = [&](BlendFactor factor) {
        Plan plan;
        plan.passes.push_back(
            {.blend = {.enabled = true, .source = BlendFactor::One, .destination = factor}});
        return freeChannels(plan, profile, bufferFormatOf(profile)).alpha;
    };
    EXPECT_TRUE(reading(BlendFactor::DstColor));
    EXPECT_FALSE(reading(BlendFactor::DstAlpha));
    EXPECT_FALSE(reading(BlendFactor::OneMinusDstAlpha));
}

/// What a clear of the whole window asks of the driver.
struct Cleared {
    bool alpha = false;
    GLbitfield bits = 0;
};

std::vector<Cleared> clearsOf(const std::string& method, const std::string& chipId) {
    const Profile profile = chip(chipId);
    const Frame frame = frameOf(twoBoxes(), kWidth, kHeight);
    TestSurface surface(bufferFormatOf(profile), kWidth, kHeight);
    std::vector<Cleared> clears;
    surface.decorate([&clears](GlTable next) {
        const auto alpha = std::make_shared<bool>(true);
        GlTable gl = next;
        gl.ColorMask = [=](GLboolean r, GLboolean g, GLboolean b, GLboolean a) {
            *alpha = a;
            next.ColorMask(r, g, b, a);
        };
        gl.Clear = [=, &clears](GLbitfield bits) {
            clears.push_back({*alpha, bits});
            next.Clear(bits);
        };
        return gl;
    });
    const Plan plan =
        planFrame(findMethod(method)->axes, shapeOf(int(frame.volumes().size()), kWidth, kHeight), profile);
    render(surface, profile, plan, frame.surfaces, frame.lights());
    return clears;
}

TEST(FreeChannels, AreClearedWithWhatLiesBeside) {
    constexpr GLbitfield kAll = GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT;
    const std::vector<Cleared> half = clearsOf("roettger-half", "ideal");
    ASSERT_EQ(half.size(), 2u);
    for (const Cleared& clear : half) EXPECT_TRUE(clear.alpha && clear.bits == kAll);

    const std::vector<Cleared> stencil = clearsOf("carmack", "ideal");
    ASSERT_EQ(stencil.size(), 1u);
    EXPECT_TRUE(stencil[0].alpha && stencil[0].bits == kAll);

    const std::vector<Cleared> lacking = clearsOf("roettger-half", "voodoo2");
    ASSERT_EQ(lacking.size(), 2u);
    for (const Cleared& clear : lacking) {
        EXPECT_FALSE(clear.alpha);
        EXPECT_EQ(clear.bits, GLbitfield(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT));
    }
}

}  // namespace free_channels_test
}  // namespace gnomon
