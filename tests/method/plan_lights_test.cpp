// Plans of several lights.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "plans.h"

namespace gnomon {
namespace plan_lights_test {

using testing::ElementsAre;

FrameShape twoLights() {
    return {.width = 256, .height = 256, .lights = {{.volumes = 2}, {.volumes = 3}}};
}

int scenePasses(const Plan& plan, Shading shading) {
    return int(std::count_if(plan.passes.begin(), plan.passes.end(), [&](const Pass& pass) {
        return pass.kind == PassKind::Scene && pass.shading == shading;
    }));
}

TEST(NoLight, GetsTheAmbientPartAndNoMaskWhateverTheMethod) {
    for (const NamedMethod& method : namedMethods()) {
        const Plan plan = planFrame(method.axes, {.width = 256, .height = 256}, chip("ideal"));
        ASSERT_EQ(plan.passes.size(), 2u) << method.id;
        EXPECT_TRUE(plan.passes[0].clearsToBackground && plan.passes[0].clearsDepth) << method.id;
        EXPECT_EQ(plan.passes[1].shading, Shading::Ambient) << method.id;
        EXPECT_TRUE(plan.masks.empty()) << method.id;
    }
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

}  // namespace plan_lights_test
}  // namespace gnomon
