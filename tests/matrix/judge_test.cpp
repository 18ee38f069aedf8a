// The comparison of one mask with truth, on truths drawn by hand.

#include "matrix/judge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace gnomon {
namespace judge_test {

using testing::Each;
using testing::ElementsAre;
using enum PixelVerdict;

/// A truth from one character per pixel, rows from the top: '-' background, '.' lit, '#' in shadow, 'a' the
/// seen side faces away and nothing blocks it, 'A' faces away and blocked; 't' and 'c' lit, but tied by truth
/// or count.
Truth truthOf(const std::vector<std::string>& rows) {
    Truth truth;
    truth.width = int(rows[0].size()), truth.height = int(rows.size());
    for (const std::string& row : rows) {
        for (const char c : row) {
            const bool away = std::string("aATC").find(c) != std::string::npos;
            const bool blocked = std::string("#ATC").find(c) != std::string::npos;
            truth.shadow.push_back(c == '-'            ? Shadow::Background
                                   : (away || blocked) ? Shadow::InShadow
                                                       : Shadow::Lit);
            truth.tie.push_back(c == 't' || c == 'T'   ? Tie::Truth
                                : c == 'c' || c == 'C' ? Tie::Count
                                : c == 'k'             ? Tie::CountIfClamped
                                                       : Tie::None);
            truth.facesAway.push_back(away);
            truth.blocked.push_back(blocked);
        }
    }
    return truth;
}

/// '#': the mask calls the pixel a shadow.
std::vector<bool> maskOf(const std::vector<std::string>& rows) {
    std::vector<bool> mask;
    for (const std::string& row : rows)
        for (const char c : row) mask.push_back(c == '#');
    return mask;
}

/// Of a mask whose arithmetic loses no count.
Judgement judgeOf(const Truth& truth, const std::vector<bool>& mask, int maskDivisor) {
    return judge(truth, mask, maskDivisor, false);
}

struct Wrong {
    int edge = 0, interior = 0;
    bool operator==(const Wrong&) const = default;
};
void PrintTo(const Wrong& w, std::ostream* out) {
    *out << w.edge << " edge, " << w.interior << " interior";
}
Wrong wrongOf(const Judgement& judgement) {
    return {judgement.edge, judgement.interior};
}

TEST(Judge, CallsMaskThatEqualsBlockedRight) {
    const Judgement judged = judgeOf(truthOf({"..##", ".###", "-.#A"}), maskOf({"..##", ".###", "..##"}), 1);
    EXPECT_EQ(judged.wrong(), 0);
    EXPECT_THAT(judged.pixels, Each(Right));
    EXPECT_THAT(judged.pixels, testing::SizeIs(12));
}

TEST(Judge, CallsWrongPixelBesideBoundaryEdge) {
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"...###"}), maskOf({"..####"}), 1)), (Wrong{1, 0}))
        << "too much shadow";
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"...###"}), maskOf({"....##"}), 1)), (Wrong{1, 0})) << "too little";
}

TEST(Judge, CountsDiagonalNeighboursAsBeside) {
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"....", "....", "...#"}), maskOf({"....", "..#.", "...#"}), 1)),
              (Wrong{1, 0}));
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"....", "....", "...#"}), maskOf({".#..", "....", "...#"}), 1)),
              (Wrong{0, 1}));
}

TEST(Judge, CallsWrongPixelAwayFromBoundaryInterior) {
    const Judgement hole =
        judgeOf(truthOf({"#####", "#####", "####."}), maskOf({"#####", "#.###", "####."}), 1);
    EXPECT_EQ(wrongOf(hole), (Wrong{0, 1}));
    EXPECT_EQ(hole.pixels[6], WrongInterior);
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"..###"}), maskOf({"#.###"}), 1)), (Wrong{0, 1})) << "a leak";
}

// A pixel at the right end of a row and the next row's first are neighbours in memory only.
TEST(Judge, DoesNotReachAroundTheSidesOfTheImage) {
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"....", "#...", "#..."}), maskOf({"...#", "#...", "#..."}), 1)),
              (Wrong{0, 1}));
}

// A mask pixel of scale 1/2 or 1/4 covers 2 or 4 of the window.
TEST(Judge, ReachesAsFarAsOneMaskPixel) {
    const Truth truth = truthOf({"......##########"});
    const auto leakAt = [](int x) {
        std::string row = "......##########";
        row[std::size_t(x)] = '#';
        return maskOf({row});
    };
    EXPECT_EQ(wrongOf(judgeOf(truth, leakAt(5), 1)), (Wrong{1, 0}));
    EXPECT_EQ(wrongOf(judgeOf(truth, leakAt(4), 1)), (Wrong{0, 1}));
    EXPECT_EQ(wrongOf(judgeOf(truth, leakAt(4), 2)), (Wrong{1, 0}));
    EXPECT_EQ(wrongOf(judgeOf(truth, leakAt(3), 2)), (Wrong{0, 1}));
    EXPECT_EQ(wrongOf(judgeOf(truth, leakAt(2), 4)), (Wrong{1, 0}));
    EXPECT_EQ(wrongOf(judgeOf(truth, leakAt(1), 4)), (Wrong{0, 1}));
}

TEST(Judge, WantsBackgroundLit) {
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"----"}), maskOf({"...."}), 1)), (Wrong{0, 0}));
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"----"}), maskOf({"#..."}), 1)), (Wrong{0, 1}));
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"--##"}), maskOf({".###"}), 1)), (Wrong{1, 0}));
}

