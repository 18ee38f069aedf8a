// Plans whose passes are bounded by rectangles, beside the same plans without, over rays whose crossings are
// written down by hand; and volumes that a plan leaves out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>

#include "predict/bounded_plan.h"
#include "predict/causes.h"
#include "predict/mask_prediction.h"
#include "rays.h"

namespace gnomon {
namespace bounded_prediction_test {

using testing::ElementsAre;

constexpr int kWidth = 24, kHeight = 16;

// Rows from the bottom. They overlap, and no side lies in the middle of the window.
const WindowRect kFirst{3, 2, 9, 7}, kSecond{8, 5, 13, 6};

/// A window in which @p rayAt says what a pixel's ray crosses; rows from the bottom. Equal rays share a
/// signature.
Crossings window(const std::function<Signature(int x, int y)>& rayAt) {
    Crossings all{.width = kWidth, .height = kHeight};
    for (int row = 0; row < kHeight; ++row) {
        for (int x = 0; x < kWidth; ++x) {
            Signature ray = rayAt(x, kHeight - 1 - row);
            std::sort(ray.begin(), ray.end());
            const auto same = std::find(all.signatures.begin(), all.signatures.end(), ray);
            all.exact.push_back(std::uint32_t(same - all.signatures.begin()));
            if (same == all.signatures.end()) all.signatures.push_back(std::move(ray));
        }
    }
    return all;
}

/// Each volume holds what is seen in all of its rectangle, and is crossed everywhere else too: entered and
/// left, before the surface or behind it.
Crossings twoVolumes() {
    return window([](int x, int y) {
        Signature ray;
        for (const std::uint32_t v : {0u, 1u}) {
            const bool holds = (v == 0 ? kFirst : kSecond).holds(x, y);
            const bool isBehind = !holds && (x + y) % 3 == 0;
            ray.push_back(isBehind ? behind(in(v)) : in(v));
            ray.push_back(holds || isBehind ? behind(out(v)) : out(v));
        }
        return ray;
    });
}

MaskWindow boundsOf(const WindowRect& first, const WindowRect& second) {
    return {around(first, second), {first, second}};
}

const MaskWindow kBounds = boundsOf(kFirst, kSecond);

struct Way {
    const char* title;
    Axes axes;
};
void PrintTo(const Way& way, std::ostream* out) {
    *out << way.title;
}

/// Stores, counts and arithmetics; volumes at once and one by one.
class BoundedMask : public testing::TestWithParam<Way> {
  protected:
    Plan wholePlan() const {
        return planFrame(GetParam().axes, {.width = kWidth, .height = kHeight, .lights = {{.volumes = 2}}},
                         idealChip());
    }
    MaskPrediction predicted(const Plan& plan, const Crossings& crossings,
                             std::span<const int> planVolumes = {}) const {
        return MaskPrediction(
            {.plan = plan, .crossings = crossings, .arithmetic = kEightBits, .planVolumes = planVolumes});
    }
    Plan boundedPlan(const MaskWindow& bounds) const {
        const Plan whole = wholePlan();
        const Crossings nothing = window([](int, int) { return Signature{}; });
        const MaskPrediction mask = predicted(whole, nothing);
        return boundTo(whole, bounds, mask.shown(mask.value(0, 0)));
    }
};

INSTANTIATE_TEST_SUITE_P(
    Methods, BoundedMask,
    testing::Values(Way{"heidmann", method("heidmann")}, Way{"carmack", method("carmack")},
                    Way{"parity", method("parity")}, Way{"screen", method("roettger-screen")},
                    Way{"screen_max", method("roettger-screen-max")}, Way{"alpha", method("roettger-alpha")},
                    Way{"texture", method("screen-texture")}, Way{"screen_zfail", method("screen-zfail")},
                    Way{"counter", method("counter")}, Way{"screen_count", method("screen-count")},
                    Way{"alpha_count", method("alpha-count")}),
    [](const auto& test) { return test.param.title; });

// ---- Equal ----

TEST_P(BoundedMask, IsTheWholeOneWhereFacesCancelOutsideOfTheirRectangles) {
    const Crossings crossings = twoVolumes();
    const Plan whole = wholePlan(), bounded = boundedPlan(kBounds);
    const MaskPrediction full = predicted(whole, crossings), mask = predicted(bounded, crossings);
    int shadows = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            SCOPED_TRACE(testing::Message() << x << "," << y << " from the top");
            const int value = mask.value(x, y);
            ASSERT_EQ(value, full.value(x, y));
            ASSERT_THAT(mask.values(x, y), testing::ElementsAreArray(full.values(x, y)));
            ASSERT_EQ(mask.isShadow(value), full.isShadow(full.value(x, y)));
            ASSERT_EQ(mask.unlimitedCount(x, y), full.unlimitedCount(x, y));
            ASSERT_EQ(mask.unlimitedCounts(x, y), full.unlimitedCounts(x, y));
            ASSERT_EQ(mask.uncountedNearCaps(x, y), 0);
            shadows += mask.isShadow(value);
        }
    }
    ASSERT_GE(shadows, kFirst.width * kFirst.height);
}

