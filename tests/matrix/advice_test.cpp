// The order of advice, and what it chooses.

#include "matrix/advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon {
namespace advice_test {

using testing::ElementsAre;

AdviceRow row(const std::string& method, std::int64_t touched, Verdict verdict, int wrong = 0) {
    AdviceRow r{.method = method};
    r.amount.pixels.volume = touched;
    r.cell.verdict = verdict;
    r.cell.wrongInterior = wrong;
    return r;
}

std::vector<std::string> methodsOf(const Advice& advice) {
    std::vector<std::string> methods;
    for (const AdviceRow& r : advice.rows) methods.push_back(r.method);
    return methods;
}

TEST(Advice, RanksByTouchedPixelsAndPutsWhatIsNotDrawnLast) {
    const Advice advice =
        ranked({.rows = {row("refused", 1, Verdict::Refused), row("dear", 900, Verdict::Exact),
                         row("failed", 0, Verdict::Failed), row("wrong", 100, Verdict::Wrong, 7),
                         row("cheap", 500, Verdict::Exact)}});
    EXPECT_THAT(methodsOf(advice), ElementsAre("wrong", "cheap", "dear", "refused", "failed"));
    ASSERT_TRUE(advice.chosen);
    EXPECT_EQ(advice.rows[*advice.chosen].method, "cheap");
    ASSERT_TRUE(advice.nextCheaper());
    EXPECT_EQ(advice.nextCheaper()->method, "wrong");
}

TEST(Advice, RanksByTheModelsTimeBeforePixels) {
    std::vector<AdviceRow> rows{row("few slow", 10, Verdict::Exact), row("many fast", 90, Verdict::Exact),
                                row("fewer, as fast", 80, Verdict::Exact)};
    rows[0].cost.passes = {{.fillMs = 3}};
    rows[1].cost.passes = {{.fillMs = 0.1}, {.fillMs = 0.2}};
    rows[2].cost.passes = {{.fillMs = 0.3}};
    EXPECT_THAT(methodsOf(ranked({.rows = rows})), ElementsAre("fewer, as fast", "many fast", "few slow"))
        << "0.1 + 0.2 is no more than 0.3";
}

TEST(Advice, RanksEqualPixelsByVerticesThenPassesThenAsTheyCame) {
    std::vector<AdviceRow> rows;
    for (const char* method : {"first", "second", "passes", "vertices"})
        rows.push_back(row(method, 10, Verdict::Exact));
    for (AdviceRow& r : rows) r.amount.vertices = 30, r.minimal.plan.passes.resize(4);
    rows[2].minimal.plan.passes.resize(3);
    rows[3].amount.vertices = 29;
    EXPECT_THAT(methodsOf(ranked({.rows = rows})), ElementsAre("vertices", "passes", "first", "second"));
}

TEST(Advice, ChoosesNothingWhereNothingIsExact) {
    const Advice advice = ranked({.rows = {row("b", 20, Verdict::Edge, 3), row("a", 10, Verdict::Wrong, 9),
                                           row("c", 30, Verdict::Edge, 3), row("d", 1, Verdict::Refused)},
                                  .chosen = 0});
    EXPECT_FALSE(advice.chosen);
    EXPECT_FALSE(advice.nextCheaper());
    ASSERT_TRUE(advice.leastWrong());
    EXPECT_EQ(advice.leastWrong()->method, "b") << "of as many wrong pixels the cheaper";
    EXPECT_FALSE(ranked({.rows = {row("d", 1, Verdict::Refused)}}).leastWrong());
    EXPECT_FALSE(ranked({}).leastWrong());
}

TEST(Advice, ChoosesWhatIsProvedBeforeWhatWasOnlyDrawn) {
    Advice advice{.rows = {row("wrong", 10, Verdict::Wrong, 9), row("drawn", 20, Verdict::Exact),
                           row("proved", 30, Verdict::Exact), row("dear", 40, Verdict::Exact)}};
    advice.rows[0].proof = "a proof is of no use where it is wrong";
    advice.rows[2].proof = advice.rows[3].proof = "of every pixel";
    advice = ranked(advice);
    ASSERT_TRUE(advice.chosen);
    EXPECT_EQ(advice.rows[*advice.chosen].method, "proved");
    EXPECT_THAT(advice.cheaperUnproved(), ElementsAre(&advice.rows[1]));
    EXPECT_EQ(advice.nextCheaper(), &advice.rows[0]) << "the nearest that is not exact";
}

TEST(Advice, KnowsNothingCheaperThanTheCheapest) {
    const Advice advice = ranked({.rows = {row("a", 10, Verdict::Exact), row("b", 20, Verdict::Wrong, 9)}});
    EXPECT_FALSE(advice.nextCheaper());
}

}  // namespace advice_test
}  // namespace gnomon
