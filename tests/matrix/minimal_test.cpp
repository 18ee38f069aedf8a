// A plan with what its frame calls for shows the mask and the image of the full one, to the bit: every scene
// and hard case, chips of each kind, every method, along the camera path. GNOMON_MINIMAL=all in the
// environment makes it all chips and frames.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "matrix/lab.h"
#include "shipped_scenes.h"

namespace gnomon {
namespace minimal_test {

struct Shown {
    Cell cell{};
    Pictures pictures{};
};

Shown drawn(Lab& lab, const Effects& effects, const Profile& profile, const Axes& axes, int frame) {
    Shown shown;
    lab.simulate(effects);
    shown.cell = lab.run(profile, axes, 64, 48, frame, &shown.pictures);
    return shown;
}

/// Masks of lights that were left out have nothing to be compared with.
void expectSame(const Shown& full, const Shown& least, const std::string& what) {
    ASSERT_EQ(full.cell.verdict, least.cell.verdict) << what << ": " << least.cell.error;
    if (full.cell.verdict == Verdict::Refused) return;
    ASSERT_NE(full.cell.verdict, Verdict::Failed) << what;
    EXPECT_TRUE(full.pictures.image.data == least.pictures.image.data) << what << ": image";
    ASSERT_EQ(full.pictures.masks.size(), least.pictures.masks.size()) << what;
    for (std::size_t light = 0; light < full.pictures.masks.size(); ++light) {
        if (least.pictures.masks[light].empty()) continue;
        EXPECT_TRUE(full.pictures.masks[light] == least.pictures.masks[light])
            << what << ": mask of " << light;
    }
    EXPECT_EQ(least.cell.unpredicted, 0) << what;
}

class MinimalPlans : public testing::TestWithParam<std::string> {};

TEST_P(MinimalPlans, ShowWhatFullPlansShow) {
    Lab lab(shippedScene(GetParam()));
    const int frames = int(lab.scene().frames.size());
    const int step = wantsAllChips() ? 1 : std::max(1, frames / 3);
    std::int64_t touchedByFull = 0, touchedByLeast = 0;
    for (int frame = 0; frame < frames; frame += step) {
        for (const Profile& profile : chipsOfEachKind(GetParam())) {
            for (const NamedMethod& named : namedMethods()) {
                if (named.axes.automatic) continue;
                lab.simulate(Effects::all());
                const Cell full = lab.run(profile, named.axes, 64, 48, frame);
                if (full.verdict == Verdict::Refused) continue;
                lab.simulate(Effects::none());
                const Cell least = lab.run(profile, named.axes, 64, 48, frame);
                touchedByFull += full.touched.total(), touchedByLeast += least.touched.total();
                EXPECT_EQ(least.unpredicted, 0) << least.id();
                // The digest is over all masks and the image.
                if (full.digest != least.digest || full.digest.empty())
                    expectSame(drawn(lab, Effects::all(), profile, named.axes, frame),
                               drawn(lab, Effects::none(), profile, named.axes, frame), full.id());
            }
        }
    }
    EXPECT_LE(touchedByLeast, touchedByFull);
}

INSTANTIATE_TEST_SUITE_P(Scenes, MinimalPlans, testing::ValuesIn(allSceneIds()),
                         [](const auto& test) { return testNameOf(test.param); });

// The same where the chips' own arithmetic is emulated, with dithering too; a full plan emulates all draws.
TEST(MinimalPlan, ShowsWhatTheFullOneShowsInTheChipsArithmetic) {
    for (const char* scene : {"boxes", "hard/nesting-3"}) {
        Lab lab(shippedScene(scene));
        for (const bool dithers : {false, true}) {
            lab.use({.fidelity = Fidelity::Chip, .dithers = dithers});
            for (const char* profile : {"voodoo1", "ps2", "xbox", "xbox-565", "gamecube-888", "dreamcast"}) {
                for (const NamedMethod& named : namedMethods()) {
                    if (named.axes.automatic) continue;
                    const Shown full = drawn(lab, Effects::all(), chip(profile), named.axes, 0);
                    if (full.cell.verdict == Verdict::Refused) continue;
                    expectSame(full, drawn(lab, Effects::none(), chip(profile), named.axes, 0),
                               full.cell.id());
                }
            }
        }
    }
}

// Each effect by itself, kept though nothing calls for it.
TEST(MinimalPlan, IsTheFullOneWithAnyEffectsKept) {
    for (const char* scene : {"boxes", "hard/eye-inside-several", "knot"}) {
        Lab lab(shippedScene(scene));
        for (const char* id : {"heidmann", "carmack", "roettger-screen", "roettger-alpha", "screen-texture",
                               "roettger-half", "counter", "hornus", "eisemann", "parity", "alpha-count"}) {
            const Shown full = drawn(lab, Effects::all(), chip("ideal"), method(id), 0);
            for (int effect = 0; effect < kEffects; ++effect) {
                Effects kept;
                kept.add(Effect(effect));
                const Shown least = drawn(lab, kept, chip("ideal"), method(id), 0);
                expectSame(full, least, fmt::format("{} with {} kept", full.cell.id(), toString(kept)));
            }
        }
    }
}

}  // namespace minimal_test
}  // namespace gnomon
