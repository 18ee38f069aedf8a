// Every cause that a mask can have, in the smallest window that shows it: rays whose crossings are written
// down by hand, and a truth that says what the mask should have held.

#include "predict/causes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays.h"

namespace gnomon {
namespace causes_test {

/// One pixel of which truth says whether it is blocked, and what its mask is made of.
struct Pixel {
    Pixel(bool blocked, const Axes& axes, Signature ray)
        : Pixel(blocked, planOf(axes, 1, 2), row({std::move(ray)})) {}
    Pixel(bool blocked, Plan p, Crossings c) : plan(std::move(p)), crossings(std::move(c)) {
        truth.width = plan.width, truth.height = plan.height;
        const auto pixels = std::size_t(plan.width * plan.height);
        truth.shadow.assign(pixels, blocked ? Shadow::InShadow : Shadow::Lit);
        truth.tie.assign(pixels, Tie::None);
        truth.facesAway.assign(pixels, false);
        truth.blocked.assign(pixels, blocked);
    }

    /// Why the mask is wrong there; @p change sets what else the explainer is told.
    Cause cause(const std::function<void(CauseInputs&)>& change = {}) {
        const MaskInputs inputs{.plan = plan,
                                .crossings = crossings,
                                .arithmetic = arithmetic,
                                .holdingEye = holdingEye,
                                .eyeOnFace = eyeOnFace};
        MaskPrediction prediction(inputs);
        CauseInputs in{.truth = truth, .mask = inputs, .prediction = prediction};
        if (change) change(in);
        return Explainer(in).causeOf(0);
    }