// What counts one volume by itself has its rectangle too.
TEST(BoundedParity, IsTheWholeOneWithRectanglesAndClearsInTheVolumes) {
    const Crossings crossings = twoVolumes();
    const Plan whole = planFrame(
        method("parity"), {.width = kWidth, .height = kHeight, .lights = {{.volumes = 2}}}, idealChip());
    Plan bounded = boundTo(whole, kBounds, 0);
    int volume = kAllVolumes, count = 0;
    for (Pass& pass : bounded.passes) {
        if (pass.kind == PassKind::Volume) volume = pass.volume;
        if (pass.kind == PassKind::Volume || pass.extent == Extent::Whole || volume < 0) continue;
        pass.extent = Extent::Volumes, pass.volume = volume;
        ++count;
    }
    ASSERT_GE(count, 3);
    const MaskPrediction full({.plan = whole, .crossings = crossings, .arithmetic = kEightBits}),
        mask({.plan = bounded, .crossings = crossings, .arithmetic = kEightBits});
    Plan lost = bounded;
    lost.windows = {boundsOf(kFirst, {})};
    const MaskPrediction without({.plan = lost, .crossings = crossings, .arithmetic = kEightBits});
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            ASSERT_EQ(mask.value(x, y), full.value(x, y));
            ASSERT_EQ(without.isShadow(without.value(x, y)), kFirst.holds(x, kHeight - 1 - y));
        }
    }
}

// ---- A pixel too small ----

/// @p r without its first or last column or row, and what that takes away.
std::vector<std::pair<WindowRect, WindowRect>> shrunk(const WindowRect& r) {
    return {{{r.x + 1, r.y, r.width - 1, r.height}, {r.x, r.y, 1, r.height}},
            {{r.x, r.y, r.width - 1, r.height}, {r.x + r.width - 1, r.y, 1, r.height}},
            {{r.x, r.y + 1, r.width, r.height - 1}, {r.x, r.y, r.width, 1}},
            {{r.x, r.y, r.width, r.height - 1}, {r.x, r.y + r.height - 1, r.width, 1}}};
}

