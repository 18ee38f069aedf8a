// Predictions from a false belief must differ from what is drawn; plans that can't be right are followed, and
// their wrong pixels given their cause.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "fault_set_ups.h"

namespace gnomon {
namespace false_predictions_test {

// ---- The predictor: a frame without a fault, a belief with one ----

struct FalseBelief {
    std::string name{};
    SetUp setUp{};
    std::function<void(Belief&, const FaultRig&)> falsify{};
    int pixels = 0;  ///< that are not predicted; 0: any number but 0
};
void PrintTo(const FalseBelief& belief, std::ostream* out) {
    *out << belief.name;
}

/// Changes every crossing of every ray.
std::function<void(Belief&, const FaultRig&)> inCrossings(const std::function<void(Crossing&)>& change) {
    return [=](Belief& belief, const FaultRig&) {
        for (Signature& signature : belief.crossings.signatures) {
            for (Crossing& c : signature) change(c);
            std::sort(signature.begin(), signature.end());
        }
    };
}

/// Changes what the ray of one pixel deep in a shadow crosses, and of no other.
std::function<void(Belief&, const FaultRig&)> inOneRay(const std::function<void(Signature&)>& change) {
    return [=](Belief& belief, const FaultRig& rig) {
        const std::size_t deep = rig.shadowPixel();
        Crossings& all = belief.crossings;
        Signature signature = all.signatures[all.exact[deep]];
        change(signature);
        std::sort(signature.begin(), signature.end());
        all.exact[deep] = std::uint32_t(all.signatures.size());
        all.signatures.push_back(signature);
    };
}

std::uint8_t exchanged(std::uint8_t where) {
    return std::uint8_t((where & (kAt | kMaybeAbsent)) | (where & kBefore ? kBehind : 0) |
                        (where & kBehind ? kBefore : 0));
}

std::vector<FalseBelief> falseBeliefs() {
    const auto isSureEntry = [](const Crossing& c) {
        return c.piece == Piece::Side && c.front && c.exact == kBefore && c.isSure();
    };
    const auto dropEntry = [=](Signature& signature) {
        signature.erase(std::find_if(signature.begin(), signature.end(), isSureEntry));
    };
    return {
        {"CrossingDropped", kHeidmann, inOneRay(dropEntry), 1},
        {"EntriesDroppedOfADoubledMask", kScreen, inOneRay([](Signature& signature) {
             std::erase_if(signature, [](const Crossing& c) { return c.front; });
         }),
         1},
        {"CrossingFoundTwice", kHeidmann, inOneRay([=](Signature& signature) {
             signature.push_back(*std::find_if(signature.begin(), signature.end(), isSureEntry));
         }),
         1},
        {"NothingIsCrossedInOnePixel", kHeidmann, inOneRay([](Signature& signature) { signature.clear(); }),
         1},
        {"FrontAndBackExchanged", kHeidmann, inCrossings([](Crossing& c) { c.front = !c.front; })},
        {"FrontAndBackExchangedForDoubling", kScreen, inCrossings([](Crossing& c) { c.front = !c.front; })},
        {"FrontAndBackExchangedInOneRay", kHeidmann, inOneRay([=](Signature& signature) {
             std::find_if(signature.begin(), signature.end(), isSureEntry)->front = false;
         }),
         1},
        {"BeforeAndBehindExchanged", kHeidmann,
         inCrossings([](Crossing& c) { c.exact = exchanged(c.exact), c.possible = exchanged(c.possible); })},
        {"BeforeAndBehindExchangedFromInfinity", kCarmack,
         inCrossings([](Crossing& c) { c.exact = exchanged(c.exact), c.possible = exchanged(c.possible); })},
        {"FarCapsBehindTheSky", kHeidmannInSky, inCrossings([](Crossing& c) {
             if (c.piece == Piece::FarCap) c.exact = c.possible = kBehind;
         })},
        {"FarCapsForgotten", kCarmackBeforeLight, inCrossings([](Crossing& c) {
             if (c.piece == Piece::FarCap) c.exact = kAbsent, c.possible = kMaybeAbsent;
         })},
        {"NearCapsForgotten", kNearCapped, inCrossings([](Crossing& c) {
             if (c.piece == Piece::NearCap) c.exact = kAbsent, c.possible = kMaybeAbsent;
         })},
        {"LightCapsForgotten", kCarmack, inCrossings([](Crossing& c) {
             if (c.piece == Piece::LightCap) c.exact = kAbsent, c.possible = kMaybeAbsent;
         })},
        {"VolumesExchanged", kScreenInBooks,
         [](Belief& belief, const FaultRig&) { std::swap(belief.planVolumes[0], belief.planVolumes[1]); }},
        {"OneVolumeForAll", kScreenInBooks, inCrossings([](Crossing& c) { c.volume = 0; })},
        {"VolumeTakenForUndrawn", kScreen,
         [](Belief& belief, const FaultRig&) { belief.planVolumes[1] = -1; }},
        {"ImageShiftedByAPixel", kHeidmann,
         [](Belief& belief, const FaultRig&) {
             auto& exact = belief.crossings.exact;
             std::rotate(exact.begin(), exact.begin() + 1, exact.end());
         }},
        {"ImageShiftedByARow", kScreen,
         [](Belief& belief, const FaultRig&) {
             auto& exact = belief.crossings.exact;
             std::rotate(exact.begin(), exact.begin() + FaultRig::kWidth, exact.end());
         }},
        {"CountStartsAtOne", kHeidmann,
         [](Belief& belief, const FaultRig&) { belief.plan.passes[0].stencilValue = 1; }},
        {"MaskStartsAtAHalf", kScreen,
         [](Belief& belief, const FaultRig&) { belief.plan.passes[0].colour = glm::vec4(0.5f); }},
        {"EyeHeldByOneMore",
         {.scene = underASlab, .axes = {.store = Store::Stencil, .count = gnomon::Count::PlusPlusZp}},
         [](Belief& belief, const FaultRig&) { ++belief.holdingEye; }},
        {"HalfOf127", kScreen,
         [](Belief& belief, const FaultRig&) {
             for (Pass& pass : belief.plan.passes)
                 if (pass.colour == glm::vec4(128 / 255.0f)) pass.colour = glm::vec4(127 / 255.0f);
         }},
        {"CapacityOfOneBitLess", kScreenOfEightLevels,
         [](Belief& belief, const FaultRig&) { belief.arithmetic.format.red = 7; }},
        {"BacksNotCounted", kHeidmann,
         [](Belief& belief, const FaultRig&) {
             for (Pass& pass : belief.plan.passes)
                 if (pass.kind == PassKind::Volume) pass.stencil.back.onPass = StencilOp::Keep;
         }},
        {"LastPassForgotten", kScreen,
         [](Belief& belief, const FaultRig&) {
             // The last that counts: nothing else halves.
             const auto isHalving = [](const Pass& pass) {
                 return pass.kind == PassKind::Volume && pass.faces == Faces::Back;
             };
             const auto last =
                 std::find_if(belief.plan.passes.rbegin(), belief.plan.passes.rend(), isHalving);
             last->faces = Faces::Front;
         }},
    };
}

class FalsePrediction : public testing::TestWithParam<FalseBelief> {};

TEST_P(FalsePrediction, IsNotWhatIsDrawn) {
    const FalseBelief& belief = GetParam();
    FaultRig rig(belief.setUp);
    ASSERT_EQ(rig.unpredictedBy({}), 0) << "without a fault";
    const int unpredicted = rig.unpredictedBy([&](Belief& falsified) { belief.falsify(falsified, rig); });
    EXPECT_THAT(unpredicted, isExpected(belief.pixels));
}

INSTANTIATE_TEST_SUITE_P(Predictor, FalsePrediction, testing::ValuesIn(falseBeliefs()),
                         [](const auto& test) { return test.param.name; });

// ---- Plans that can't be right ----

struct WrongPlan {
    std::string name{};
    SetUp setUp{};  ///< known: the cause
};
void PrintTo(const WrongPlan& plan, std::ostream* out) {
    *out << plan.name;
}

std::vector<WrongPlan> wrongPlans() {
    Axes odd = method("heidmann");
    odd.silhouette = Silhouette::Triangular;
    Axes once = method("roettger-screen");
    once.levels = 1;
    return {
        {"NoNearCapWithTheEyeInside",
         {.scene = underASlab, .axes = method("heidmann"), .known = "eye inside a volume"}},
        {"HeavySidesDrawnOnce",
         {.scene = twoBooks, .axes = odd, .known = "open or inconsistently wound caster"}},
        {"OneLevelForTwoFronts", {.scene = twoBooks, .axes = once, .known = "mask clamps"}},
        {"OneBitForOverlappingVolumes",
         {.scene = twoBoxes,
          .axes = {.store = Store::Screen, .arithmetic = Arithmetic::Parity, .levels = 0},
          .known = "parity of overlapping volumes"}},
        {"NoShadowsAtAll", {.scene = twoBoxes, .axes = method("none"), .known = "no shadow is drawn"}},
        {"VolumesBehindTheirCasters",
         {.scene = twoBoxes,
          .axes = {.store = Store::Stencil, .count = gnomon::Count::Zfail, .offset = 1.2f},
          .known = "volume begins behind its caster"}},
        {"HalfTheMask", {.scene = twoBoxes, .axes = method("roettger-half"), .known = "low mask resolution"}},
    };
}

class PlanAtFault : public testing::TestWithParam<WrongPlan> {};

TEST_P(PlanAtFault, IsGivenItsCause) {
    FaultRig rig(GetParam().setUp);
    const Verified drawn = rig.draw();
    EXPECT_EQ(drawn.text(), GetParam().setUp.known);
    EXPECT_GT(drawn.wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(Plans, PlanAtFault, testing::ValuesIn(wrongPlans()),
                         [](const auto& test) { return test.param.name; });

TEST(FalsePredictions, AreEnoughOfEachKind) {
    EXPECT_GE(falseBeliefs().size(), 6u);
    EXPECT_GE(wrongPlans().size(), 6u);
}

}  // namespace false_predictions_test
}  // namespace gnomon
