#include "profile/prove.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "profile/words.h"

namespace gnomon {
namespace prove_test {

using testing::ElementsAre;
using testing::Optional;
using enum BlendUnit;
using enum MaskArithmetic;
using enum DrawOrder;

MaskProof best(const FrameChannel& channel, MaskArithmetic arithmetic, DrawOrder order,
               std::optional<int> levels = {}, MaskMeans means = MaskMeans::Blend) {
    const MaskClaim claim{channel, arithmetic, order, means};
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

// A sum that wraps is a cycle: any order gives the code of the open volumes, and only a whole cycle of them
// looks like none. A clamped one forgets.
TEST(Prove, FindsThatWrappingCountsAreExactModuloTheirCycle) {
    for (const auto& [unit, bits, cycle] :
         {std::tuple(Gs, 8, 256), std::tuple(Gs, 5, 32), std::tuple(Rdp, 5, 16),
          std::tuple(IdealRound, 8, 256), std::tuple(IdealFloor, 6, 64)})
        for (const DrawOrder order : {Volume, FrontsFirst, PerTriangle, NearerOnly}) {
            const MaskProof proof = best({unit, bits}, Count, order, {}, MaskMeans::AddWrap);
            EXPECT_EQ(proof.period, cycle) << name(unit) << " " << name(order);
            EXPECT_EQ(proof.depth, cycle - 1) << name(unit) << " " << name(order);
            const auto& wrong = proof.counterexample->crossings;
            EXPECT_EQ(
                std::count(wrong.begin(), wrong.end(), 'D') - std::count(wrong.begin(), wrong.end(), 'H'),
                cycle);
        }
    for (const DrawOrder order : {Volume, PerTriangle}) {
        EXPECT_EQ(best({Gs, 8}, Count, order).period, std::nullopt);
        EXPECT_EQ(best({Flipper, 6}, Count, order).period, std::nullopt);
    }
    EXPECT_EQ(best({IdealRound, 8}, Parity, PerTriangle).period, 2);
    // White doubles to white, but halving doesn't lead back: no cycle.
    EXPECT_EQ(prove({{IdealRound, 8}, Double, Volume}, {255, 128, 255}).period, std::nullopt);
    // Inversion is 254 - v there below 128, and not its own inverse.
    EXPECT_EQ(prove({{PowerVr, 8}, Parity, Volume}, {.start = 200, .threshold = 128}).period, std::nullopt);
}

TEST(Prove, FindsInversionByLogicOperationsExactOnEveryUnit) {
    for (const BlendUnit unit : {PowerVr, VoodooMame, Flipper}) {
        const MaskProof proof = best({unit, 6}, Parity, PerTriangle, {}, MaskMeans::LogicOp);
        EXPECT_EQ(proof.period, 2);
        EXPECT_EQ(proof.depth, 1);
    }
}

// Zfail without a farther test halves below the start for a moment, DHHD: the start at the lowest code loses
// it there, and keeps it where volumes come in turn.
TEST(Prove, FindsThatNearerOnlyNeedsRoomBelow) {
    const MaskChoice lowest{.start = 1, .half = 128, .threshold = 2};
    EXPECT_EQ(prove({{VoodooMame, 5}, Double, Volume}, lowest).counterexample, std::nullopt);
    const MaskProof proof = prove({{VoodooMame, 5}, Double, NearerOnly}, lowest);
    ASSERT_TRUE(proof.counterexample.has_value());
    EXPECT_EQ(proof.counterexample->crossings, "DHHDDHD");
    EXPECT_THAT(proof.counterexample->codes, ElementsAre(1, 2, 1, 0, 0, 0, 0, 0));
    EXPECT_EQ(prove({{VoodooMame, 5}, Double, NearerOnly}, {4, 128, 6}).counterexample, std::nullopt);
}

// Every mode, over the pixels of its matrix, by hand: the code after one volume. PlayStation's flat masks
// don't dither, and are as without.
TEST(Prove, TakesEveryDitherModeAtEveryPixel) {
    int moved = 0;
    for (std::size_t m = 0; m < names<DitherMode>().size(); ++m)
        for (const BlendUnit unit : {VoodooMame, Gs, Rdp, Ge, Psx}) {
            const auto mode = static_cast<DitherMode>(m);
            const MaskClaim claim{{unit, 5, mode}, Double, Volume};
            int lowest = 100, highest = -100;
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 4; ++x) {
                    const FrameChannel pixel{unit, 5, mode, ditherCell(mode, x, y)};
                    const int up = *apply(pixel, MaskOperation::Double, 8);
                    const int after = *apply(pixel, MaskOperation::Halve, up) - 8;
                    lowest = std::min(lowest, after);
                    highest = std::max(highest, after);
                }
            const auto drift = prove(claim, {8, 128, 12}).drift.front();
            EXPECT_EQ(std::pair(drift.lowest, drift.highest), std::pair(lowest, highest))
                << name(unit) << " " << name(mode);
            if (unit == Psx) {
                EXPECT_EQ(std::pair(lowest, highest), std::pair(0, 0)) << name(mode);
            }
            moved += lowest != highest;
        }
    EXPECT_GT(moved, 10);
    // The PS2's usual matrix moves steps of 8 by -4..3: counts lose a code per face where its cell is
    // negative.
    const MaskProof dithered =
        prove({{Gs, 5, DitherMode::Gs}, Count, Volume}, {.start = 16, .threshold = 17});
    EXPECT_EQ(dithered.depth, 0);
    EXPECT_EQ(dithered.drift.front().lowest, -2);
    EXPECT_EQ(dithered.drift.front().highest, 0);
}

TEST(Prove, SaysWhatTheOtherConstantReaches) {
    const MaskProof proof = best({Voodoo86Box, 6}, Double, FrontsFirst);
    EXPECT_EQ(proof.choice.half, 128);
    ASSERT_TRUE(proof.otherHalf.has_value());
    EXPECT_EQ(proof.otherHalf->depth, 5);
    EXPECT_FALSE(best({Gs, 8}, Double, FrontsFirst).otherHalf.has_value());
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

/// The volumes of the sequence; none if @p order doesn't allow it.
std::optional<int> volumesOf(const std::string& s, DrawOrder order) {
    const int fronts = int(std::count(s.begin(), s.end(), 'D')), backs = int(s.size()) - fronts;
    switch (order) {
        case PerTriangle:
            if (fronts < backs) return {};
            return fronts;
        case FrontsFirst:
            if (fronts < backs || !std::is_sorted(s.begin(), s.end())) return {};
            return fronts;
        case Volume:
            for (std::size_t i = 0; i < s.size(); ++i)
                if (s[i] == 'H' && (i == 0 || s[i - 1] != 'D')) return {};
            return fronts;
        case NearerOnly: {
            // From the left, the longest word that leaves a word's beginning, or the end.
            int volumes = 0;
            for (std::size_t i = 0; i < s.size(); ++volumes) {
                const auto is = [&](const std::string& word) {
                    const std::size_t end = i + word.size();
                    return s.compare(i, word.size(), word) == 0 && (end == s.size() || s[end] == 'D');
                };
                if (is("DHHD"))
                    i += 4;
                else if (is("DHD"))
                    i += 3;
                else if (is("DH"))
                    i += 2;
                else
                    return {};
            }
            return volumes;
        }
    }
    return {};
}

/// All sequences of at most @p longest crossings that the claim's order allows.
Brute simulate(const MaskClaim& claim, const MaskChoice& choice, std::size_t longest = 10) {
    Brute brute;
    const bool bright = claim.arithmetic == Double || claim.arithmetic == Count;
    const auto operation = [&](char c) {
        const bool wraps = claim.means == MaskMeans::AddWrap;
        if (claim.arithmetic == Double) return c == 'D' ? MaskOperation::Double : MaskOperation::Halve;
        if (claim.arithmetic == Halve) return c == 'D' ? MaskOperation::Halve : MaskOperation::Double;
        if (claim.arithmetic == Count && wraps)
            return c == 'D' ? MaskOperation::IncrementWrap : MaskOperation::DecrementWrap;
        if (claim.arithmetic == Count) return c == 'D' ? MaskOperation::Increment : MaskOperation::Decrement;
        return claim.means == MaskMeans::LogicOp ? MaskOperation::InvertBits : MaskOperation::Invert;
    };
    for (std::size_t length = 0; length <= longest; ++length)
        for (unsigned bits = 0; bits < 1u << length; ++bits) {
            std::string s;
            for (std::size_t i = 0; i < length; ++i) s += bits >> i & 1 ? 'D' : 'H';
            const auto volumes = volumesOf(s, claim.order);
            if (!volumes) continue;
            int code = choice.start, open = 0, most = 0;
            for (const char c : s) {
                code = *apply(claim.channel, operation(c), code, choice.half);
                open += c == 'D' ? 1 : -1;
                most = std::max(most, std::abs(open));
            }
            if ((open > 0) == ((code >= choice.threshold) == bright)) continue;
            brute.shortest = std::min(brute.shortest, length);
            brute.fewestVolumes = std::min(brute.fewestVolumes, *volumes);
            const auto at = brute.volumesByDepth.try_emplace(most, *volumes).first;
            at->second = std::min(at->second, *volumes);
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
            for (int a = 0; a < kMaskArithmetics * kMaskMeans; ++a) {
                const FrameChannel channel{static_cast<BlendUnit>(u), bits};
                const MaskClaim claim{channel, static_cast<MaskArithmetic>(a % kMaskArithmetics), GetParam(),
                                      static_cast<MaskMeans>(a / kMaskArithmetics)};
                if (!canDraw(channel, claim.arithmetic, claim.means)) continue;
                // The other means leave the other arithmetics as they are.
                if (claim.means == MaskMeans::AddWrap && claim.arithmetic != Count) continue;
                if (claim.means == MaskMeans::LogicOp && claim.arithmetic != Parity) continue;
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
                    // Of nearer-only, a volume has up to four crossings.
                    if (std::min(fails, brute.fewestVolumes) <= (GetParam() == NearerOnly ? 2 : 5)) {
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
                EXPECT_TRUE(volumesOf(crossings, GetParam()).has_value()) << crossings;
                const bool open = std::count(crossings.begin(), crossings.end(), 'D') >
                                  std::count(crossings.begin(), crossings.end(), 'H');
                const bool bright = claim.arithmetic == Double || claim.arithmetic == Count;
                EXPECT_NE(open, (codes.back() >= proof.choice.threshold) == bright);
            }
}

// Two and three bits have few enough codes that all choices can be tried: each has the shortest
// counterexample of all sequences of twelve crossings, and bestProof() finds the best of them.
TEST_P(EachOrder, IsTheBestOfAllChoicesInFewBits) {
    constexpr int kAny = 1000;
    int compared = 0;
    for (const BlendUnit unit : {IdealRound, IdealFloor})
        for (const int bits : {2, 3})
            for (int a = 0; a < kMaskArithmetics; ++a)
                for (const MaskMeans means : {MaskMeans::Blend, MaskMeans::AddWrap}) {
                    const MaskClaim claim{{unit, bits}, static_cast<MaskArithmetic>(a), GetParam(), means};
                    if (means == MaskMeans::AddWrap && claim.arithmetic != Count) continue;
                    const auto starts = startsOf(claim, {});
                    std::pair highest{-2, -2};
                    for (const int start : starts)
                        for (int threshold = 0; threshold <= largestCode(bits) + 1; ++threshold) {
                            const MaskChoice choice{start, 128, threshold};
                            const MaskProof proof = prove(claim, choice);
                            highest = std::max(
                                highest, std::pair(proof.depth.value_or(kAny), proof.volumes.value_or(kAny)));
                            const Brute brute = simulate(claim, choice, 12);
                            const std::size_t found =
                                proof.counterexample ? proof.counterexample->crossings.size() : 13;
                            EXPECT_EQ(std::min<std::size_t>(found, 13),
                                      std::min<std::size_t>(brute.shortest, 13))
                                << name(unit) << bits << name(claim.arithmetic) << start << " " << threshold;
                            ++compared;
                        }
                    const MaskProof proof = bestProof(claim, starts);
                    EXPECT_EQ(std::pair(proof.depth.value_or(kAny), proof.volumes.value_or(kAny)), highest)
                        << name(unit) << bits << name(claim.arithmetic);
                }
    EXPECT_GT(compared, 200);
}

INSTANTIATE_TEST_SUITE_P(Prove, EachOrder, testing::Values(Volume, FrontsFirst, PerTriangle, NearerOnly),
                         [](const auto& test) {
                             std::string word = name(test.param);
                             word.erase(std::remove(word.begin(), word.end(), '-'), word.end());
                             return word;
                         });

}  // namespace prove_test
}  // namespace gnomon