TEST_P(BoundedMask, IsAnotherIfARectangleIsOnePixelTooSmall) {
    const Crossings crossings = twoVolumes();
    const Plan whole = boundedPlan(kBounds);
    const MaskPrediction full = predicted(whole, crossings);
    for (const int volume : {0, 1}) {
        for (const auto& [part, lost] : shrunk(kBounds.volumes[std::size_t(volume)])) {
            MaskWindow bounds = kBounds;
            bounds.volumes[std::size_t(volume)] = part;
            const Plan plan = boundedPlan(bounds);
            const MaskPrediction mask = predicted(plan, crossings);
            int differing = 0, lit = 0, inside = 0;
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    const bool isLost = lost.holds(x, kHeight - 1 - y);
                    const bool differs = mask.value(x, y) != full.value(x, y);
                    EXPECT_TRUE(isLost || !differs) << x << "," << y;
                    const int count = full.unlimitedCount(x, y);
                    EXPECT_EQ(mask.unlimitedCount(x, y), count - (isLost ? std::clamp(count, -1, 1) : 0));
                    const bool isLit = !mask.isShadow(mask.value(x, y));
                    differing += differs, lit += isLost && isLit, inside += isLost;
                }
            }
            EXPECT_GT(differing, 0) << "volume " << volume;
            EXPECT_GT(lit, 0) << "shadows of one volume alone are gone";
            EXPECT_LE(differing, inside);
        }
    }
}

// What the rectangle of all shadows leaves out keeps the value of a lit pixel, whatever volumes do.
TEST_P(BoundedMask, IsLitOutsideOfTheRectangleOfAllShadows) {
    const Crossings crossings = twoVolumes();
    for (const auto& [part, lost] : shrunk(kBounds.all)) {
        Plan plan = boundedPlan({part, kBounds.volumes});
        for (Pass& pass : plan.passes)
            if (pass.kind == PassKind::Volume) pass.extent = Extent::Shadows;
        const MaskPrediction mask = predicted(plan, crossings);
        int held = 0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                if (!lost.holds(x, kHeight - 1 - y)) continue;
                ASSERT_FALSE(mask.isShadow(mask.value(x, y)));
                ASSERT_EQ(mask.unlimitedCount(x, y), 0);
                ASSERT_EQ(mask.values(x, y).size(), 1u);
                held += kFirst.holds(x, kHeight - 1 - y) || kSecond.holds(x, kHeight - 1 - y);
            }
        }
        EXPECT_GT(held, 0) << "else nothing is shown";
    }
}

// ---- Doubt ----

// Faces that may be drawn or not are no matter where their pass does not reach.
TEST_P(BoundedMask, DoubtsOnlyWhatIsDrawn) {
    const Crossings crossings = window([](int x, int y) {
        const bool zfail = GetParam().axes.count == Count::Zfail;
        const Crossing face = zfail ? behind(out(1)) : in(1);
        const bool isThere = x == 2 && y == 2;
        return isThere ? Signature{doubtful(face, face.possible | kMaybeAbsent)} : Signature{};
    });
    const WindowRect both{0, 0, 8, 8}, beside{4, 0, 4, 8};
    const Plan plan = boundedPlan(boundsOf(both, both)), bounded = boundedPlan(boundsOf(both, beside));
    const MaskPrediction full = predicted(plan, crossings), mask = predicted(bounded, crossings);
    const int x = 2, y = kHeight - 1 - 2;
    EXPECT_EQ(full.doubt(x, y), MaskPrediction::Doubt::Others);
    EXPECT_GT(full.values(x, y).size(), 1u);
    EXPECT_EQ(mask.doubt(x, y), MaskPrediction::Doubt::None);
    EXPECT_EQ(mask.values(x, y).size(), 1u);
    const auto [least, most] = mask.unlimitedCounts(x, y);
    EXPECT_EQ(least, most);
    EXPECT_EQ(least, mask.unlimitedCount(x, y));
    EXPECT_TRUE(full.isShadow(full.value(x, y)));
    EXPECT_FALSE(mask.isShadow(mask.value(x, y)));
}

// ---- Left out ----

