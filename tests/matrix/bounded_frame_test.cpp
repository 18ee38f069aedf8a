// Frames drawn by plans with hand-made bounds, beside the whole ones: masks equal to the bit, predicted, and
// explained where a rectangle is too small.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fault_rig.h"
#include "predict/bounded_plan.h"

namespace gnomon {
namespace bounded_frame_test {

/// For each volume that is drawn, the rectangle of pixels in which it holds what is seen, or may.
MaskWindow boundsOf(const FaultRig& rig) {
    const auto all = litCasters(rig.scene, rig.light(), rig.axes.silhouette, rig.axes.capFaces);
    const Crossings crossings =
        crossingsOf(rig.scene, all, rig.light(), rig.view, tiesOf(rig.format.depth, rig.arithmetic.depth));
    MaskWindow bounds;
    for (const std::uint32_t volume : rig.volumes.ordinals) {
        WindowRect part;
        for (std::uint32_t p = 0; p < crossings.exact.size(); ++p) {
            bool matters = false;
            crossings.each(p, [&](std::uint32_t s) {
                Signature own;
                for (const Crossing& c : crossings.signatures[s])
                    if (c.volume == volume) own.push_back(c);
                const auto isUnsure = [](const Crossing& c) { return !c.isSure(); };
                matters = matters || volumesAround(own) != 0 || std::any_of(own.begin(), own.end(), isUnsure);
            });
            const int x = int(p) % FaultRig::kWidth, y = FaultRig::kHeight - 1 - int(p) / FaultRig::kWidth;
            if (matters) part = around(part, {x, y, 1, 1});
        }
        bounds.volumes.push_back(part);
        bounds.all = around(bounds.all, part);
    }
    return bounds;
}

struct Drawn {
    const char* title;
    const char* method;
    const char* profile;
    Fidelity fidelity;
};
void PrintTo(const Drawn& d, std::ostream* out) {
    *out << d.title;
}

class BoundedFrame : public testing::TestWithParam<Drawn> {
  protected:
    FaultRig rig{{.scene = twoBoxes,
                  .profile = GetParam().profile,
                  .axes = findMethod(GetParam().method)->axes,
                  .fidelity = {.fidelity = GetParam().fidelity}}};
    const Plan whole = rig.plan;
    const Verified full = rig.draw();
    const MaskWindow bounds = boundsOf(rig);
    /// The first pixel sees the background.
    Plan boundedBy(const MaskWindow& window) const { return boundTo(whole, window, full.values.front()); }
};
INSTANTIATE_TEST_SUITE_P(Methods, BoundedFrame,
                         testing::Values(Drawn{"heidmann", "heidmann", "ideal", Fidelity::Gl},
                                         Drawn{"carmack", "carmack", "ideal", Fidelity::Gl},
                                         Drawn{"parity", "parity", "ideal", Fidelity::Gl},
                                         Drawn{"roettger_screen", "roettger-screen", "ideal", Fidelity::Gl},
                                         Drawn{"roettger_screen_voodoo2", "roettger-screen", "voodoo2",
                                               Fidelity::Chip},
                                         Drawn{"roettger_alpha_tnt", "roettger-alpha", "tnt", Fidelity::Chip},
                                         Drawn{"screen_texture_ps2", "screen-texture", "ps2", Fidelity::Chip},
                                         Drawn{"screen_count_ps2", "screen-count", "ps2", Fidelity::Chip}),
                         [](const auto& test) { return std::string(test.param.title); });

TEST_P(BoundedFrame, HoldsTheMaskOfTheWholeOne) {
    ASSERT_EQ(full.text(), "right");
    ASSERT_EQ(bounds.volumes.size(), 2u);
    ASSERT_LT(bounds.all.width * bounds.all.height, FaultRig::kWidth * FaultRig::kHeight * 3 / 4);
    rig.plan = boundedBy(bounds);
    const Verified got = rig.draw();
    EXPECT_EQ(got.values, full.values);
    EXPECT_EQ(got.text(), "right");
    EXPECT_EQ(rig.unpredictedBy({}), 0);
}

TEST_P(BoundedFrame, IsPredictedWhereARectangleIsTooSmall) {
    MaskWindow small = bounds;
    for (WindowRect& part : small.volumes) part.y += 6, part.height -= 6;
    rig.plan = boundedBy(small);
    const Verified got = rig.draw();
    EXPECT_GT(got.wrong, 20);
    EXPECT_EQ(got.unpredicted, 0);
    EXPECT_EQ(got.causes.size(), 1u);
    EXPECT_EQ(got.causes.count("unexplained"), 1u) << "the plan is at fault, and no chip";
    EXPECT_GT(rig.unpredictedBy([&](Belief& belief) { belief.plan = whole; }), 20);
}

}  // namespace bounded_frame_test
}  // namespace gnomon
