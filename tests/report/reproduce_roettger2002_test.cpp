// The figures of Roettger, Irion and Ertl 2002 beside ours.

#include "report/reproduce_roettger2002.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gnomon {
namespace reproduce_roettger2002_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// Roettger, Irion, Ertl 2002, Table 1: scene passes / rectangles; in brackets with the maximum blend
// equation.
TEST(RoettgerTable1, HasThePublishedFigures) {
    std::vector<std::string> rows;
    for (const Comparison& r : roettgerTable1())
        rows.push_back(fmt::format("{} {}{} {}/{}", r.buffer, r.shade, r.maximum ? " max" : "",
                                   r.publishedScene, r.publishedRectangles));
    EXPECT_THAT(rows, ElementsAre("alpha black 1/4", "alpha ambient 2/4", "alpha attenuated 1/4",
                                  "alpha attenuated max 1/2", "screen black 2/3", "screen ambient 3/3",
                                  "screen attenuated 2/3", "screen attenuated max 2/1"));
}

TEST(RoettgerTable1, RunsTheMethodThatItNames) {
    for (const Comparison& r : roettgerTable1()) {
        EXPECT_EQ(name(r.axes.store), r.buffer);
        EXPECT_EQ(name(r.axes.shade), r.shade);
        EXPECT_EQ(r.axes.arithmetic, r.maximum ? Arithmetic::Halve : Arithmetic::Double);
        EXPECT_EQ(methodId(r.axes), "roettger-" + r.buffer + (r.maximum ? "-max" : ""));
    }
}

Comparison agreeing() {
    Comparison r = roettgerTable1().front();
    r.counted = r.planned = {r.publishedScene, 4, r.publishedRectangles, 0};
    return r;
}

TEST(Comparison, AgreesOnlyIfPublishedCountedAndPlannedDo) {
    EXPECT_TRUE(agreeing().agrees());
    Comparison scene = agreeing();
    ++scene.counted.scene, ++scene.planned.scene;
    EXPECT_FALSE(scene.agrees());
    Comparison rectangle = agreeing();
    ++rectangle.counted.rectangle, ++rectangle.planned.rectangle;
    EXPECT_FALSE(rectangle.agrees());
    Comparison planned = agreeing();
    ++planned.planned.volume;
    EXPECT_FALSE(planned.agrees());
}

TEST(ShowComparisons, SaysWhereFiguresDiffer) {
    Comparison differs = agreeing();
    ++differs.counted.rectangle;
    EXPECT_THAT(showComparisons({agreeing()}, Format::Text),
                AllOf(HasSubstr("agrees"), Not(HasSubstr("DIFFERS"))));
    EXPECT_THAT(showComparisons({agreeing(), differs}, Format::Text),
                AllOf(HasSubstr("1/5"), HasSubstr("DIFFERS")));
    EXPECT_THAT(showComparisons({agreeing()}, Format::Csv),
                HasSubstr(",plan_scene,plan_rectangle,agrees\r\n"));
    EXPECT_THAT(showComparisons({agreeing(), differs}, Format::Csv), testing::EndsWith(",0\r\n"));
    const auto json = nlohmann::json::parse(showComparisons({agreeing(), differs}, Format::Json));
    ASSERT_EQ(json.size(), 2u);
    EXPECT_EQ(json[0]["agrees"], true);
    EXPECT_EQ(json[1]["agrees"], false);
    EXPECT_EQ(json[1]["published"].dump(), R"({"rectangle":4,"scene":1})");
    EXPECT_EQ(json[1]["counted"].dump(), R"({"rectangle":5,"scene":1})");
}

}  // namespace reproduce_roettger2002_test
}  // namespace gnomon