TEST_P(BoundedMask, IsAsIfAVolumeThatIsLeftOutWereNotThere) {
    const auto rays = [](bool both) {
        return window([both](int x, int y) {
            Signature ray;
            if (kFirst.holds(x, y)) ray = {in(0), behind(out(0))};
            if (both && x % 2 == 0)
                ray = ray + Signature{in(1), doubtful(out(1), kBefore | kBehind), nearCap(1)};
            return ray;
        });
    };
    const Crossings one = rays(false), two = rays(true);
    const std::vector<int> drawn{0, kLeftOut}, unseen{0, -1};
    const Plan plan = wholePlan();
    const MaskPrediction without = predicted(plan, one), mask = predicted(plan, two, drawn);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            ASSERT_THAT(mask.values(x, y), testing::ElementsAreArray(without.values(x, y)));
            ASSERT_EQ(mask.value(x, y), without.value(x, y));
            ASSERT_EQ(mask.unlimitedCounts(x, y), without.unlimitedCounts(x, y));
            ASSERT_EQ(mask.uncountedNearCaps(x, y), 0);
            ASSERT_EQ(mask.doubt(x, y), MaskPrediction::Doubt::None);
        }
    }
    // A volume that is there, and that no pass draws, is a fault of the plan's all the same.
    const bool isOneByOne = std::any_of(plan.passes.begin(), plan.passes.end(),
                                        [](const Pass& pass) { return pass.volume != kAllVolumes; });
    EXPECT_EQ(predicted(plan, two, unseen).values(4, kHeight - 1 - 3).empty(), isOneByOne);
}

// ---- Dithering ----

const MaskChannel kDithered{.openGl = false,
                            .unit = BlendUnit::VoodooMame,
                            .dither = DitherMode::Matrix4x4,
                            .format = {"565", 5, 6, 5, 0}};

// By pixel of the matrix and by rectangle: values are not mixed up.
TEST(DitheredMask, IsTheWholeOneWhereRectanglesHoldAll) {
    const Crossings crossings = twoVolumes();
    const Plan whole =
        planFrame(method("roettger-screen"), {.width = kWidth, .height = kHeight, .lights = {{.volumes = 2}}},
                  idealChip());
    const WindowRect all{0, 0, kWidth, kHeight};
    const Plan bounded = boundTo(whole, {all, {all, all}}, 0);
    const MaskPrediction full({.plan = whole, .crossings = crossings, .arithmetic = kDithered}),
        mask({.plan = bounded, .crossings = crossings, .arithmetic = kDithered});
    std::set<int> values;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            ASSERT_EQ(mask.value(x, y), full.value(x, y));
            values.insert(mask.value(x, y));
        }
    }
    EXPECT_GT(values.size(), 2u) << "the matrix shows";
}

// ---- Pixels without a mask ----

TEST(UndrawnMask, HoldsTheOneValueThatStandsForIt) {
    const Crossings crossings = twoVolumes();
    Plan plan = planFrame(method("screen-texture"),
                          {.width = kWidth, .height = kHeight, .lights = {{.volumes = 2}}}, idealChip());
    // Nothing clears what lies outside.
    plan = boundTo(plan, kBounds, 0);
    const Pass clearAll = plan.passes.front();
    plan.passes.erase(plan.passes.begin());
    MaskTap& tap = plan.masks.front();
    --tap.after;
    tap.outside = 250;
    // Nor does what another light's mask left there matter.
    Pass other = plan.passes[1];
    other.kind = PassKind::Volume, other.light = 1, other.extent = Extent::Whole;
    plan.passes.insert(plan.passes.begin(), {clearAll, other});
    tap.after += 2;
    plan.windows.push_back({});
    for (const MaskChannel& arithmetic : {kEightBits, kDithered}) {
        const MaskPrediction mask({.plan = plan, .crossings = crossings, .arithmetic = arithmetic});
        const int code = arithmetic.bits() == 8 ? 250 : 31;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                if (kBounds.all.holds(x, kHeight - 1 - y)) continue;
                ASSERT_EQ(mask.value(x, y), code);
                ASSERT_THAT(mask.values(x, y), ElementsAre(code));
                ASSERT_FALSE(mask.isShadow(code));
                ASSERT_EQ(mask.unlimitedCount(x, y), 0);
                ASSERT_EQ(mask.unlimitedCounts(x, y), std::pair(0, 0));
                ASSERT_EQ(mask.doubt(x, y), MaskPrediction::Doubt::None);
                ASSERT_TRUE(mask.isShownAs(x, y, code, 250));
                ASSERT_FALSE(mask.isShownAs(x, y, code, 251)) << "as it is read, not as a chip stores it";
            }
        }
        EXPECT_TRUE(mask.isShadow(mask.value(5, kHeight - 1 - 4)));
        EXPECT_NE(mask.value(5, kHeight - 1 - 4), code);
    }
}

