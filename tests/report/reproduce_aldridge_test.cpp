// The figures of Aldridge and Woods beside ours.

#include "report/reproduce_aldridge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gnomon {
namespace reproduce_aldridge_test {

using testing::AllOf;
using testing::HasSubstr;

AldridgeRun someRun() {
    AldridgeRun run{.scene = "level", .triangles = 100, .crowdedEdges = 7, .mostAtAnEdge = 5, .lights = 3};
    run.where = "the file's";
    run.rows = aldridgeSection4();
    run.rows[0].edges = 150, run.rows[0].polygons = 1000, run.rows[0].frameMs = {1, 2, 4};
    run.rows[1].edges = 300, run.rows[1].polygons = 2500, run.rows[1].frameMs = {2, 5, 12};
    return run;
}

// Section 4, on Figure 5.
TEST(AldridgeSection4, HasThePublishedFigures) {
    const auto rows = aldridgeSection4();
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].publishedFps, 4.2);
    EXPECT_EQ(rows[0].publishedEdges, 385'077u);
    EXPECT_EQ(rows[0].publishedPolygons, 2'405'000u);
    EXPECT_EQ(rows[1].publishedFps, 2.3);
    EXPECT_EQ(rows[1].publishedEdges, 763'431u);
    EXPECT_EQ(rows[1].publishedPolygons, 4'440'000u);
}

TEST(ShowAldridge, GivesBruteForceAsAMultipleOfTheCounter) {
    const auto all = nlohmann::json::parse(showAldridge(someRun(), Format::Json));
    const auto& multiples = all[0]["brute_force_over_counter"];
    EXPECT_NEAR(multiples[0]["published"].get<double>(), 1.983, 0.001);
    EXPECT_EQ(multiples[0]["ours"], 2);
    EXPECT_NEAR(multiples[1]["published"].get<double>(), 1.846, 0.001);
    EXPECT_EQ(multiples[1]["ours"], 2.5);
    EXPECT_NEAR(multiples[2]["published"].get<double>(), 1.826, 0.001);
    EXPECT_EQ(multiples[2]["ours"], 2.5) << "the median of 2, 2.5 and 3";
    EXPECT_THAT(
        showAldridge(someRun(), Format::Text),
        AllOf(HasSubstr("2.50 (2.25 to 2.75)"), HasSubstr("here 7, up to 5"), HasSubstr("Not comparable")));
}

TEST(ShowAldridge, AsCsvIsOneTable) {
    const std::string csv = showAldridge(someRun(), Format::Csv);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
}

}  // namespace reproduce_aldridge_test
}  // namespace gnomon
