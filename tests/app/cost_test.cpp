// gnomon cost as a user runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "image/image.h"
#include "program.h"

namespace gnomon {
namespace cost_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::json;

class CostCommand : public ProgramTest {
  protected:
    /// Small, and timed once.
    Outcome cost(std::vector<std::string> arguments) const {
        std::vector<std::string> all{"cost", "--size", "64x48", "--repeats", "1"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run(all);
    }
};

TEST_F(CostCommand, PrintsTheTableAndDrawsThePlot) {
    const Outcome done =
        cost({"roettger", "--method", "none,heidmann,roettger-half", "-o", pathOf("plot.png")});
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    EXPECT_THAT(done.out, HasSubstr("roettger on ideal, 64x48, frame 0: what accuracy costs"));
    EXPECT_THAT(done.out, HasSubstr("\nheidmann "));
    EXPECT_THAT(leftBehind(), ElementsAre("plot.png"));
    const Image plot = readImage(pathOf("plot.png"));
    EXPECT_EQ(plot.width, 1500);
    EXPECT_EQ(plot.height, 2 * 930);
}

TEST_F(CostCommand, IsAnArrayInJsonAndHasTheSweepByDefault) {
    const Outcome done = cost(
        {"boxes", "--profile", "voodoo2", "--frames", "0,5", "--format", "json", "-o", pathOf("plot.svg")});
    EXPECT_EQ(done.status, 0) << done.err;
    const Json all = Json::parse(done.out);
    std::vector<std::string> refused;
    bool hasChip = false, hasLevels = false;
    for (const Json& one : all) {
        EXPECT_EQ(one["profile"], "voodoo2");
        EXPECT_EQ(one["frames"], Json({0, 5}));
        if (!one["missing"].empty()) refused.push_back(one["setting"]);
        hasChip = hasChip || one["setting"] == "roettger-screen, chip";
        hasLevels = hasLevels || one["setting"] == "roettger-screen levels 3";
    }
    EXPECT_TRUE(hasChip);
    EXPECT_TRUE(hasLevels);
    EXPECT_THAT(refused, testing::Contains("heidmann"));
    EXPECT_THAT(contentOf(pathOf("plot.svg")), HasSubstr("</svg>"));
}

TEST_F(CostCommand, RefusesBadArgumentsInOneLineAndLeavesNothing) {
    expectRefused(cost({"-o", pathOf("plot.pdf")}), "plot.pdf: a plot's name ends in .svg or .png");
    expectRefused(cost({"-o", pathOf("missing/plot.png")}), "plot.png: no folder");
    expectRefused(cost({"--frames", "60"}), "--frames: roettger has frames 0 to 59");
    expectRefused(cost({"--frames", "x"}), "--frames: 'x' is not a whole number");
    expectRefused(cost({"--method", "nothing"}), "--method: no such method 'nothing'");
    expectRefused(cost({"--profile", "ideal,ps2"}), "--profile: 2 given, but this command takes one");
    expectRefused(cost({"--scene", "roettger,boxes"}), "--scene: 2 given");
    expectRefused(cost({"--repeats", "0"}), "--repeats");
    expectRefused(cost({"--shade", "black,ambient"}), "--shade: 2 given");
    EXPECT_THAT(leftBehind(), IsEmpty());
}

TEST_F(CostCommand, HasExitStatusOneWhereAChipCanDoNothing) {
    const Outcome refused = cost({"--profile", "voodoo2", "--method", "carmack"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_THAT(refused.out, HasSubstr("Refused\n  carmack: lacks "));
    const Outcome plotted = cost({"--profile", "voodoo2", "--method", "carmack", "-o", pathOf("a.png")});
    EXPECT_EQ(plotted.status, 1);
    EXPECT_THAT(plotted.err, HasSubstr("a.png: nothing to plot"));
    EXPECT_THAT(leftBehind(), IsEmpty());
}

}  // namespace cost_test
}  // namespace gnomon