// Faces of another light's volumes are not among the crossings.
TEST(UndrawnMask, IsNotWhatAnotherLightLeft) {
    Plan plan = boundTo(planOf(method("heidmann"), 2), {{0, 0, 1, 1}, {{0, 0, 1, 1}}}, 0);
    Pass other{.kind = PassKind::Volume, .light = 1};
    other.stencil.enabled = true;
    plan.passes.insert(plan.passes.begin() + 1, other);
    ++plan.masks.front().after;
    const Crossings crossings = row({{}, {}});
    const MaskInputs inputs{.plan = plan, .crossings = crossings, .arithmetic = kEightBits};
    EXPECT_THROW(MaskPrediction{inputs}, std::logic_error);
    plan.masks.front().outside = 0;
    EXPECT_NO_THROW(MaskPrediction{inputs});
}

// ---- Where the count starts ----

// The stencil is cleared to what hides the eye, but only where volumes matter.
TEST(BoundedStart, CountsTheEyeOnlyWithin) {
    Plan plan = planOf({.store = Store::Stencil, .count = Count::PlusPlusZp}, 3);
    const auto start = std::find_if(plan.passes.begin(), plan.passes.end(),
                                    [](const Pass& pass) { return pass.stencilIsBlockers; });
    ASSERT_NE(start, plan.passes.end());
    start->extent = Extent::Shadows;
    plan.windows = {{{1, 0, 2, 1}, {{1, 0, 2, 1}}}};
    const Crossings crossings = row({{}, {}, {out()}});
    for (const bool onFace : {false, true}) {
        const MaskPrediction mask({.plan = plan,
                                   .crossings = crossings,
                                   .arithmetic = kEightBits,
                                   .holdingEye = 1,
                                   .eyeOnFace = onFace});
        EXPECT_TRUE(mask.startsAtEye());
        for (int x = 0; x < 3; ++x) {
            EXPECT_EQ(mask.value(x, 0), x == 1) << x;
            EXPECT_EQ(mask.unlimitedCount(x, 0), x == 1) << x;
            EXPECT_EQ(mask.values(x, 0).size(), onFace && x > 0 ? 256u : 1u) << x;
        }
    }
}

// ---- Causes ----

/// Why the first pixel of @p plan is wrong.
Cause causeOf(const Plan& plan, const Crossings& crossings, bool blocked,
              const std::function<const Crossings&()>& fullSize = {}) {
    Truth truth;
    truth.width = plan.width, truth.height = plan.height;
    const auto pixels = std::size_t(plan.width * plan.height);
    truth.shadow.assign(pixels, blocked ? Shadow::InShadow : Shadow::Lit);
    truth.tie.assign(pixels, Tie::None);
    truth.facesAway.assign(pixels, false);
    truth.blocked.assign(pixels, blocked);
    const MaskInputs inputs{.plan = plan, .crossings = crossings, .arithmetic = kEightBits};
    MaskPrediction prediction(inputs);
    return Explainer({.truth = truth, .mask = inputs, .prediction = prediction, .fullSize = fullSize})
        .causeOf(pixels - 1);
}

