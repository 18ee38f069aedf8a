// The automatic method is exact wherever any method is, and says so where none is.

#include "matrix/choice.h"

#include <gmock/gmock.h>

#include "shipped_scenes.h"

namespace gnomon {
namespace choice_test {

class ChosenMethods : public testing::TestWithParam<std::string> {};

TEST_P(ChosenMethods, AreExactWhereverAnyMethodIs) {
    Lab lab(shippedScene(GetParam()));
    const int frames = int(lab.scene().frames.size());
    for (int frame = 0; frame < frames; frame += wantsAllChips() ? 1 : std::max(1, frames / 2)) {
        for (const Profile& profile : chipsOfEachKind(GetParam())) {
            bool anyIsExact = false, anyRuns = false;
            int fewest = 64 * 48;
            for (const NamedMethod& named : namedMethods()) {
                if (named.axes.automatic || named.axes.store == Store::None) continue;
                const Cell cell = lab.run(profile, named.axes, 64, 48, frame);
                if (cell.verdict == Verdict::Refused) continue;
                anyRuns = true;
                anyIsExact = anyIsExact || cell.verdict == Verdict::Exact;
                fewest = std::min(fewest, cell.wrongEdge + cell.wrongInterior);
            }
            const Cell chosen = lab.run(profile, method("auto"), 64, 48, frame);
            const std::string what = chosen.id() + " by " + chosen.drawnBy + ": " + resultOf(chosen);
            if (!anyRuns) {
                EXPECT_EQ(chosen.verdict, Verdict::Refused) << what;
                EXPECT_EQ(chosen.proof, Proof::Refused) << what;
            } else if (anyIsExact) {
                EXPECT_EQ(chosen.verdict, Verdict::Exact) << what;
                EXPECT_NE(chosen.proof, Proof::None) << what;
            } else if (chosen.verdict != Verdict::Exact) {  // more levels than any row has may do
                EXPECT_EQ(chosen.proof, Proof::None) << what;
                EXPECT_LE(chosen.wrongEdge + chosen.wrongInterior, fewest) << what;
            }
            EXPECT_EQ(chosen.unpredicted, 0) << what;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ChosenMethods, testing::ValuesIn(allSceneIds()),
                         [](const auto& test) { return testNameOf(test.param); });

TEST(Options, AreSortedByTheModelOrElseByWhatTheyTouch) {
    Lab lab(shippedScene("boxes"));
    for (const char* id : {"ideal", "voodoo2"}) {
        const Profile profile = chip(id);
        const auto all = options(lab, profile, Shade::Attenuated, 96, 72, 0);
        EXPECT_EQ(all.size(), namedMethods().size() - 2) << "all but none and auto";
        for (std::size_t i = 1; i < all.size() && all[i].missing.empty(); ++i) {
            EXPECT_TRUE(all[i - 1].missing.empty()) << all[i].method;
            EXPECT_EQ(all[i].cost.ms() > 0, hasModelRates(profile)) << id << " " << all[i].method;
            if (hasModelRates(profile))
                EXPECT_LE(rankedNs(all[i - 1].cost), rankedNs(all[i].cost)) << all[i].method;
            else
                EXPECT_LE(all[i - 1].amount.pixels.total(), all[i].amount.pixels.total()) << all[i].method;
        }
    }
}

TEST(Options, OfAChipWithRatesCountTheFragmentsThatPass) {
    Lab lab(shippedScene("boxes"));
    for (const Option& option : options(lab, chip("tnt"), Shade::Attenuated, 96, 72, 0)) {
        if (!option.missing.empty()) continue;
        ASSERT_EQ(option.cost.passes.size(), option.plan.plan.passes.size()) << option.method;
        EXPECT_TRUE(option.cost.countsPassed) << option.method;
    }
}

// What is cheaper than the choice is wrong, or not proved.
TEST(Choice, IsTheCheapestThatIsExact) {
    Lab lab(shippedScene("hard/eye-inside-one"));
    const Profile profile = chip("ideal");
    const auto all = options(lab, profile, Shade::Attenuated, 96, 72, 0);
    const Choice choice = choose(lab, profile, all, 96, 72, 0);
    EXPECT_EQ(choice.proof, Proof::Predicted);
    EXPECT_NE(choice.option.method, "heidmann") << "it has no cap where the eye is inside a volume";
    lab.simulate(Effects::none());
    for (const Option& option : all) {
        if (option.method == choice.option.method) break;
        EXPECT_GT(lab.wrongPixels(profile, option.plan, 96, 72, 0), 0) << option.method;
    }
}

TEST(Choice, HasTheLevelsThatTheFrameCallsFor) {
    Lab lab(shippedScene("hard/nesting-3"));
    const auto all = options(lab, chip("voodoo2"), Shade::Attenuated, 96, 72, 0);
    const Choice choice = choose(lab, chip("voodoo2"), all, 96, 72, 0);
    EXPECT_EQ(choice.option.axes.arithmetic, Arithmetic::Double);
    EXPECT_GT(choice.option.axes.levels, 2);
    EXPECT_EQ(choice.proof, Proof::Predicted);
}

}  // namespace choice_test
}  // namespace gnomon