    Plan plan{};
    Crossings crossings{};
    Truth truth{};
    MaskChannel arithmetic = kEightBits;
    int holdingEye = 0;
    bool eyeOnFace = false;
};

Axes stencil(Count count) {
    return {.store = Store::Stencil, .count = count};
}

TEST(CauseNames, GoRound) {
    for (int i = 1; i < kCauses; ++i) {
        EXPECT_FALSE(name(Cause(i)).empty()) << i;
        EXPECT_EQ(causeNamed(name(Cause(i))), Cause(i));
        for (int k = 1; k < i; ++k) EXPECT_NE(name(Cause(i)), name(Cause(k)));
    }
    EXPECT_EQ(name(Cause::None), "");
    EXPECT_EQ(causeNamed("bad luck"), Cause::None);
    EXPECT_EQ(causeNamed(""), Cause::None);
}

// ---- What the mask can't hold ----

TEST(Causes, MaskClamps) {
    Pixel pixel(true, method("roettger-screen"), times(3, in()) + times(2, out()));
    EXPECT_EQ(pixel.cause(), Cause::MaskClamps);
}

TEST(Causes, MaskUnderflows) {
    // The ninth half of 255 is rounded up to 1, of which eight doubles make 255 again.
    Pixel pixel(true, method("roettger-screen-max"), times(9, in()) + times(8, out()));
    EXPECT_EQ(pixel.cause([](CauseInputs& in) { in.halves = true; }), Cause::MaskUnderflows);
}

TEST(Causes, MaskWraps) {
    Axes axes = method("screen-count");
    axes.overflow = Overflow::Wrap;
    Pixel pixel(true, axes, times(256, in()));
    EXPECT_EQ(pixel.cause(), Cause::MaskWraps);
}

TEST(Causes, StencilSaturates) {
    Axes axes = stencil(Count::Zpass);
    axes.overflow = Overflow::Saturate;
    Pixel pixel(true, axes, times(256, in()) + times(255, out()));
    EXPECT_EQ(pixel.cause(), Cause::StencilSaturates);
}

TEST(Causes, StencilWraps) {
    Pixel pixel(true, stencil(Count::Zpass), times(256, in()));
    EXPECT_EQ(pixel.cause(), Cause::StencilWraps);
}

TEST(Causes, ParityOverlaps) {
    const Axes axes{.store = Store::Stencil, .arithmetic = Arithmetic::Parity, .levels = 0};
    Pixel pixel(true, axes, times(2, in()));
    EXPECT_EQ(pixel.cause([](CauseInputs& in) { in.parity = true; }), Cause::ParityOverlaps);
}

// ---- The chip's arithmetic ----

TEST(Causes, RoundingResidue) {
    // Halves of codes with low bits of zero: three of them leave too little for three doubles.
    Pixel pixel(false, method("roettger-screen-max"), times(3, in()) + times(3, out()));
    pixel.arithmetic = {.openGl = false, .unit = BlendUnit::Nv2a, .format = {"565", 5, 6, 5, 0}};
    EXPECT_EQ(pixel.cause([](CauseInputs& in) { in.halves = true; }), Cause::RoundingResidue);
}

TEST(Causes, DitherDrift) {
    // The same at a place of the matrix that adds nothing; without dithering the Voodoo is right.
    Pixel pixel(false, method("roettger-screen-max"), times(3, in()) + times(3, out()));
    pixel.arithmetic = {.openGl = false,
                        .unit = BlendUnit::VoodooMame,
                        .dither = DitherMode::Matrix4x4,
                        .format = {"565", 5, 6, 5, 0}};
    EXPECT_EQ(pixel.cause([](CauseInputs& in) { in.halves = true; }), Cause::DitherDrift);
}

// ---- Where the count starts ----

TEST(Causes, EyeInside) {
    Pixel pixel(true, stencil(Count::Zpass), {nearCap()});
    pixel.holdingEye = 1;
    EXPECT_EQ(pixel.cause(), Cause::EyeInside);
}

TEST(Causes, NearPlaneCuts) {
    Pixel pixel(true, stencil(Count::Zpass), {nearCap()});
    EXPECT_EQ(pixel.cause(), Cause::NearPlaneCuts);
}

TEST(Causes, EyeOnFace) {
    Pixel pixel(true, stencil(Count::PlusPlusZp), {});
    pixel.eyeOnFace = true;
    EXPECT_EQ(pixel.cause(), Cause::EyeOnFace);
}

// ---- Which volumes are drawn ----

TEST(Causes, OpenCaster) {
    Pixel pixel(true, stencil(Count::Zpass), {in(), out()});
    const Crossings right = row({{in()}});
    EXPECT_EQ(pixel.cause([&](CauseInputs& in) { in.winding = [&]() -> const Crossings& { return right; }; }),
              Cause::OpenCaster);
    // Volumes that are as wrong explain nothing.
    const Crossings wrong = row({{}});
    EXPECT_EQ(pixel.cause([&](CauseInputs& in) { in.winding = [&]() -> const Crossings& { return wrong; }; }),
              Cause::Unexplained);
}

TEST(Causes, InsideOfCaster) {
    Pixel pixel(true, stencil(Count::Zfail), {});
    EXPECT_EQ(pixel.cause([](CauseInputs& in) { in.insideOut = true; }), Cause::InsideOfCaster);
}

TEST(Causes, VolumeOffset) {
    Pixel pixel(true, stencil(Count::Zfail), {});
    EXPECT_EQ(pixel.cause([](CauseInputs& in) { in.offset = true; }), Cause::VolumeOffset);
}

TEST(Causes, BackgroundInside) {
    Pixel pixel(false, stencil(Count::Zfail), {behind(out())});
    pixel.truth.shadow[0] = Shadow::Background;
    EXPECT_EQ(pixel.cause(), Cause::BackgroundInside);
}

// ---- Sampling: in exact arithmetic the mask is right ----

TEST(Causes, DepthPrecision) {
    Pixel pixel(true, stencil(Count::Zpass), {doubtful(in(), kBefore | kBehind)});
    EXPECT_EQ(pixel.cause(), Cause::DepthPrecision);
}

TEST(Causes, OwnCapAndSide) {
    Crossing own = doubtful(in(), kBefore | kBehind);
    own.own = true;
    Pixel pixel(true, stencil(Count::Zpass), {own});
    EXPECT_EQ(pixel.cause(), Cause::OwnCapAndSide);
}

TEST(Causes, MaskResolution) {
    // The mask's one pixel sees no volume; of the window's two the first lies in one.
    Pixel pixel(true, planOf(method("roettger-half"), 2), row({{}}));
    const Crossings window = row({{in()}, {}});
    EXPECT_EQ(
        pixel.cause([&](CauseInputs& in) { in.fullSize = [&]() -> const Crossings& { return window; }; }),
        Cause::MaskResolution);
}

TEST(Causes, Unexplained) {
    Pixel pixel(true, stencil(Count::Zpass), {});
    EXPECT_EQ(pixel.cause(), Cause::Unexplained);
}

}  // namespace causes_test
}  // namespace gnomon