// In the last of two pixels the second volume is not drawn.
Plan boundedRow(const Axes& axes) {
    const WindowRect both{0, 0, 2, 1}, first{0, 0, 1, 1};
    Plan plan = planOf(axes, 2, 2);
    for (Pass& pass : plan.passes)
        if (pass.kind == PassKind::Volume) pass.extent = Extent::Volumes;
    plan.windows = {{both, {both, first}}};
    return plan;
}

TEST(BoundedCauses, AreThoseOfTheWholePlan) {
    Axes saturating{.store = Store::Stencil, .count = Count::Zpass};
    saturating.overflow = Overflow::Saturate;
    const struct {
        Axes axes;
        Signature ray;
        bool blocked;
        Cause cause;
    } kCases[] = {
        {method("roettger-screen"), times(3, in()) + times(2, out()), true, Cause::MaskClamps},
        {saturating, times(256, in()) + times(255, out()), true, Cause::StencilSaturates},
        {method("heidmann"), times(256, in()), true, Cause::StencilWraps},
        {method("heidmann"), {out(), nearCap()}, false, Cause::NearPlaneCuts},
        {method("heidmann"), {doubtful(in(), kBefore | kBehind)}, true, Cause::DepthPrecision},
    };
    for (const auto& c : kCases) {
        const Crossings crossings = row({{}, c.ray + Signature{in(1), out(1)}});
        EXPECT_EQ(causeOf(planOf(c.axes, 2, 2), crossings, c.blocked), c.cause) << name(c.cause);
        EXPECT_EQ(causeOf(boundedRow(c.axes), crossings, c.blocked), c.cause) << name(c.cause);
    }
}

// A volume that is not drawn adds neither its faces nor its part of the near plane.
TEST(BoundedCauses, TakeNoNearCapOfAVolumeThatIsNotDrawn) {
    const Crossings crossings = row({{}, Signature{out(), nearCap()} + Signature{out(1), nearCap(1)}});
    EXPECT_EQ(causeOf(boundedRow(method("heidmann")), crossings, false), Cause::NearPlaneCuts);
}

TEST(BoundedCauses, OfATooSmallRectangleAreNone) {
    const Crossings crossings = row({{}, {in(1)}});
    EXPECT_EQ(causeOf(boundedRow(method("heidmann")), crossings, true), Cause::Unexplained);
}

// Rectangles are of the mask: of the window's 6 pixels the last two see its last one.
TEST(BoundedCauses, OfAMaskOfFewerPixelsAreItsResolution) {
    Plan plan = planOf(method("roettger-half"), 6);
    ASSERT_EQ(plan.maskWidth, 3);
    for (Pass& pass : plan.passes)
        if (pass.kind == PassKind::Volume) pass.extent = Extent::Volumes;
    plan.windows = {{{2, 0, 1, 1}, {{2, 0, 1, 1}}}};
    const Crossings mask = row({{}, {}, {}}), window = row({{}, {}, {}, {}, {}, {in()}});
    EXPECT_EQ(causeOf(plan, mask, true, [&]() -> const Crossings& { return window; }), Cause::MaskResolution);
    plan.windows = {{{0, 0, 2, 1}, {{0, 0, 2, 1}}}};
    EXPECT_EQ(causeOf(plan, mask, true, [&]() -> const Crossings& { return window; }), Cause::Unexplained);
}

// ---- Crossings that can't be ----

TEST(Crossings, ThatAreNowhereChangeNothing) {
    const Crossing nowhere = doubtful({.volume = 0, .piece = Piece::Side, .front = true}, kAbsent);
    const Plan plan = planOf(method("heidmann"), 1);
    const Crossings crossings = row({{nowhere, doubtful(in(), kBefore | kBehind)}});
    const MaskPrediction mask({.plan = plan, .crossings = crossings, .arithmetic = kEightBits});
    EXPECT_EQ(mask.unlimitedCounts(0, 0), std::pair(0, 1));
    EXPECT_THAT(mask.values(0, 0), ElementsAre(0, 1));
}

}  // namespace bounded_prediction_test
}  // namespace gnomon
