// The frame rates of Kolivand and Sunar 2011 beside ours.

#include "report/reproduce_kolivand2011.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gnomon {
namespace reproduce_kolivand2011_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Four frames whose times, in three rounds, are these.
KolivandRun runOf(const std::vector<std::vector<double>>& ms) {
    KolivandRun run{
        .scene = "knot", .triangles = 3074, .width = 320, .height = 240, .frames = 1, .repeats = 3};
    run.device = "a device";
    run.rows = kolivandTable1();
    for (std::size_t i = 0; i < ms.size(); ++i) run.rows[i].totalMs = ms[i], run.rows[i].buildMs = ms[i];
    compareRates(run.rows);
    return run;
}

// Table 1: frames per second.
TEST(KolivandTable1, HasThePublishedFiguresAndTheMethodsThatTheyName) {
    std::vector<double> published;
    for (const KolivandRow& row : kolivandTable1()) published.push_back(row.published);
    EXPECT_THAT(published, ElementsAre(71.47, 69.93, 65.51, 70.03));
    const auto rows = kolivandTable1();
    EXPECT_EQ(rows[1].axes.silhouette, Silhouette::Triangular);
    EXPECT_EQ(rows[2].axes.silhouette, Silhouette::Visible);
    EXPECT_EQ(rows[3].axes.store, Store::DepthMap);
}

TEST(KolivandTable1, ComparesRatesOfTheSameRound) {
    const KolivandRun run = runOf({{1, 2, 3}, {2, 4, 6}, {4, 8, 12}, {1, 2, 3}});
    EXPECT_EQ(run.rows[0].share.median, 1);
    EXPECT_EQ(run.rows[1].share.median, 0.5);
    EXPECT_EQ(run.rows[2].share.high, 0.25);
}

TEST(ShowKolivand, SaysWhichOrderIsConfirmed) {
    const std::string confirmed =
        showKolivand(runOf({{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {2, 2, 2}}), Format::Text);
    EXPECT_THAT(confirmed,
                AllOf(HasSubstr("71.47"), HasSubstr("Not comparable"), Not(HasSubstr("not confirmed"))));
    Page page;
    page.width = 200;
    const std::string refuted = showKolivand(runOf({{1, 1, 1}, {2, 2, 2}, {2, 2, 2}, {4, 4, 4}}), page);
    EXPECT_THAT(refuted, HasSubstr("not confirmed; published 0.937, here 1.00 (1.00 to 1.00)"));
    EXPECT_THAT(refuted, HasSubstr("not confirmed; published 1.001, here 0.500 (0.500 to 0.500)"));
}

TEST(ShowKolivand, AsCsvHasANumberInEachField) {
    const std::string csv = showKolivand(runOf({{1, 1, 1}, {2, 2, 2}, {4, 4, 4}, {1, 1, 1}}), Format::Csv);
    EXPECT_THAT(csv, HasSubstr("\ntriangular algorithm,heidmann,triangular,69.93,"));
    EXPECT_THAT(csv, HasSubstr(",0.5,0.5,0.5,2,2,2,2\r\n"));
}

TEST(ShowKolivand, AsJsonHasEveryFigure) {
    const auto all = nlohmann::json::parse(
        showKolivand(runOf({{1, 1, 1}, {2, 2, 2}, {4, 4, 4}, {1, 1, 1}}), Format::Json));
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0]["rows"].size(), 4u);
    EXPECT_EQ(all[0]["rows"][2]["share"]["median"], 0.25);
    EXPECT_EQ(all[0]["rows"][0]["published"]["fps"], 71.47);
}

}  // namespace reproduce_kolivand2011_test
}  // namespace gnomon
