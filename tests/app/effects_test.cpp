// --effects, plan --explain, auto and advise, as a user runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"

namespace gnomon {
namespace effects_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

class EffectsOf : public ProgramTest {
  protected:
    Json cell(std::vector<std::string> options) const {
        std::vector<std::string> arguments{"matrix",   "boxes", "--size",   "96x72",
                                           "--frames", "0",     "--format", "json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return Json::parse(run(arguments).out).at(0);
    }
};

std::int64_t touched(const Json& cell) {
    std::int64_t sum = 0;
    for (const auto& [kind, pixels] : cell["touched"].items()) sum += pixels.get<std::int64_t>();
    return sum;
}

TEST_F(EffectsOf, NamedMethodsAreFullUnlessSaidOtherwise) {
    const std::vector<std::string> carmack{"--profile", "ideal", "--method", "carmack"};
    const auto with = [&](const std::string& effects) {
        std::vector<std::string> options = carmack;
        options.insert(options.end(), {"--effects", effects});
        return cell(options);
    };
    const Json plain = cell(carmack), full = with("full"), needed = with("needed");
    EXPECT_EQ(plain["effects"], "full");
    EXPECT_EQ(plain["passes"], full["passes"]);
    EXPECT_EQ(plain["touched"], full["touched"]);
    EXPECT_EQ(needed["effects"], "needed");
    EXPECT_EQ(needed["digest"], full["digest"]);
    EXPECT_LT(touched(needed), touched(full));
    const Json caps = with("near-caps,window");
    EXPECT_EQ(caps["effects"], "near-caps,window");
    EXPECT_EQ(caps["passes"], full["passes"]);
    EXPECT_EQ(caps["digest"], full["digest"]);
}

TEST_F(EffectsOf, AutoSaysWhatItDraws) {
    const Json chosen = cell({"--profile", "voodoo2", "--method", "auto"});
    EXPECT_EQ(chosen["method"], "auto");
    EXPECT_EQ(chosen["drawn_by"], "roettger-screen");
    EXPECT_EQ(chosen["proof"], "predicted");
    EXPECT_EQ(chosen["verdict"], "exact");
    EXPECT_EQ(chosen["effects"], "needed");
    EXPECT_EQ(cell({"--profile", "voodoo2", "--method", "auto", "--effects", "full"})["effects"], "full");
    const std::string text = run({"matrix", "boxes", "--size", "96x72", "--frames", "0", "--profile",
                                  "voodoo2", "--method", "auto"})
                                 .out;
    EXPECT_THAT(text, HasSubstr("Methods that were chosen\n  auto: roettger-screen (voodoo2)\n"));
}

TEST_F(EffectsOf, BadWordsAreRefused) {
    for (const char* command : {"matrix", "render", "plan"}) {
        expectRefused(run({command, "boxes", "--effects", "shadows"}), "--effects: no such effect 'shadows'");
        expectRefused(run({command, "boxes", "--effects", "levels,full"}), "'full'");
        expectRefused(run({command, "boxes", "--effects", ""}), "--effects");
    }
}

TEST_F(EffectsOf, PlansAreExplained) {
    const std::string text = run({"plan", "boxes", "--method", "carmack", "--explain"}).out;
    EXPECT_THAT(text, AllOf(HasSubstr("Left out"), HasSubstr("units from the near rectangle"),
                            HasSubstr("Drawn as heidmann"), HasSubstr("touched pixels")));
    EXPECT_THAT(run({"plan", "boxes", "--method", "carmack"}).out, Not(HasSubstr("Left out")));
    const std::string full =
        run({"plan", "boxes", "--method", "carmack", "--explain", "--effects", "full"}).out;
    EXPECT_THAT(full, AllOf(Not(HasSubstr("Left out")), Not(HasSubstr("scissor"))));
    const Json json =
        Json::parse(run({"plan", "boxes", "--method", "carmack", "--explain", "--format", "json"}).out);
    for (const Json& pass : json[0]["passes"]) EXPECT_NE(pass["reason"], "") << pass;
    bool leavesOutCaps = false;
    for (const Json& note : json[0]["effects"])
        leavesOutCaps = leavesOutCaps || (note["effect"] == "near-caps" && note["drawn"] == false);
    EXPECT_TRUE(leavesOutCaps);
    EXPECT_LT(json[0]["touched"]["total"], json[0]["full"]["touched"]["total"]);
}

class Advising : public ProgramTest {};

TEST_F(Advising, ListsMethodsCheapestFirstAndCallsToCopy) {
    const Outcome outcome = run({"advise", "boxes", "--profile", "voodoo2"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("roettger-screen"),
                                   HasSubstr("glBlendFunc(GL_DST_COLOR, GL_ONE);"), HasSubstr("glScissor(")));
}

TEST_F(Advising, ChoosesWhatAutoDraws) {
    for (const char* profile : {"ideal", "voodoo1", "ps2", "tnt"}) {
        const Json advice =
            Json::parse(run({"advise", "roettger", "--profile", profile, "--format", "json"}).out);
        const Json cell = Json::parse(run({"matrix", "roettger", "--frames", "0", "--profile", profile,
                                           "--method", "auto", "--format", "json"})
                                          .out);
        EXPECT_EQ(advice.at(0)["chosen"], cell.at(0)["drawn_by"]) << profile;
    }
}

TEST_F(Advising, SaysWhereNothingIsExact) {
    const Outcome outcome = run({"advise", "boxes", "--profile", "ps1"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.out, "");
}

TEST_F(Advising, RefusesBadArguments) {
    expectRefused(run({"advise", "nowhere"}), "nowhere");
    expectRefused(run({"advise", "boxes", "--profile", "voodoo9"}), "voodoo9");
    expectRefused(run({"advise", "boxes", "--frame", "60"}), "--frame: boxes has frames 0 to 59");
    expectRefused(run({"advise", "boxes", "--profile", "tnt,ideal"}), "2 given");
}

}  // namespace effects_test
}  // namespace gnomon
