// What a minimal plan leaves out, and the facts that it gives for it; needs are made by hand. That its mask
// and image are the full plan's is tests/matrix/minimal_test.cpp's.

#include "needs/minimal_plan.h"

#include <gmock/gmock.h>

#include "profile/shipped.h"

namespace gnomon {
namespace minimal_plan_test {

using testing::HasSubstr;

constexpr WindowRect kWhole{0, 0, 320, 240};
constexpr WindowRect kLeft{8, 16, 64, 48}, kRight{200, 100, 40, 40};

/// One light whose volumes have these windows and distances from the near rectangle.
FrameNeeds needsOf(std::vector<WindowRect> windows, std::vector<double> distances) {
    LightNeeds light;
    light.isDrawn.assign(windows.size(), true);
    light.windows = std::move(windows), light.nearDistances = std::move(distances);
    light.full = light.fromEye = {.fronts = 1, .backs = 1, .ownFronts = 1, .overlap = 1, .levels = 1};
    light.seesBackground = light.seesBackgroundInWindows = false;
    return {.lights = {light}, .brightestAmbient = 51, .nearestSurface = 2};
}

FrameShape frameOf(const FrameNeeds& needs) {
    FrameShape frame{.width = 320, .height = 240};
    for (const LightNeeds& light : needs.lights)
        frame.lights.push_back({.volumes = int(light.windows.size())});
    return frame;
}

MaskChannel channelOf(const Axes& axes) {
    return {.format = {"8888", 8, 8, 8, 8}, .channel = axes.store == Store::Alpha ? 3 : 0};
}

MinimalPlan minimal(const std::string& method, const FrameNeeds& needs,
                    const Effects& wanted = Effects::none()) {
    const Axes axes = findMethod(method)->axes;
    return minimalPlan(axes, frameOf(needs), chip("ideal"), needs, channelOf(axes), wanted);
}

const EffectNote& noteOf(const MinimalPlan& plan, Effect effect) {
    static const EffectNote kNone{.fact = "no note"};
    for (const EffectNote& note : plan.notes)
        if (note.effect == effect) return note;
    return kNone;
}

int passesOf(const Plan& plan, PassKind kind) {
    return int(std::count_if(plan.passes.begin(), plan.passes.end(),
                             [&](const Pass& pass) { return pass.kind == kind; }));
}

TEST(MinimalPlanCount, IsZpassWhereNoVolumeTouchesTheNearRectangle) {
    const MinimalPlan plan = minimal("carmack", needsOf({kLeft, kRight}, {1.213, 4}));
    EXPECT_EQ(plan.axes.count, Count::Zpass);
    EXPECT_FALSE(noteOf(plan, Effect::NearCaps).isDrawn);
    EXPECT_THAT(noteOf(plan, Effect::NearCaps).fact,
                HasSubstr("the nearest volume is 1.21 units from the near rectangle"));
    for (const Pass& pass : plan.plan.passes) {
        EXPECT_FALSE(pass.parts.has(Part::LightCap)) << pass.label;
        EXPECT_FALSE(pass.parts.has(Part::NearCap)) << pass.label;
    }
}

TEST(MinimalPlanCount, HasNearCapsWhereOneTouchesIt) {
    const MinimalPlan plan = minimal("carmack", needsOf({kLeft, kRight}, {0, 4}));
    EXPECT_EQ(plan.axes.count, Count::ZpassCap);
    EXPECT_TRUE(noteOf(plan, Effect::NearCaps).isDrawn);
    EXPECT_THAT(noteOf(plan, Effect::NearCaps).fact, HasSubstr("1 volume may touch the near rectangle"));
}

TEST(MinimalPlanCount, StaysWhereSomethingSpeaksAgainstAnother) {
    const auto countOf = [](const FrameNeeds& needs) { return minimal("carmack", needs).axes.count; };
    FrameNeeds needs = needsOf({kLeft}, {0});
    EXPECT_EQ(countOf(needs), Count::ZpassCap);
    needs.nearestSurface = 0;
    EXPECT_EQ(countOf(needs), Count::Zfail) << "a surface at depth 0 hides no cap there";
    needs = needsOf({kLeft}, {1});
    needs.lights[0].isClosed = false;
    EXPECT_EQ(countOf(needs), Count::Zfail);
    needs = needsOf({kLeft}, {1});
    needs.lights[0].eyeIsOnFace = true;
    EXPECT_EQ(countOf(needs), Count::Zfail);
    Effects caps;
    caps.add(Effect::NearCaps);
    EXPECT_EQ(minimal("carmack", needsOf({kLeft}, {1}), caps).axes.count, Count::Zfail);
    EXPECT_TRUE(noteOf(minimal("carmack", needsOf({kLeft}, {1}), caps), Effect::NearCaps).isAsked);
}

TEST(MinimalPlanCount, OfTheEyeIsLeftOut) {
    for (const char* method : {"hornus", "eisemann"}) {
        EXPECT_EQ(minimal(method, needsOf({kLeft}, {1})).axes.count, Count::Zpass) << method;
        EXPECT_NE(minimal(method, needsOf({kLeft}, {0})).axes.count, Count::Zpass) << method;
    }
}

TEST(MinimalPlanVolumes, AreThoseThatReachWhatIsSeen) {
    const MinimalPlan plan = minimal("roettger-screen", needsOf({kLeft, {}, kRight}, {1, 1, 1}));
    EXPECT_THAT(plan.volumes, testing::ElementsAre(testing::ElementsAre(0u, 2u)));
    EXPECT_EQ(passesOf(plan.plan, PassKind::Volume), 4);
    ASSERT_EQ(plan.plan.windows.size(), 1u);
    EXPECT_THAT(plan.plan.windows[0].volumes, testing::ElementsAre(kLeft, kRight));
    EXPECT_EQ(plan.plan.windows[0].all, around(kLeft, kRight));
    EXPECT_THAT(noteOf(plan, Effect::Volumes).fact, HasSubstr("1 of 3 hold no point that is seen"));
}

// A volume that is open at the near plane counts wrong everywhere, and must go on to do so.
TEST(MinimalPlanVolumes, AreWholeWhereTheyAreOpen) {
    const MinimalPlan plan = minimal("heidmann", needsOf({{}, kRight}, {0, 1}));
    EXPECT_THAT(plan.volumes, testing::ElementsAre(testing::ElementsAre(0u, 1u)));
    EXPECT_EQ(plan.plan.windows.at(0).all, kWhole);
}

TEST(MinimalPlanVolumes, OfMuchTheSameWindowAreDrawnInOneCall) {
    const WindowRect near{12, 16, 64, 48};
    const MinimalPlan plan = minimal("heidmann", needsOf({kLeft, {160, 0, 160, 240}, near}, {1, 1, 1}));
    EXPECT_THAT(plan.volumes, testing::ElementsAre(testing::ElementsAre(1u, 0u, 2u)));
    const auto& windows = plan.plan.windows.at(0).volumes;
    EXPECT_EQ(windows[1], around(kLeft, near));
    EXPECT_EQ(windows[1], windows[2]);
}

TEST(MinimalPlanMask, IsNotDrawnWhereNothingIsInShadow) {
    for (const char* method : {"heidmann", "carmack", "roettger-screen", "roettger-alpha-max", "counter"}) {
        const MinimalPlan plan = minimal(method, needsOf({{}, {}}, {1, 1}));
        EXPECT_EQ(passesOf(plan.plan, PassKind::Volume), 0) << method;
        EXPECT_FALSE(noteOf(plan, Effect::Mask).isDrawn) << method;
    }
    // A stencil that holds no shadow needs no rectangle; a mask of 1 is neutral.
    for (const char* method : {"heidmann", "roettger-screen", "screen-texture"}) {
        const MinimalPlan plan = minimal(method, needsOf({{}}, {1}));
        EXPECT_EQ(passesOf(plan.plan, PassKind::Rectangle), 0) << method;
        EXPECT_EQ(passesOf(plan.plan, PassKind::Copy), 0) << method;
        EXPECT_EQ(passesOf(plan.plan, PassKind::Scene), 1) << method;
        EXPECT_EQ(plan.plan.masks.size(), 1u) << method;
    }
}

TEST(MinimalPlanLevels, AreThoseThatNest) {
    FrameNeeds needs = needsOf({kLeft}, {1});
    EXPECT_EQ(minimal("roettger-screen", needs).axes.levels, 1);
    EXPECT_THAT(noteOf(minimal("roettger-screen", needs), Effect::Levels).fact, HasSubstr("1 instead of 2"));
    needs.lights[0].fromEye.levels = needs.lights[0].full.levels = 2;
    EXPECT_EQ(minimal("roettger-screen", needs).axes.levels, 2);
    // Deeper than the full plan resolves: its mask may be wrong, and stays so.
    needs.lights[0].full.levels = 3, needs.lights[0].fromEye.levels = 1;
    EXPECT_EQ(minimal("roettger-screen", needs).axes.levels, 2);
    EXPECT_EQ(minimal("roettger-screen", needs).plan.windows.size(), 0u);
}

TEST(MinimalPlanFarCaps, AreDrawnWhereTheBackgroundIsSeen) {
    FrameNeeds needs = needsOf({kLeft}, {1});
    const auto draws = [](const MinimalPlan& plan) {
        return std::any_of(plan.plan.passes.begin(), plan.plan.passes.end(),
                           [](const Pass& pass) { return pass.parts.has(Part::FarCap); });
    };
    EXPECT_FALSE(draws(minimal("heidmann", needs)));
    needs.lights[0].seesBackground = true;
    EXPECT_FALSE(draws(minimal("heidmann", needs))) << "but not where the volume is drawn";
    Effects whole;
    whole.add(Effect::Window);
    EXPECT_TRUE(draws(minimal("heidmann", needs, whole)));
    needs.lights[0].seesBackgroundInWindows = true;
    EXPECT_TRUE(draws(minimal("heidmann", needs)));
}

TEST(MinimalPlanAmbient, IsNotAddedWhereItIsBlack) {
    FrameNeeds needs = needsOf({kLeft}, {1});
    Axes axes = findMethod("heidmann")->axes;
    axes.shade = Shade::Ambient;
    const auto scenes = [&](const FrameNeeds& of) {
        return passesOf(
            minimalPlan(axes, frameOf(of), chip("ideal"), of, channelOf(axes), Effects::none()).plan,
            PassKind::Scene);
    };
    EXPECT_EQ(scenes(needs), 2);
    needs.brightestAmbient = 0;
    EXPECT_EQ(scenes(needs), 1);
}

TEST(MinimalPlanLights, AreThoseThatGiveLight) {
    FrameNeeds needs = needsOf({kLeft}, {1});
    needs.lights.push_back(needs.lights[0]);
    needs.lights.push_back(needs.lights[0]);
    needs.lights[1].brightest = 0;
    for (const char* method : {"none", "heidmann", "roettger-screen", "roettger-alpha", "williams"}) {
        const MinimalPlan plan = minimal(method, needs);
        for (const Pass& pass : plan.plan.passes) EXPECT_NE(pass.light, 1) << method << ": " << pass.label;
    }
    // One must be drawn, for the background's sake.
    for (LightNeeds& light : needs.lights) light.brightest = 0;
    EXPECT_EQ(minimal("roettger-screen", needs).plan.masks.size(), 1u);
}

TEST(MinimalPlan, IsTheFullOneWhereEverythingIsWanted) {
    const FrameNeeds needs = needsOf({kLeft, kRight}, {1, 1});
    for (const NamedMethod& method : namedMethods()) {
        if (method.axes.automatic) continue;
        const MinimalPlan plan = minimal(method.id, needs, Effects::all());
        const Plan full = planFrame(method.axes, frameOf(needs), chip("ideal"));
        ASSERT_EQ(plan.plan.passes.size(), full.passes.size()) << method.id;
        for (std::size_t i = 0; i < full.passes.size(); ++i) {
            EXPECT_EQ(plan.plan.passes[i].label, full.passes[i].label) << method.id;
            EXPECT_EQ(plan.plan.passes[i].extent, Extent::Whole) << method.id;
        }
        for (const EffectNote& note : plan.notes)
            EXPECT_TRUE(note.isDrawn || note.effect == Effect::NearCaps) << method.id << name(note.effect);
    }
}

TEST(EffectWords, AreReadAsTheyAreWritten) {
    Effects two;
    two.add(Effect::Levels), two.add(Effect::Ambient);
    for (const Effects& effects : {Effects::all(), Effects::none(), two})
        EXPECT_EQ(effectsFrom(toString(effects)), effects);
    EXPECT_EQ(effectsFrom("ambient,nothing"), std::nullopt);
    EXPECT_EQ(effectsFrom(""), std::nullopt);
    EXPECT_EQ(effectsFrom("ambient,"), std::nullopt);
}

}  // namespace minimal_plan_test
}  // namespace gnomon
