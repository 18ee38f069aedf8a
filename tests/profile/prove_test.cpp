#include "profile/prove.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>

#include "profile/words.h"

namespace gnomon {
namespace {

using testing::ElementsAre;
using testing::Optional;
using enum BlendUnit;
using enum MaskArithmetic;
using enum DrawOrder;

MaskProof best(const FrameChannel& channel, MaskArithmetic arithmetic, DrawOrder order,
               std::optional<int> levels = {}) {
    const MaskClaim claim{channel, arithmetic, order};
    return bestProof(claim, startsOf(claim, levels));
}

// design.md: "Three nested fronts before their backs clamp at 1, and come back a level too low: DDDHH ends
// lit inside a shadow"; 64, 128, 255, then 128, 64 again is stable.
TEST(Prove, FindsThatThreeNestedFrontsClamp) {
    const MaskProof proof =
        prove({{IdealRound, 8}, Double, FrontsFirst}, {.start = 64, .half = 128, .threshold = 96});
    EXPECT_EQ(proof.depth, 2);
    EXPECT_EQ(proof.volumes, 2);
    ASSERT_TRUE(proof.counterexample.has_value());
    EXPECT_EQ(proof.counterexample->crossings, "DDDHH");
    EXPECT_THAT(proof.counterexample->codes, ElementsAre(64, 128, 255, 255, 128, 64));
}

TEST(Prove, FindsThatConvexVolumesInTurnAreExactWithTwoLevels) {
    const MaskProof proof =
        prove({{IdealRound, 8}, Double, Volume}, {.start = 64, .half = 128, .threshold = 96});
    EXPECT_EQ(proof.depth, std::nullopt);
    EXPECT_EQ(proof.volumes, std::nullopt);
    EXPECT_EQ(proof.counterexample, std::nullopt);
    for (const auto& drift : proof.drift) EXPECT_EQ(std::pair(drift.lowest, drift.highest), std::pair(0, 0));
    // An unshadowed pixel ends at 254 of 255: the mask is never exactly 1.
    EXPECT_EQ(proof.darknessOutside, 1);
    EXPECT_EQ(proof.lightInShadow, 0);
}

// Section 2(c): codes 2^0..2^n allow n fronts before any back.
TEST(Prove, FindsTheCapacityOfADoublingMask) {
    EXPECT_EQ(best({VoodooMame, 5}, Double, FrontsFirst).depth, 5);
    EXPECT_EQ(best({VoodooMame, 6}, Double, FrontsFirst).depth, 6);
    EXPECT_EQ(best({IdealRound, 8}, Double, FrontsFirst).depth, 8);
}

// design.md: "halve in 5 bits sticks at 0 after six fronts, in 8 bits at 1 of 255".
TEST(Prove, FindsThatHalvingSticks) {
    // Floor: 31 15 7 3 1 0; nothing brings a code back from 0.
    const MaskProof five = prove({{IdealFloor, 5}, Halve, FrontsFirst}, {.start = 31, .threshold = 16});
    ASSERT_TRUE(five.counterexample.has_value());
    EXPECT_EQ(five.depth, 4);
    const MaskProof voodoo = prove({{VoodooMame, 5}, Halve, FrontsFirst}, {31, 128, 24});
    ASSERT_TRUE(voodoo.counterexample.has_value());
    EXPECT_EQ(voodoo.counterexample->crossings, "DDDDDDHHHHHH");
    EXPECT_THAT(voodoo.counterexample->codes, ElementsAre(31, 16, 8, 4, 2, 1, 0, 0, 0, 0, 0, 0, 0));
    // Nearest: at 1 for ever, and doubling then runs past the start while a volume is still open.
    int code = 255;
    for (int i = 0; i < 20; ++i) code = *apply({IdealRound, 8}, MaskOperation::Halve, code);
    EXPECT_EQ(code, 1);
}

TEST(Prove, FindsVoodooExactWithoutDither) {
    for (const BlendUnit unit : {VoodooMame, Voodoo86Box})
        for (const int bits : {5, 6}) {
            const MaskProof proof = best({unit, bits}, Double, Volume);
            EXPECT_EQ(proof.depth, std::nullopt) << bits;
            EXPECT_EQ(proof.volumes, std::nullopt);
            EXPECT_EQ(proof.choice.half, 128);
        }
}

// Section 4.2: with 127 white is lost after one round trip, 31 -> 15 -> 30; with 128 it comes back.
TEST(Prove, FindsThatVoodooNeeds128) {
    const MaskClaim claim{{VoodooMame, 5}, Halve, Volume};
    EXPECT_EQ(prove(claim, {31, 128, 24}).drift.back().lowest, 0);
    EXPECT_EQ(prove(claim, {31, 127, 24}).drift.back().highest, -1);
    const MaskClaim green{{Voodoo86Box, 6}, Double, FrontsFirst};
    EXPECT_EQ(prove(green, {1, 128, 2}).depth, 6);
    EXPECT_LT(prove(green, {1, 127, 2}).depth, 6);
    EXPECT_EQ(bestProof(green, startsOf(green, {})).choice.half, 128);
}

TEST(Prove, FindsThatTheDefaultDitherDrifts) {
    const FrameChannel dithered{VoodooMame, 5, DitherMode::Matrix4x4Subtract};
    const MaskProof proof = prove({dithered, Double, Volume}, {8, 128, 12});
    EXPECT_TRUE(proof.volumes.has_value());
    ASSERT_EQ(proof.drift.size(), 3u);
    EXPECT_EQ(proof.drift[1].volumes, 8);
    EXPECT_EQ(proof.drift[1].lowest, 0);
    EXPECT_EQ(proof.drift[1].highest, 8);
}

// Doubling to 2v - 1 takes one code per volume: 64, 63, 62.
TEST(Prove, FindsTheDreamcastsDrift) {
    const MaskProof proof = prove({{PowerVr, 8}, Double, Volume}, {64, 128, 96});
    for (const auto& drift : proof.drift)
        if (drift.volumes == 8) {
            EXPECT_EQ(std::pair(drift.lowest, drift.highest), std::pair(-8, -8));
        }
    EXPECT_EQ(proof.depth, 0);
    // A mask that starts at 64 and is told apart at 96 lasts until a shadow has fallen below 96.
    EXPECT_EQ(proof.volumes, 16);
}

TEST(Prove, FindsThePs2sCountExactModulo256) {
    for (const DrawOrder order : {Volume, FrontsFirst, PerTriangle}) {
        const MaskProof proof = prove({{GsWrap, 8}, Count, order}, {.start = 0, .threshold = 1});
        EXPECT_EQ(proof.depth, 255) << name(order);
        EXPECT_EQ(proof.volumes, 255) << name(order);
        EXPECT_EQ(proof.counterexample->crossings, std::string(256, 'D')) << name(order);
    }
    for (int code = 0; code < 256; ++code)
        EXPECT_EQ(
            apply({GsWrap, 8}, MaskOperation::Decrement, *apply({GsWrap, 8}, MaskOperation::Increment, code)),
            code);
}

TEST(Prove, FindsThatAClampedCountNeedsRoomBelowForAnyOrder) {
    const MaskProof fromZero = prove({{Gs, 8}, Count, PerTriangle}, {.start = 0, .threshold = 1});
    EXPECT_EQ(fromZero.depth, 0);
    EXPECT_EQ(fromZero.counterexample->crossings, "HD");
    EXPECT_EQ(best({Gs, 8}, Count, PerTriangle).choice.start, 128);
    EXPECT_EQ(best({Gs, 8}, Count, PerTriangle).depth, 127);
}

TEST(Prove, FindsThatParityTakesOneVolumeAtATime) {
    const MaskProof proof = best({IdealRound, 8}, Parity, Volume);
    EXPECT_EQ(proof.depth, 1);
    EXPECT_EQ(proof.volumes, 1);
    EXPECT_EQ(proof.counterexample->crossings, "DD");
}

TEST(Prove, StartsAtTheCodeNearestToItsLevels) {
    EXPECT_THAT(startsOf({{IdealRound, 8}, Double, Volume}, 2), ElementsAre(64));
    EXPECT_THAT(startsOf({{VoodooMame, 5}, Double, Volume}, 2), ElementsAre(8));
    EXPECT_THAT(startsOf({{VoodooMame, 6}, Double, Volume}, 6), ElementsAre(1));
    EXPECT_EQ(startsOf({{IdealRound, 8}, Double, Volume}, {}).size(), 254u);
}

// Between 63 and 64 three nested fronts can still be told apart by one code; normalisation can't.
TEST(Prove, FindsStartsThatThePaperDidNotLookFor) {
    const MaskProof proof = prove({{IdealRound, 8}, Double, FrontsFirst}, {63, 128, 64});
    EXPECT_EQ(proof.depth, 3);
    EXPECT_EQ(proof.lightInShadow, 254);
}

TEST(Prove, KnowsWhatAUnitCantDraw) {
    EXPECT_FALSE(canDraw({Nv3, 5}, Double));
    EXPECT_FALSE(canDraw({Virge, 5}, Double));
    EXPECT_FALSE(canDraw({VoodooMame, 5}, Count));
    EXPECT_TRUE(canDraw({VoodooMame, 5}, Parity));
    EXPECT_TRUE(canDraw({Flipper, 6}, Count));
    // Their units have five bits and no others.
    EXPECT_TRUE(canDraw({Psx, 5}, Double));
    EXPECT_FALSE(canDraw({Psx, 4}, Double));
    EXPECT_FALSE(canDraw({Rdp, 8}, Count));
}

/// What all sequences of at most ten crossings say of a choice.
struct Brute {
    std::size_t shortest = std::numeric_limits<std::size_t>::max();
    int fewestVolumes = std::numeric_limits<int>::max();
    std::map<int, int> volumesByDepth{};  ///< largest |open| of a wrong sequence -> fewest volumes
};

/// Whether @p order allows the sequence.
bool isAllowed(const std::string& s, DrawOrder order) {
    if (order == PerTriangle)
        return std::count(s.begin(), s.end(), 'D') >= std::count(s.begin(), s.end(), 'H');
    if (order == FrontsFirst)
        return std::is_sorted(s.begin(), s.end()) &&
               std::count(s.begin(), s.end(), 'D') >= std::count(s.begin(), s.end(), 'H');
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s[i] == 'H' && (i == 0 || s[i - 1] != 'D')) return false;
    return true;
}

Brute simulate(const MaskClaim& claim, const MaskChoice& choice) {
    Brute brute;
    const bool bright = claim.arithmetic == Double || claim.arithmetic == Count;
    const auto operation = [&](char c) {
        if (claim.arithmetic == Double) return c == 'D' ? MaskOperation::Double : MaskOperation::Halve;
        if (claim.arithmetic == Halve) return c == 'D' ? MaskOperation::Halve : MaskOperation::Double;
        if (claim.arithmetic == Count) return c == 'D' ? MaskOperation::Increment : MaskOperation::Decrement;
        return MaskOperation::Invert;
    };
    for (std::size_t length = 0; length <= 10; ++length)
        for (unsigned bits = 0; bits < 1u << length; ++bits) {
            std::string s;
            for (std::size_t i = 0; i < length; ++i) s += bits >> i & 1 ? 'D' : 'H';
            if (!isAllowed(s, claim.order)) continue;
            int code = choice.start, open = 0, most = 0;
            for (const char c : s) {
                code = *apply(claim.channel, operation(c), code, choice.half);
                open += c == 'D' ? 1 : -1;
                most = std::max(most, std::abs(open));
            }
            if ((open > 0) == ((code >= choice.threshold) == bright)) continue;
            const int volumes = int(std::count(s.begin(), s.end(), 'D'));
            brute.shortest = std::min(brute.shortest, length);
            brute.fewestVolumes = std::min(brute.fewestVolumes, volumes);
            const auto at = brute.volumesByDepth.try_emplace(most, volumes).first;
            at->second = std::min(at->second, volumes);
        }
    return brute;
}

class EachOrder : public testing::TestWithParam<DrawOrder> {};

// Every unit and width that can draw, with starts and thresholds on all sides of what is good. A sequence of
// n volumes has at most 2n crossings, so that up to five volumes the simulation is complete.
TEST_P(EachOrder, AgreesWithAllSequencesOfTenCrossings) {
    int compared = 0, failing = 0;
    for (std::size_t u = 0; u < names<BlendUnit>().size(); ++u)
        for (const int bits : {5, 6, 8})
            for (int a = 0; a < kMaskArithmetics; ++a) {
                const FrameChannel channel{static_cast<BlendUnit>(u), bits};
                const MaskClaim claim{channel, static_cast<MaskArithmetic>(a), GetParam()};
                if (!canDraw(channel, claim.arithmetic)) continue;
                const int most = largestCode(bits);
                const int start = claim.arithmetic == Double  ? (most + 1) / 8
                                  : claim.arithmetic == Count ? 3
                                                              : most;
                for (const int threshold : {start, start + 1, start + start / 2, most / 2 + 1, most}) {
                    if (threshold > most + 1) continue;
                    const MaskChoice choice{start, bits == 5 ? 127 : 128, threshold};
                    const MaskProof proof = prove(claim, choice);
                    const Brute brute = simulate(claim, choice);
                    SCOPED_TRACE(testing::Message() << name(channel.unit) << " " << bits << " "
                                                    << name(claim.arithmetic) << " " << threshold);
                    const auto found = proof.counterexample ? proof.counterexample->crossings.size()
                                                            : std::numeric_limits<std::size_t>::max();
                    if (std::min(found, brute.shortest) <= 10) {
                        EXPECT_EQ(found, brute.shortest);
                    }
                    const int fails = proof.volumes ? *proof.volumes + 1 : std::numeric_limits<int>::max();
                    if (std::min(fails, brute.fewestVolumes) <= 5) {
                        EXPECT_EQ(fails, brute.fewestVolumes);
                    }
                    for (const auto& [depth, volumes] : brute.volumesByDepth)
                        EXPECT_LT(proof.depth.value_or(std::numeric_limits<int>::max()), depth);
                    if (proof.depth && *proof.depth < 5 && *proof.volumes < 5 && GetParam() == FrontsFirst) {
                        EXPECT_EQ(brute.volumesByDepth.begin()->first, *proof.depth + 1);
                    }
                    ++compared;
                    failing += proof.counterexample.has_value();
                }
            }
    EXPECT_GT(compared, 100);
    EXPECT_GT(failing, 30);
}

// A counterexample is what it says: walked again, it ends wrong.
TEST_P(EachOrder, CounterexamplesAreTrue) {
    for (const BlendUnit unit : {VoodooMame, PowerVr, Gs, IdealFloor, Nv2a})
        for (const int bits : {5, 8})
            for (int a = 0; a < kMaskArithmetics; ++a) {
                const MaskClaim claim{{unit, bits}, static_cast<MaskArithmetic>(a), GetParam()};
                if (!canDraw(claim.channel, claim.arithmetic)) continue;
                const MaskProof proof = bestProof(claim, startsOf(claim, 2));
                if (!proof.counterexample) continue;
                const auto& [crossings, codes, cell] = *proof.counterexample;
                ASSERT_EQ(codes.size(), crossings.size() + 1);
                EXPECT_TRUE(isAllowed(crossings, GetParam())) << crossings;
                const bool open = std::count(crossings.begin(), crossings.end(), 'D') >
                                  std::count(crossings.begin(), crossings.end(), 'H');
                const bool bright = claim.arithmetic == Double || claim.arithmetic == Count;
                EXPECT_NE(open, (codes.back() >= proof.choice.threshold) == bright);
            }
}

INSTANTIATE_TEST_SUITE_P(Prove, EachOrder, testing::Values(Volume, FrontsFirst, PerTriangle),
                         [](const auto& test) {
                             std::string word = name(test.param);
                             word.erase(std::remove(word.begin(), word.end(), '-'), word.end());
                             return word;
                         });

}  // namespace
}  // namespace gnomon