// The lit pass adds nothing to a side that faces away, so it is in shadow whatever the mask says.
TEST(Judge, TakesSeenSideThatFacesAwayForShadow) {
    EXPECT_EQ(wrongOf(judgeOf(truthOf({".aa."}), maskOf({".#.."}), 1)), (Wrong{0, 0}));
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"AAAAA"}), maskOf({"##.##"}), 1)), (Wrong{0, 0}));
    EXPECT_EQ(wrongOf(judgeOf(truthOf({"#####"}), maskOf({"##.##"}), 1)), (Wrong{0, 1}));
}

TEST(Judge, CountsTiesByKindAndNeverAsWrong) {
    for (const char* mask : {".....", "#####"}) {
        const Judgement judged = judgeOf(truthOf({"ttctc"}), maskOf({mask}), 1);
        EXPECT_EQ(judged.tiedTruth, 3);
        EXPECT_EQ(judged.tiedCount, 2);
        EXPECT_EQ(judged.wrong(), 0);
        EXPECT_THAT(judged.pixels, Each(Tied));
    }
}

// The lit pass adds nothing there either way.
TEST(Judge, CountsNoTieOfTheCountWhereSeenSideFacesAway) {
    for (const char* mask : {"...", "###"}) {
        const Judgement judged = judgeOf(truthOf({"CTC"}), maskOf({mask}), 1);
        EXPECT_THAT(judged.pixels, ElementsAre(Right, Tied, Right));
        EXPECT_EQ(judged.tiedCount, 0);
        EXPECT_EQ(judged.tiedTruth, 1);
        EXPECT_EQ(judged.wrong(), 0);
    }
}

// A count that never clamps gets over a face on either side of the surface.
TEST(Judge, ExcusesTiesOfClampingForMasksThatClampOnly) {
    const Truth truth = truthOf({".k.."});
    const Judgement clamps = judge(truth, maskOf({".#.."}), 1, true);
    EXPECT_THAT(clamps.pixels, ElementsAre(Right, Tied, Right, Right));
    EXPECT_EQ(clamps.tiedCount, 1);
    const Judgement counts = judge(truth, maskOf({".#.."}), 1, false);
    EXPECT_THAT(counts.pixels, ElementsAre(Right, WrongInterior, Right, Right));
    EXPECT_EQ(counts.tiedCount, 0);
}

TEST(Judge, SaysOfEachPixelWhatBecameOfIt) {
    const Judgement judged = judgeOf(truthOf({"..t.##a"}), maskOf({"#..##.#"}), 1);
    EXPECT_THAT(judged.pixels,
                ElementsAre(WrongInterior, Right, Tied, WrongEdge, Right, WrongInterior, Right));
    EXPECT_EQ(judged.wrong(), 3);
}

TEST(Judge, TellsTiesOfTruthFromThoseOfTheCount) {
    const Judgement judged = judgeOf(truthOf({"t.c#"}), maskOf({"...#"}), 1);
    EXPECT_THAT(judged.tiedByTruth, ElementsAre(true, false, false, false));
}

TEST(Combined, IsTheOnlyLightsOwn) {
    const Judgement one = judgeOf(truthOf({"..t.##a"}), maskOf({"#..##.#"}), 1);
    const Judgement all = combined({one});
    EXPECT_EQ(all.pixels, one.pixels);
    EXPECT_EQ(wrongOf(all), wrongOf(one));
    EXPECT_EQ(all.tiedTruth, one.tiedTruth);
}

TEST(Combined, IsAsWrongInAPixelAsTheWorstLight) {
    // By pixel: right and right, right and tied, right and edge, tied and interior.
    Judgement a, b;
    a.pixels = {Right, Tied, WrongEdge, WrongInterior}, a.tiedByTruth = {false, true, false, false};
    b.pixels = {Right, Right, Right, Tied}, b.tiedByTruth = {false, false, false, true};
    a.tiedTruth = 1, a.edge = 1, a.interior = 1;
    b.tiedTruth = 1;
    const Judgement all = combined({a, b});
    EXPECT_THAT(all.pixels, ElementsAre(Right, Tied, WrongEdge, WrongInterior));
    EXPECT_EQ(wrongOf(all), (Wrong{1, 1}));
    EXPECT_EQ(all.tiedTruth, 1) << "the other tie is wrong in the other light";
    EXPECT_EQ(all.tiedCount, 0);
}

TEST(Combined, CountsAPixelOnceWhereBothLightsAreWrong) {
    const Judgement a = judgeOf(truthOf({"#####"}), maskOf({"#.###"}), 1);
    const Judgement all = combined({a, a});
    EXPECT_EQ(wrongOf(all), (Wrong{0, 1}));
}

TEST(Combined, TiesByTruthWhereOneLightDoesAndByTheCountElsewhere) {
    const Judgement a = judgeOf(truthOf({"tcc."}), maskOf({"...."}), 1);
    const Judgement b = judgeOf(truthOf({"ct.."}), maskOf({"...."}), 1);
    const Judgement all = combined({a, b});
    EXPECT_EQ(all.tiedTruth, 2);
    EXPECT_EQ(all.tiedCount, 1);
}

TEST(ShadowPicture, IsBlackWhereMaskOrSeenSideIsDark) {
    const Image picture = shadowPicture(truthOf({"-.#", "aA."}), maskOf({"..#", ".##"}));
    EXPECT_EQ(picture, (Image{3, 2, 1, {255, 255, 0, 0, 0, 0}}));
}

}  // namespace judge_test
}  // namespace gnomon
