// gnomon reproduce, on small frames: that what is measured is there. Its figures are the machine's.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"

namespace gnomon {
namespace reproduce_test {

using testing::AllOf;
using testing::Each;
using testing::Gt;
using testing::HasSubstr;
using Json = nlohmann::json;

class Reproducing : public ProgramTest {};

const std::vector<std::string> kSmall{"--size", "64x48", "--repeats", "2"};

std::vector<std::string> smallRun(const std::vector<std::string>& words) {
    std::vector<std::string> all{"reproduce"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), kSmall.begin(), kSmall.end());
    return all;
}

TEST_F(Reproducing, Kolivand2011MeasuresTheFourRows) {
    const Outcome outcome = run(smallRun({"kolivand2011", "--frames", "2", "--format", "json"}));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json rows = Json::parse(outcome.out)[0]["rows"];
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0]["share"]["median"], 1);
    for (const Json& row : rows) EXPECT_GT(row["frame_ms"]["median"], 0);
    EXPECT_EQ(rows[0]["build_ms"]["median"], 0) << "without shadow nothing is built";
    EXPECT_GT(rows[1]["build_ms"]["median"], 0);
    EXPECT_EQ(rows[1]["silhouette"], "triangular");
    EXPECT_EQ(rows[2]["silhouette"], "visible");
}

// A closed mesh of T triangles has 3T/2 edges; brute force draws each lit triangle's five faces.
TEST_F(Reproducing, AldridgeCountsEdgesAndPolygonsOfBothBuilders) {
    const Outcome outcome = run(smallRun({"aldridge", "--scene", "knot", "--format", "json"}));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json all = Json::parse(outcome.out)[0];
    const auto triangles = all["triangles"].get<std::size_t>();
    EXPECT_EQ(all["rows"][0]["edges"], triangles * 3 / 2);
    EXPECT_EQ(all["rows"][1]["edges"], triangles * 3);
    EXPECT_EQ(all["lights"], 16) << "a ring of lights around a scene that has but one";
    EXPECT_EQ(all["rows"][1]["polygons"].get<std::size_t>() % 5, 0u);
    EXPECT_GT(all["rows"][1]["polygons"], all["rows"][0]["polygons"]);
}

TEST_F(Reproducing, Usta2019DrawsAPlotWithALinePerMethod) {
    const std::string plot = pathOf("figure4.svg");
    const Outcome outcome = run(
        smallRun({"usta2019", "--scene", "boxes,roettger", "--frames", "2", "--format", "json", "-o", plot}));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json scenes = Json::parse(outcome.out)[0]["scenes"];
    ASSERT_EQ(scenes.size(), 2u);
    for (const Json& scene : scenes) {
        ASSERT_EQ(scene["lines"].size(), 7u);
        for (const Json& line : scene["lines"]) {
            EXPECT_EQ(line["ms"].size(), 2u);
            EXPECT_THAT(line["ms"].get<std::vector<double>>(), Each(Gt(0.0)));
            EXPECT_EQ(line["wrong"], 0) << line["method"];
        }
        EXPECT_EQ(scene["lines"][0]["ratio"]["median"], 1);
    }
    EXPECT_THAT(contentOf(plot), AllOf(HasSubstr("<svg"), HasSubstr("</svg>")));
}

TEST_F(Reproducing, Usta2019CutsTrianglesInFour) {
    const Outcome outcome = run(smallRun({"usta2019", "--scene", "boxes,roettger", "--frames", "1",
                                          "--subdivide", "0,1", "--format", "json"}));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json scenes = Json::parse(outcome.out)[0]["scenes"];
    EXPECT_EQ(scenes[0]["triangles"], 350);
    EXPECT_EQ(scenes[1]["triangles"], 4 * 132);
}

TEST_F(Reproducing, RefusesWhatAPaperHasNoUseFor) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> runs{
        {{"reproduce", "roettger2002", "--subdivide", "1"}, "--subdivide: not for roettger2002"},
        {{"reproduce", "aldridge", "--frames", "3"}, "--frames: not for aldridge"},
        {{"reproduce", "kolivand2011", "-o", "a.svg"}, "--output: not for kolivand2011"},
        {{"reproduce", "kolivand2011", "--scene", "boxes,knot"}, "--scene: 2 given"},
        {{"reproduce", "usta2019", "--scene", "boxes", "--subdivide", "1,2"}, "2 numbers for 1 scenes"},
        {{"reproduce", "usta2019", "--scene", "hard/no-light"}, "no light"},
        {{"reproduce", "aldridge", "--scene", "hard/no-caster"}, "no object casts"},
        {{"reproduce", "usta2019", "--scene", "boxes", "--frames", "1", "--repeats", "1", "--size", "32x24",
          "-o", pathOf("a.pdf")},
         "a.pdf"}};
    for (const auto& [arguments, message] : runs) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2) << arguments[1];
        EXPECT_THAT(outcome.err, HasSubstr(message));
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
}

}  // namespace reproduce_test
}  // namespace gnomon
