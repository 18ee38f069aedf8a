// Plans that are explained: why each pass is there, what is left out and why, minimal and full side by side.

#include "report/plan_notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "report/explained_plans.h"
#include "report/listings.h"

namespace gnomon {
namespace plan_notes_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

/// The reason of the first pass of which @p which is true.
template <class Which>
std::string reasonOf(const PlanSheet& sheet, const Which& which) {
    for (std::size_t i = 0; i < sheet.plan.passes.size(); ++i)
        if (which(sheet.plan.passes[i])) return reasonFor(sheet.plan, i, sheet.notes->effects);
    return "no such pass";
}

bool isVolume(const Pass& pass) {
    return pass.kind == PassKind::Volume;
}
bool isRectangle(const Pass& pass) {
    return pass.kind == PassKind::Rectangle;
}

TEST(Reason, OfAVolumePassIsHowManyVolumesReachWhatIsSeenAndWhere) {
    EXPECT_THAT(reasonOf(explainedSheet("carmack"), isVolume),
                HasSubstr("2 volumes reach what is seen, in 183x122 at 60,40"));
    PlanSheet one = explainedSheet("carmack");
    one.plan.windows[0].volumes[0] = {};
    EXPECT_THAT(reasonOf(one, isVolume), HasSubstr("1 volume reaches what is seen"));
    EXPECT_THAT(reasonOf(explainedSheet("roettger-screen"), isVolume),
                HasSubstr("it reaches what is seen in 90x80 at 60,40"));
}

TEST(Reason, SaysThatNothingBoundsAFullPlan) {
    PlanSheet s = explainedSheet("carmack");
    s.plan = s.notes->full;
    EXPECT_THAT(reasonOf(s, isVolume), HasSubstr("all volumes, wherever they are"));
    EXPECT_THAT(reasonOf(s, isRectangle), Not(HasSubstr("none but")));
}

TEST(Reason, HoldsTheFactOfAnEffectThatThePassIsThereFor) {
    const auto capped = [](const Pass& pass) { return isVolume(pass) && pass.parts.has(Part::FarCap); };
    EXPECT_THAT(reasonOf(explainedSheet("carmack"), capped),
                HasSubstr("; far-caps: the background is seen in 41 blocks inside of volumes"));
    const auto ambient = [](const Pass& pass) { return pass.shading == Shading::Ambient; };
    EXPECT_THAT(reasonOf(explainedSheet("carmack", Shade::Ambient), ambient),
                HasSubstr("; ambient: ambient 0.2 of the reflectance"));
    EXPECT_THAT(reasonOf(explainedSheet("roettger-alpha"), isRectangle),
                HasSubstr("; levels: --effects asks for it; volumes nest up to 1 deep"));
}

TEST(Reason, OfASceneOverItsMaskSaysWhereShadowsEnd) {
    PlanSheet s = explainedSheet("roettger-screen");
    Pass& over = s.plan.passes.back();
    const auto reason = [&] { return reasonFor(s.plan, s.plan.passes.size() - 1, {}); };
    EXPECT_EQ(reason(), "the light arrives where the mask is lit");
    over.extent = Extent::Shadows;
    EXPECT_EQ(reason(),
              "the light arrives where the mask is lit; outside of 183x122 at 60,40 nothing is in shadow");
}

TEST(Reason, DoesNotNameAnEffectThatIsLeftOutOrOfAnotherLight) {
    PlanSheet s = explainedSheet("roettger-alpha");
    EXPECT_THAT(reasonOf(s, isVolume), Not(HasSubstr("near-caps")));
    for (EffectNote& note : s.notes->effects) note.light = 1;
    EXPECT_THAT(reasonOf(s, isVolume), Not(HasSubstr("far-caps")));
}

/// The mask's values first, then what they do to the picture.
TEST(Reason, TellsNormalisationAndApplicationApart) {
    const PlanSheet s = explainedSheet("roettger-alpha");
    const std::size_t last = s.plan.passes.size() - 1;
    EXPECT_THAT(reasonFor(s.plan, last, {}),
                AllOf(HasSubstr("shadows take the light away"), HasSubstr("none but in 183x122 at 60,40")));
    EXPECT_THAT(reasonFor(s.plan, last - 1, {}), HasSubstr("one value for lit"));
}

TEST(Reason, IsThereForEveryPassOfEveryMethod) {
    std::set<std::string> reasons;
    for (const NamedMethod& method : namedMethods()) {
        for (const Shade shade : {Shade::Black, Shade::Ambient, Shade::Attenuated}) {
            const PlanSheet s = explainedSheet(method.id, shade);
            Axes axes = method.axes;
            axes.shade = shade;
            const Plan lights = planFrame(axes, {320, 240, {{.volumes = 2}, {.volumes = 1}}}, chip("ideal"));
            for (const Plan& plan : {s.plan, s.notes->full, lights}) {
                for (std::size_t i = 0; i < plan.passes.size(); ++i) {
                    const std::string reason = reasonFor(plan, i, s.notes->effects);
                    EXPECT_FALSE(reason.empty()) << method.id << ": " << plan.passes[i].label;
                    reasons.insert(reason);
                }
            }
        }
    }
    EXPECT_GT(reasons.size(), 20u);
}

TEST(ExplainedPlan, SaysWhyUnderEachPassAndWhatItTouches) {
    const std::string text = showPlans({explainedSheet("carmack")}, Format::Text);
    EXPECT_THAT(text, AllOf(HasSubstr("pass  draws      touches  what\n"),
                            HasSubstr("\n2     scene      100      scene: lit\n"
                                      "      depth LESS write, write RGB\n"
                                      "      why: every surface that is seen, and its depth\n"
                                      "3     volume     100      front and")));
}

TEST(ExplainedPlan, PutsTheChipsTermsBetweenStateAndReason) {
    PlanSheet s = explainedSheet("carmack");
    s.chipTerms = {"", "COLCLAMP=0"};
    EXPECT_THAT(showPlans({s}, Format::Text),
                HasSubstr("write RGB\n      ideal: COLCLAMP=0\n      why: every"));
}

TEST(ExplainedPlan, ListsWhatIsLeftOutCalledForAndAskedFor) {
    const std::string text = showPlans({explainedSheet("carmack")}, Format::Text);
    const std::size_t out = text.find("\nLeft out\n"), called = text.find("\nCalled for by the frame\n"),
                      asked = text.find("\nKept though nothing calls for it");
    ASSERT_LT(out, called) << text;
    ASSERT_LT(called, asked) << text;
    ASSERT_NE(asked, std::string::npos) << text;
    EXPECT_THAT(text.substr(out, called - out),
                AllOf(HasSubstr("\n  volumes    1 of 3 volumes holds no point that is seen\n"),
                      HasSubstr("\n  near-caps  nearest volume is 1.21 units from the near rectangle\n"),
                      Not(HasSubstr("ambient"))));
    EXPECT_THAT(text.substr(called, asked - called), HasSubstr("\n  ambient    ambient 0.2"));
    EXPECT_THAT(text.substr(asked), HasSubstr("\n  levels     volumes nest up to 1 deep"));
}

TEST(ExplainedPlan, NamesLightsWhereThereAreSeveral) {
    PlanSheet s = explainedSheet("carmack");
    s.notes->effects[1].light = 2;
    EXPECT_THAT(showPlans({s}, Format::Text), HasSubstr("  near-caps  light 2: nearest volume is"));
}

TEST(ExplainedPlan, PutsMinimalAndFullSideBySide) {
    PlanSheet s = explainedSheet("carmack");
    s.plan.passes.pop_back();
    s.notes->amounts.pop_back();
    s.notes->fullAmount = {{.clear = 600, .volume = 400}, 240};
    const std::string text = showPlans({s}, Format::Text);
    EXPECT_THAT(text, AllOf(HasSubstr("rectangles      0        1     0.00\n"),
                            HasSubstr("touched pixels  400      1000  0.40\n"),
                            HasSubstr("vertices        120      240   0.50\n"),
                            HasSubstr("  of clears     0        600   0.00\n")))
        << text;
    EXPECT_THAT(text, Not(HasSubstr("copies  "))) << "neither has any";
}

/// A level has thousands: they are folded, and their pixels added up.
TEST(ExplainedPlan, AddsUpWhatFoldedPassesTouch) {
    PlanSheet s = explainedSheet("carmack");
    const Pass volume = *std::find_if(s.plan.passes.begin(), s.plan.passes.end(), isVolume);
    s.plan.passes.assign(11, volume);
    s.notes->amounts.assign(11, {{.volume = 7}, 3});
    EXPECT_THAT(showPlans({s}, Format::Text),
                HasSubstr("...   volume  21       3 more, front and back faces in turn\n"));
}

TEST(ExplainedPlan, IsJsonWithReasonsScissorsAndEffects) {
    const Json json = Json::parse(showPlans({explainedSheet("carmack")}, Format::Json))[0];
    const Json &scene = json["passes"][1], &volume = json["passes"][2], &apply = json["passes"].back();
    EXPECT_EQ(scene["scissor"], nullptr);
    EXPECT_EQ(volume["scissor"].size(), 3u);
    EXPECT_EQ(volume["scissor"][0], (Json{{"x", 60}, {"y", 40}, {"width", 90}, {"height", 80}}));
    EXPECT_EQ(apply["scissor"]["width"], 183);
    EXPECT_EQ(volume["touched"], 100);
    EXPECT_EQ(volume["vertices"], 30);
    EXPECT_THAT(volume["reason"].get<std::string>(), HasSubstr("2 volumes reach"));
    EXPECT_EQ(json["effects"][1], (Json{{"effect", "near-caps"},
                                        {"light", 0},
                                        {"drawn", false},
                                        {"asked", false},
                                        {"fact", "nearest volume is 1.21 units from the near rectangle"}}));
    EXPECT_EQ(json["effects"][4]["light"], nullptr);
    EXPECT_EQ(json["touched"]["total"], 100 * json["passes"].size());
    EXPECT_EQ(json["full"]["touched"]["volume"], 200 * json["passes"].size());
    EXPECT_EQ(json["full"]["vertices"], 1234);
    EXPECT_EQ(json["drawn_as"], "carmack");
}

TEST(ExplainedPlan, IsCsvWithALinePerEffect) {
    const std::string csv = showPlans({explainedSheet("carmack")}, Format::Csv);
    EXPECT_THAT(csv,
                AllOf(HasSubstr("chip_terms,reason,vertices,touched,model_ms,model_limit\r\n"),
                      HasSubstr(",,left out,near-caps of light 0,,,nearest volume is 1.21 units from the "
                                "near rectangle,,,,\r\n"),
                      HasSubstr(",,called for,ambient,,,ambient 0.2 of the reflectance,,,,\r\n"),
                      HasSubstr(",,asked for,levels of light 0,"), HasSubstr(",30,100,,\r\n")));
    PlanSheet plain = explainedSheet("carmack");
    plain.notes.reset();
    EXPECT_THAT(showPlans({plain}, Format::Csv),
                AllOf(HasSubstr(",state,chip_terms\r\n"), Not(HasSubstr("left out"))));
}

TEST(ExplainedPlan, SaysWhatItIsDrawnAsIfNotAsAsked) {
    PlanSheet s = explainedSheet("carmack");
    EXPECT_THAT(showPlans({s}, Format::Text), Not(HasSubstr("Drawn as")));
    s.notes->drawnAs = "heidmann";
    EXPECT_THAT(showPlans({s}, Format::Text), HasSubstr("\nDrawn as heidmann\n"));
    EXPECT_EQ(Json::parse(showPlans({s}, Format::Json))[0]["drawn_as"], "heidmann");
}

TEST(ExplainedPlan, TellsTheTimeOfEachPassWhereTheChipHasRates) {
    PlanSheet sheet = explainedSheet("roettger-screen");
    EXPECT_THAT(showPlans({sheet}, Format::Text), Not(HasSubstr("limit")));
    CostNotes cost{.rates = {"fill 90 Mpixel/s [IXBT]"}};
    cost.minimal.passes.assign(sheet.plan.passes.size(), {.kind = PassKind::Volume, .fillMs = 0.25});
    cost.full = cost.minimal;
    sheet.notes->cost = cost;
    const std::string text = showPlans({sheet}, Format::Text);
    EXPECT_THAT(text,
                AllOf(HasSubstr("pass  draws      touches  ms    limit  what\n"),
                      HasSubstr("  100      0.25  fill   "), HasSubstr("rates: fill 90 Mpixel/s [IXBT]")))
        << text;
    const auto json = nlohmann::json::parse(showPlans({sheet}, Format::Json))[0];
    EXPECT_EQ(json["passes"][0]["model"]["ms"], 0.25);
    EXPECT_EQ(json["model"]["ms"], 0.25 * double(sheet.plan.passes.size()));
    EXPECT_EQ(json["model"]["full"]["limit"], "fill");
    EXPECT_THAT(showPlans({sheet}, Format::Csv),
                AllOf(HasSubstr(",model_ms,model_limit\r\n"), HasSubstr(",100,0.25,fill\r\n")));
}

}  // namespace plan_notes_test
}  // namespace gnomon
