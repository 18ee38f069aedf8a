// The states of a mask as a graph.

#include "report/mask_states.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "report/small_run.h"

namespace gnomon {
namespace mask_states_test {

using testing::ElementsAre;

std::map<int, std::string> statesOf(const MaskStates& graph) {
    std::map<int, std::string> states;
    for (const MaskState& state : graph.states) states[state.code] = meaning(state);
    return states;
}

std::map<std::pair<int, std::string>, int> stepsOf(const MaskStates& graph) {
    std::map<std::pair<int, std::string>, int> steps;
    for (const MaskStep& step : graph.steps) steps[{step.from, meaning(step, graph)}] = step.to;
    return steps;
}

// Section 4.2: from a quarter two volumes may be open; a third clamps, and its way back ends below the start.
TEST(MaskStates, OfDoublingFromAQuarter) {
    const MaskClaim claim{.channel = {.bits = 8}, .arithmetic = MaskArithmetic::Double};
    const MaskStates two = maskStates(claim, {.start = 64}, 1);
    EXPECT_EQ(statesOf(two), (std::map<int, std::string>{{64, "start"}, {128, "in shadow"}}));
    EXPECT_EQ(stepsOf(two), (std::map<std::pair<int, std::string>, int>{{{64, "front face doubles"}, 128},
                                                                        {{128, "back face halves"}, 64}}));

    const auto three = statesOf(maskStates(claim, {.start = 64}, 3));
    EXPECT_EQ(three.at(255), "in shadow");
    EXPECT_EQ(three.at(64), "start, lit or in shadow") << "255 halves to 128 and 64 while one is still open";
    EXPECT_EQ(three.at(32), "lit") << "and to less than the start when all are closed";
}

// Section 4.4: shadows are darker.
TEST(MaskStates, OfHalvingFromOne) {
    const MaskClaim claim{.channel = {.bits = 8}, .arithmetic = MaskArithmetic::Halve};
    const MaskStates graph = maskStates(claim, {.start = 255}, 2);
    const auto states = statesOf(graph);
    EXPECT_EQ(states.at(255), "start");
    const auto steps = stepsOf(graph);
    EXPECT_LT(steps.at({255, "front face halves"}), 255);
    EXPECT_TRUE(steps.contains({128, "back face doubles"}) || steps.contains({127, "back face doubles"}));
}

TEST(MaskStates, OfARunAreThoseOfItsMethodsEachOnce) {
    std::vector<std::string> found;
    for (const MaskStates& graph : gnomon::statesOf(smallRun().cells, smallRun().sources))
        found.push_back(graph.method + " on " + graph.profile + ": " + graph.title);
    EXPECT_THAT(found, ElementsAre("roettger-screen on ideal: double in 8 bits, up to 3 volumes open",
                                   "roettger-screen on voodoo2: double in 5 bits, up to 3 volumes open"));
}

}  // namespace mask_states_test
}  // namespace gnomon
