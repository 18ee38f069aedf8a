// Small plans over rays whose crossings are written down by hand.

#include "predict/mask_prediction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "predict/window_prediction.h"
#include "rays.h"

namespace gnomon {
namespace mask_prediction_test {

using testing::ElementsAre;

/// Keeps what a prediction refers to.
struct Predicted {
    Predicted(Plan p, std::vector<Signature> rays, MaskChannel arithmetic = kEightBits)
        : Predicted(std::move(p), row(std::move(rays)), arithmetic) {}
    Predicted(Plan p, Crossings c, MaskChannel arithmetic = kEightBits, int holdingEye = 0)
        : plan(std::move(p)),
          crossings(std::move(c)),
          mask({.plan = plan, .crossings = crossings, .arithmetic = arithmetic, .holdingEye = holdingEye}) {}

    std::vector<int> all() const {
        std::vector<int> values;
        for (int x = 0; x < crossings.width; ++x) values.push_back(mask.value(x, 0));
        return values;
    }
    std::vector<bool> shadows() const {
        std::vector<bool> shadow;
        for (const int value : all()) shadow.push_back(mask.isShadow(value));
        return shadow;
    }

    const Plan plan;
    const Crossings crossings;
    MaskPrediction mask;
};

/// Fronts, then backs, count in a stencil of 8 bits.
Plan stencilPlan(StencilOp front, StencilOp back, int start, int pixels) {
    const auto counts = [](Faces faces, StencilOp op) {
        Pass pass{.kind = PassKind::Volume, .parts = Part::Sides | Part::FarCap, .faces = faces};
        pass.depthTest = true;
        pass.depthFunction = Compare::Lequal;
        pass.write = kWriteNothing;
        pass.stencil = {.enabled = true, .front = {.onPass = op}, .back = {.onPass = op}};
        return pass;
    };
    Plan plan{.width = pixels, .height = 1};
    Pass clear{.kind = PassKind::Clear};
    clear.clearsStencil = true;
    clear.stencilValue = start;
    plan.passes = {clear, counts(Faces::Front, front), counts(Faces::Back, back)};
    plan.masks = {{.after = 3,
                   .place = MaskPlace::Stencil,
                   .test = {.enabled = true, .function = Compare::Notequal, .reference = start}}};
    return plan;
}

/// Every face adds to a colour mask of so many bits.
Plan addingPlan(BlendEquation equation, float up, float down, int pixels) {
    const auto adds = [&](Faces faces, float value) {
        Pass pass{.kind = PassKind::Volume, .parts = Part::Sides | Part::FarCap, .faces = faces};
        pass.depthTest = true;
        pass.depthFunction = Compare::Lequal;
        pass.colour = glm::vec4(value);
        pass.blend = {.enabled = true,
                      .source = BlendFactor::One,
                      .destination = BlendFactor::One,
                      .equation = equation};
        return pass;
    };
    Plan plan{.width = pixels, .height = 1};
    Pass clear{.kind = PassKind::Clear};
    clear.colour = glm::vec4(0);
    plan.passes = {clear, adds(Faces::Front, up), adds(Faces::Back, down)};
    plan.masks = {{.after = 3, .place = MaskPlace::Colour}};
    return plan;
}

TEST(MaskPrediction, CountsUpAndDown) {
    const Predicted p(stencilPlan(StencilOp::Incr, StencilOp::Decr, 0, 5),
                      {{}, {in()}, {in(), out()}, {in(), in(), out()}, {in(), behind(out())}});
    EXPECT_THAT(p.all(), ElementsAre(0, 1, 0, 1, 1));
    EXPECT_THAT(p.shadows(), ElementsAre(false, true, false, true, true));
}

TEST(MaskPrediction, SaturatesWhereTheStencilDoes) {
    const Predicted p(stencilPlan(StencilOp::Incr, StencilOp::Decr, 254, 4),
                      {times(1, in()), times(3, in()), times(3, in()) + times(3, out()), times(3, out())});
    EXPECT_THAT(p.all(), ElementsAre(255, 255, 252, 251));
    // One volume holds the second, none the third; what is lost shows as a shadow.
    EXPECT_EQ(p.mask.unlimitedCount(2, 0), 0);
    EXPECT_TRUE(p.mask.isShadow(p.mask.value(2, 0)));
    EXPECT_FALSE(p.mask.wraps());
}

TEST(MaskPrediction, SaturatesBelowToo) {
    const Predicted p(stencilPlan(StencilOp::Decr, StencilOp::Incr, 1, 1),
                      {times(3, in()) + times(3, out())});
    EXPECT_THAT(p.all(), ElementsAre(3));
}

TEST(MaskPrediction, WrapsWhereTheStencilDoes) {
    const Predicted p(stencilPlan(StencilOp::IncrWrap, StencilOp::DecrWrap, 0, 4),
                      {times(255, in()), times(256, in()), times(257, in()), times(2, out())});
    EXPECT_THAT(p.all(), ElementsAre(255, 0, 1, 254));
    EXPECT_EQ(p.mask.unlimitedCount(1, 0), 256);
    EXPECT_FALSE(p.mask.isShadow(0));
    EXPECT_TRUE(p.mask.wraps());
}

TEST(MaskPrediction, ClampsSumsInAColourChannel) {
    const Predicted p(addingPlan(BlendEquation::Add, 100 / 255.0f, 0, 3),
                      {times(1, in()), times(2, in()), times(3, in())});
    EXPECT_THAT(p.all(), ElementsAre(100, 200, 255));
}

TEST(MaskPrediction, WrapsSumsInAColourChannel) {
    // The step down is one code less than none.
    const Predicted p(
        addingPlan(BlendEquation::AddWrap, 1 / 255.0f, 1, 4),
        {times(255, in()), times(256, in()), times(3, out()), times(3, in()) + times(3, out())});
    EXPECT_THAT(p.all(), ElementsAre(255, 0, 253, 0));
    EXPECT_TRUE(p.mask.wraps());
    EXPECT_TRUE(p.mask.hasCodes());
}

TEST(MaskPrediction, WrapsSumsOfFewerBits) {
    const Predicted p(addingPlan(BlendEquation::AddWrap, 8 / 255.0f, 1, 2),
                      {times(31, in()), times(33, in())}, {.format = {"565", 5, 6, 5, 0}});
    EXPECT_THAT(p.all(), ElementsAre(31, 1));
}

TEST(MaskPrediction, InvertsForEachFaceWithParity) {
    const Predicted p(stencilPlan(StencilOp::Invert, StencilOp::Invert, 0, 4),
                      {{in()}, {in(), in()}, {in(), out()}, {in(), in(), out()}});
    EXPECT_THAT(p.all(), ElementsAre(255, 0, 0, 255));
    EXPECT_EQ(p.mask.unlimitedCount(1, 0), 2);
}

// A mask of two levels starts at a quarter: a third front clamps, and after two backs it is a quarter again.
TEST(MaskPrediction, EndsLitAfterThreeFrontsAndTwoBacksOfTwoLevels) {
    const Predicted p(
        planOf(method("roettger-screen"), 4),
        {{}, times(1, in()), times(3, in()) + times(2, out()), times(2, in()) + times(1, out())});
    EXPECT_THAT(p.shadows(), ElementsAre(false, true, false, true));
    EXPECT_EQ(p.mask.value(2, 0), p.mask.value(0, 0));
    EXPECT_EQ(p.mask.unlimitedCount(2, 0), 1);
}

TEST(MaskPrediction, HoldsThreeFrontsWithThreeLevels) {
    Axes axes = method("roettger-screen");
    axes.levels = 3;
    const Predicted p(planOf(axes, 2), {times(3, in()) + times(2, out()), times(3, in()) + times(3, out())});
    EXPECT_THAT(p.shadows(), ElementsAre(true, false));
}

// Each volume is left before the next is entered, so that they don't add up to three fronts.
TEST(MaskPrediction, DrawsVolumeAfterVolume) {
    const auto three = Signature{in(0), in(1), in(2), out(0), out(1)};
    const Predicted p(planOf(method("roettger-screen"), 1, 3), {three});
    EXPECT_THAT(p.shadows(), ElementsAre(true));
}

// What the first volume clamps away is not there for the second; the other way round it would be.
TEST(MaskPrediction, DrawsVolumesInThePlansOrder) {
    const Plan plan = planOf(method("roettger-screen"), 1, 2);
    const Crossings rays = row({times(3, in(0)) + times(3, out(0)) + times(2, in(1))});
    const auto isShadow = [&](const std::vector<int>& order) {
        const MaskPrediction mask(
            {.plan = plan, .crossings = rays, .arithmetic = kEightBits, .planVolumes = order});
        return mask.isShadow(mask.value(0, 0));
    };
    // From a quarter: up to 1 and down to an eighth, up to a half. Or up to 1, where it stays, down to an
    // eighth.
    EXPECT_TRUE(isShadow({0, 1}));
    EXPECT_FALSE(isShadow({1, 0}));
}

TEST(MaskPrediction, CountsBehindTheSurfaceByDepthFail) {
    const Predicted p(planOf(method("carmack"), 3),
                      {{in(), behind(out())}, {in(), out()}, {behind(in()), behind(out()), farCap()}});
    EXPECT_THAT(p.shadows(), ElementsAre(true, false, true));
}

// ---- Doubt ----

TEST(MaskPrediction, AllowsBothValuesOfADoubtfulCrossingAndNoOthers) {
    const Predicted p(stencilPlan(StencilOp::Incr, StencilOp::Decr, 0, 3),
                      {{in(), doubtful(in(1), kBefore | kBehind)},
                       {in(), doubtful(out(), kBefore | kMaybeAbsent)},
                       {in(), doubtful(in(), kBefore | kAt)}});
    EXPECT_THAT(p.all(), ElementsAre(2, 0, 2));
    EXPECT_THAT(p.mask.values(0, 0), ElementsAre(1, 2));
    EXPECT_THAT(p.mask.values(1, 0), ElementsAre(0, 1));
    // LEQUAL passes what lies at the surface too.
    EXPECT_THAT(p.mask.values(2, 0), ElementsAre(2));
    EXPECT_TRUE(p.mask.allows(0, 0, 1));
    EXPECT_FALSE(p.mask.allows(0, 0, 0));
    EXPECT_FALSE(p.mask.allows(0, 0, 3));
}

TEST(MaskPrediction, AllowsEachWayOfSeveralDoubtfulCrossings) {
    const Crossing maybe = doubtful(in(), kBefore | kBehind);
    const Predicted p(stencilPlan(StencilOp::Incr, StencilOp::Decr, 0, 2),
                      {times(3, maybe), times(2, maybe) + times(1, out())});
    EXPECT_THAT(p.mask.values(0, 0), ElementsAre(0, 1, 2, 3));
    // A decrement of nothing stays nothing.
    EXPECT_THAT(p.mask.values(1, 0), ElementsAre(0, 1));
}

TEST(MaskPrediction, AllowsWhatAnyPossibleSurfaceGives) {
    Crossings rays = row({{in()}, {in()}});
    rays.signatures.push_back(times(3, in()));
    rays.others[1] = {2};
    const Predicted p(stencilPlan(StencilOp::Incr, StencilOp::Decr, 0, 2), rays);
    EXPECT_THAT(p.mask.values(0, 0), ElementsAre(1));
    EXPECT_THAT(p.mask.values(1, 0), ElementsAre(1, 3));
    EXPECT_EQ(p.mask.value(1, 0), 1);
    EXPECT_EQ(p.mask.doubt(0, 0), MaskPrediction::Doubt::None);
    EXPECT_EQ(p.mask.doubt(1, 0), MaskPrediction::Doubt::Others);
}

TEST(MaskPrediction, SaysWhetherAllDoubtIsTheSeenTrianglesOwn) {
    Crossing own = doubtful(in(), kBefore | kBehind);
    own.own = true;
    const Crossing other = doubtful(in(1), kBefore | kBehind);
    const Predicted p(stencilPlan(StencilOp::Incr, StencilOp::Decr, 0, 3), {{own}, {own, other}, {in()}});
    EXPECT_EQ(p.mask.doubt(0, 0), MaskPrediction::Doubt::Own);
    EXPECT_EQ(p.mask.doubt(1, 0), MaskPrediction::Doubt::Others);
    EXPECT_EQ(p.mask.doubt(2, 0), MaskPrediction::Doubt::None);
}

TEST(MaskPrediction, AllowsNothingWhereThePlanLeavesOutAVolume) {
    const Plan plan = planOf(method("roettger-screen"), 2, 1);
    const Crossings rays = row({{in(0), in(1)}, {in(0)}});
    const std::vector<int> drawn{0, -1};
    const MaskPrediction mask(
        {.plan = plan, .crossings = rays, .arithmetic = kEightBits, .planVolumes = drawn});
    EXPECT_TRUE(mask.values(0, 0).empty());
    EXPECT_FALSE(mask.values(1, 0).empty());
}

TEST(MaskPrediction, AllowsNothingWhereThePlanLeavesOutTheFirstVolumeOrOneAfterAnother) {
    const Plan plan = planOf(method("roettger-screen"), 3, 1);
    const Crossing unsure = doubtful(in(0), kBefore | kMaybeAbsent);
    const Crossings rays = row({{in(0), in(2)}, {unsure, in(1), in(2)}, {unsure, in(2)}});
    const std::vector<int> drawn{-1, -1, 0};
    const MaskPrediction mask(
        {.plan = plan, .crossings = rays, .arithmetic = kEightBits, .planVolumes = drawn});
    EXPECT_TRUE(mask.values(0, 0).empty());
    EXPECT_TRUE(mask.values(1, 0).empty());
    // The first need not be there.
    EXPECT_FALSE(mask.values(2, 0).empty());
}

// ---- Starts ----

TEST(MaskPrediction, StartsFromWhatHidesTheEye) {
    const Axes axes{.store = Store::Stencil, .count = Count::PlusPlusZp};
    const Predicted p(planOf(axes, 2), row({{}, {out()}}), kEightBits, 1);
    EXPECT_THAT(p.all(), ElementsAre(1, 0));
    EXPECT_TRUE(p.mask.startsAtEye());
    EXPECT_EQ(p.mask.unlimitedCount(0, 0), 1);
}

TEST(MaskPrediction, KnowsOfNearCapsThatNoPassCounts) {
    const Predicted open(planOf(method("heidmann"), 2), {{nearCap(), out()}, {nearCap()}});
    EXPECT_TRUE(open.mask.countsFromEye());
    EXPECT_EQ(open.mask.uncountedNearCaps(0, 0), 1);
    EXPECT_FALSE(open.mask.isShadow(open.mask.value(1, 0)));

    const Axes capped{.store = Store::Stencil, .count = Count::ZpassCap};
    const Predicted closed(planOf(capped, 2), {{nearCap(), out()}, {nearCap()}});
    EXPECT_EQ(closed.mask.uncountedNearCaps(0, 0), 0);
    EXPECT_THAT(closed.shadows(), ElementsAre(false, true));
    const Predicted fromInfinity(planOf(method("carmack"), 1), row({{}}));
    EXPECT_FALSE(fromInfinity.mask.countsFromEye());
}

// ---- The window ----

TEST(WindowPrediction, AllowsTheMasksValuesPixelByPixel) {
    Predicted p(stencilPlan(StencilOp::Incr, StencilOp::Decr, 0, 2), {{in()}, {}});
    const WindowPrediction window(p.plan, p.mask, 8);
    EXPECT_TRUE(window.shadow(0));
    EXPECT_FALSE(window.shadow(1));
    EXPECT_TRUE(window.allows(0, 1));
    EXPECT_FALSE(window.allows(0, 0));
    EXPECT_FALSE(window.allows(0, 2));
}

// Four pixels of the window see two of the mask: the outer ones each their own, the inner ones three quarters
// of it.
TEST(WindowPrediction, StretchesAMaskOfFewerPixels) {
    Plan plan = planOf(method("roettger-half"), 4);
    Predicted p(plan, {{in()}, {}});
    const WindowPrediction window(p.plan, p.mask, 8);
    const double shadow = p.mask.shown(p.mask.value(0, 0)), light = p.mask.shown(p.mask.value(1, 0));
    ASSERT_LT(shadow, light - 100);
    for (int x = 0; x < 4; ++x) {
        const double weight = std::array{1.0, 0.75, 0.25, 0.0}[std::size_t(x)];
        const int value = int(shadow * weight + light * (1 - weight));
        EXPECT_TRUE(window.allows(std::size_t(x), value)) << x;
        EXPECT_FALSE(window.allows(std::size_t(x), value + 10)) << x;
        EXPECT_FALSE(window.allows(std::size_t(x), value - 10)) << x;
        EXPECT_EQ(window.shadow(std::size_t(x)), x < 2) << x;
        EXPECT_EQ(window.maskPixel(std::size_t(x)), glm::ivec2(x / 2, 0));
    }
}

}  // namespace mask_prediction_test
}  // namespace gnomon
