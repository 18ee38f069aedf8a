// gnomon plan, as a user runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"

namespace gnomon {
namespace plan_test {

using testing::AllOf;
using testing::HasSubstr;
using Json = nlohmann::json;

class PlanCommand : public ProgramTest {};

TEST_F(PlanCommand, SpeaksThePlayStation2sOwnTermsBesideOpenGLs) {
    const Outcome outcome = run({"plan", "boxes", "--profile", "ps2"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("ps2: ALPHA A=Cd B=0 C=FIX D=Cd,"), HasSubstr("1 copy\n")));
    // The text breaks long lines, CSV does not.
    EXPECT_THAT(run({"plan", "boxes", "--profile", "ps2", "--format", "csv"}).out,
                AllOf(HasSubstr("blend DST_COLOR ONE"),
                      HasSubstr("ALPHA A=Cd B=0 C=FIX D=Cd, FIX=0x80, COLCLAMP=1, FBMSK=0xFF000000, "
                                "TEST ZTST=GEQUAL, ZMSK=1\"")));
}

TEST_F(PlanCommand, GivesThemInJson) {
    const Json json = Json::parse(run({"plan", "boxes", "--profile", "voodoo2", "--format", "json"}).out);
    int volumes = 0;
    for (const Json& pass : json[0]["passes"]) {
        if (pass["kind"] != "volume") continue;
        EXPECT_THAT(pass["chip_terms"].get<std::string>(),
                    AllOf(HasSubstr("grAlphaBlendFunction"), HasSubstr("GR_DITHER_DISABLE")));
        ++volumes;
    }
    EXPECT_GT(volumes, 0);
}

TEST_F(PlanCommand, TakesStartAndOverflowOfCountsInColour) {
    const auto plan = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"plan",         "boxes", "--store",  "screen",
                                           "--arithmetic", "count", "--format", "csv"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run(arguments);
    };
    EXPECT_THAT(plan({"--overflow", "wrap"}).out, HasSubstr("blend ADD_WRAP ONE ONE"));
    EXPECT_THAT(plan({"--overflow", "saturate"}).out, HasSubstr("blend REVERSE_SUBTRACT ONE ONE"));
    EXPECT_THAT(plan({"--start", "middle"}).out, HasSubstr("take the start away"));
    expectRefused(plan({"--start", "middle", "--overflow", "wrap"}), "the middle is for one that saturates");
}

}  // namespace plan_test
}  // namespace gnomon
