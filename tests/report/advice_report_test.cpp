// Advice as text, JSON and CSV, from rows made by hand.

#include "report/advice_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "matrix/cell_json.h"
#include "profile/shipped.h"

namespace gnomon {
namespace advice_report_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

AdviceRow row(const std::string& method, std::int64_t touched) {
    AdviceRow r{.method = method};
    r.minimal.axes = findMethod(method)->axes;
    r.minimal.plan = planFrame(r.minimal.axes, {320, 240, {{.volumes = 2}}}, chip("voodoo2"));
    r.amount = {{.scene = 100, .volume = touched - 100}, 60};
    r.fullAmount = {{.volume = 2 * touched}, 240};
    r.cell = {.profile = "voodoo2", .method = method, .scene = "boxes", .axes = r.minimal.axes};
    r.cell.width = 320, r.cell.height = 240, r.cell.pixels = 76800;
    r.cell.verdict = Verdict::Exact;
    return r;
}

/// A cheaper wrong method, the chosen one, a dearer exact one, two refused for the same and one for
/// something else.
Advice advice() {
    Advice a{.profile = "voodoo2", .scene = "boxes", .width = 320, .height = 240, .frame = 3};
    a.rows = {row("screen-zfail", 2500), row("roettger-screen", 1000),
              row("screen-parity", 700), row("heidmann", 1),
              row("carmack", 1),         row("roettger-alpha", 1)};
    Cell& parity = a.rows[2].cell;
    parity.verdict = Verdict::Wrong, parity.wrongEdge = 2, parity.wrongInterior = 900;
    parity.causes = {{"mask clamps", 2}, {"parity of overlapping volumes", 900}};
    for (std::size_t i = 3; i < 6; ++i) {
        a.rows[i].cell.verdict = Verdict::Refused;
        a.rows[i].cell.missing = {{"stencil_bits", "stencil", "M-TDFX: Napalm, \"only\""}};
    }
    a.rows[5].cell.missing = {{"alpha", "destination alpha beside depth", "MAME"}};
    AdviceRow& chosen = a.rows[1];
    chosen.proof = "volumes nest up to 1 deep, 2 can be counted";
    chosen.minimal.plan.windows = {{.all = {60, 40, 183, 122}, .volumes = {{60, 40, 90, 80}, {}}}};
    for (Pass& pass : chosen.minimal.plan.passes) {
        if (pass.kind == PassKind::Volume) pass.extent = Extent::Volumes;
        chosen.chipTerms.push_back(pass.kind == PassKind::Volume ? "grDepthMask(0)" : "");
    }
    chosen.minimal.notes = {
        {Effect::NearCaps, 0, false, false, "nearest volume is 1.21 units from the near rectangle"}};
    return ranked(a);
}

Json jsonOf(const Advice& a) {
    const Json json = Json::parse(showAdvice(a, Format::Json));
    EXPECT_EQ(json.size(), 1u);
    return json[0];
}

/// On which no table is broken.
Page widePage() {
    Page page;
    page.width = 160;
    return page;
}

TEST(AdviceText, ListsWhatIsDrawnCheapestFirst) {
    const std::string text = showAdvice(advice(), widePage());
    EXPECT_THAT(text, HasSubstr("boxes on voodoo2 at 320x240, frame 3\n\n"));
    EXPECT_THAT(
        text,
        HasSubstr(
            "\nscreen-parity     WRONG 902      2      1       2          0     60        700      0.50   "
            "  parity of overlapping volumes and 1 more cause\n"
            "roettger-screen*  exact, proved  2      4       3          0     60        1000     0.50\n"
            "screen-zfail      exact "))
        << text;
    EXPECT_THAT(text, Not(HasSubstr("\nheidmann  ")));
}

TEST(AdviceText, NamesWhatIsRefusedForTheSameWantInOneLine) {
    EXPECT_THAT(showAdvice(advice(), Format::Text),
                HasSubstr("Refused for want of\n"
                          "  heidmann, carmack: stencil [M-TDFX: Napalm, \"only\"]\n"
                          "  roettger-alpha: destination alpha beside depth [MAME]\n"));
}

TEST(AdviceText, SaysWhatTheNextCheaperMethodGetsWrongAndWhy) {
    const std::string text = showAdvice(advice(), Format::Text);
    EXPECT_THAT(text,
                AllOf(HasSubstr("\nroettger-screen is the cheapest that is proved exact: it touches 1000 "
                                "pixels, 0.50 of what its"),
                      HasSubstr("\nProved: volumes nest up to 1 deep, 2 can be counted.\n"),
                      HasSubstr("\nThe next cheaper, screen-parity, would touch 300 pixels less and get 902 "
                                "of 76800 pixels wrong:\n"
                                "parity of overlapping volumes 900, mask clamps 2.\n")))
        << text;
}

/// By the model what touches most is the cheapest here.
TEST(AdviceText, RanksAndTellsTheModelsTimeWhereThereIsOne) {
    Advice a = advice();
    a.rates = {"fill 90 Mpixel/s [IXBT]"};
    const auto take = [&](const char* method, double ms) {
        for (AdviceRow& r : a.rows)
            if (r.method == method) r.cost.passes = {{.fillMs = ms}};
    };
    take("screen-zfail", 0.5), take("roettger-screen", 1.25), take("screen-parity", 0.75);
    a = ranked(a);
    const std::string text = showAdvice(a, widePage());
    EXPECT_LT(text.find("\nscreen-zfail"), text.find("\nscreen-parity"));
    EXPECT_THAT(text, AllOf(HasSubstr("of full  ms    limit  why"), HasSubstr("0.50     1.25  fill"),
                            HasSubstr("at least 1.25 ms, limited by fill (fill 90"),
                            HasSubstr("nothing proves it: screen-zfail (0.50 ms)."),
                            HasSubstr("screen-parity, would take 0.50 ms less and get 902")))
        << text;
    const Json json = jsonOf(a);
    EXPECT_EQ(json["methods"][0]["model"]["ms"], 0.5);
    EXPECT_EQ(json["rates"], Json::array({"fill 90 Mpixel/s [IXBT]"}));
    EXPECT_THAT(showAdvice(a, Format::Csv),
                AllOf(HasSubstr(",model_ms,model_limit\r\n"), HasSubstr(",1.25,fill\r\n")));
    EXPECT_TRUE(jsonOf(advice())["methods"][0]["model"].is_null());
}

TEST(AdviceText, SaysSoWhereNothingIsCheaperOrProved) {
    Advice a = advice();
    a.rows.erase(a.rows.begin());
    a.rows[0].proof.clear();
    const std::string text = showAdvice(ranked(a), Format::Text);
    EXPECT_THAT(text, AllOf(HasSubstr("\nNothing that voodoo2 can draw is cheaper.\n"),
                            HasSubstr("\nNothing proves it: it was drawn"),
                            HasSubstr("cheapest that is exact:"), Not(HasSubstr("Proved:"))));
}

/// What is proved is chosen before what was only drawn.
TEST(AdviceText, NamesCheaperMethodsThatAreExactButNotProved) {
    Advice a = advice();
    a.rows[2].proof = a.rows[1].proof, a.rows[1].proof.clear();
    std::string text = showAdvice(ranked(a), Format::Text);
    EXPECT_THAT(text, AllOf(HasSubstr("\nscreen-zfail is the cheapest that is proved exact:"),
                            HasSubstr("\nCheaper and exact in this frame, though nothing proves it: "
                                      "roettger-screen (1000 pixels).\n"),
                            HasSubstr("\nThe next cheaper, screen-parity, would touch 1800 pixels less")))
        << text;
    EXPECT_EQ(jsonOf(ranked(a))["cheaper_unproved"], Json::array({"roettger-screen"}));
    a.rows.erase(a.rows.begin());
    text = showAdvice(ranked(a), Format::Text);
    EXPECT_THAT(text, HasSubstr("\nNothing that is cheaper is wrong here.\n"));
}

TEST(AdviceText, SaysWhatTheChosenMethodIsDrawnAs) {
    Advice a = advice();
    EXPECT_THAT(showAdvice(a, Format::Text), Not(HasSubstr("drawn as")));
    a.rows[*a.chosen].minimal.axes = findMethod("screen-zfail")->axes;
    EXPECT_THAT(showAdvice(a, Format::Text), HasSubstr("\nIt is drawn as screen-zfail.\n"));
}

TEST(AdviceText, GivesTheChosenPlansOmissionsAndCalls) {
    const std::string text = showAdvice(advice(), Format::Text);
    EXPECT_THAT(text,
                HasSubstr("\nLeft out\n  near-caps  nearest volume is 1.21 units from the near rectangle\n"));
    EXPECT_THAT(text, HasSubstr("\nIts passes as OpenGL calls\n\n/* State is"));
    EXPECT_THAT(text, HasSubstr("/* pass 3: front faces of volume 0: double */\n"
                                "/* voodoo2: grDepthMask(0) */\n"
                                "glEnable(GL_SCISSOR_TEST);\n"
                                "glScissor(60, 40, 90, 80);\n"));
}

TEST(AdviceText, SaysWhichMethodIsLeastWrongWhereNoneIsExact) {
    Advice a = advice();
    for (AdviceRow& r : a.rows)
        if (r.cell.verdict == Verdict::Exact)
            r.cell.verdict = Verdict::Edge, r.cell.wrongEdge = 12, r.cell.causes = {{"mask clamps", 12}};
    const std::string text = showAdvice(ranked(a), Format::Text);
    EXPECT_THAT(text,
                HasSubstr("\nNo method is exact on voodoo2 in this frame.\n"
                          "The least wrong is roettger-screen: 12 of 76800 pixels wrong: mask clamps 12.\n"));
    EXPECT_THAT(text, Not(HasSubstr("OpenGL calls")));
}

TEST(AdviceText, SaysSoWhereNothingCanBeDrawn) {
    Advice a = advice();
    a.rows.erase(a.rows.begin(), a.rows.begin() + 3);
    a.rows[0].cell.verdict = Verdict::Failed;
    a.rows[0].cell.error = "crashed: signal 11";
    const std::string text = showAdvice(ranked(a), Format::Text);
    EXPECT_THAT(text, HasSubstr("\nvoodoo2 can draw none of these methods.\n"));
    EXPECT_THAT(text, HasSubstr("\nFailed\n  heidmann: crashed: signal 11\n"));
    EXPECT_THAT(text, Not(HasSubstr("verdict"))) << "no table without rows";
}

TEST(AdviceText, SaysWhoseArithmeticItIs) {
    Advice a = advice();
    a.fidelity = "chip";
    EXPECT_THAT(showAdvice(a, Format::Text), HasSubstr(", frame 3, with the chip's own arithmetic\n"));
}

TEST(AdviceJson, HoldsEveryMethodWithItsCellCostAndNotes) {
    const Json json = jsonOf(advice());
    EXPECT_EQ(json["profile"], "voodoo2");
    EXPECT_EQ(json["scene"], "boxes");
    EXPECT_EQ(json["frame"], 3);
    EXPECT_EQ(json["chosen"], "roettger-screen");
    ASSERT_EQ(json["methods"].size(), 6u);
    const Json &wrong = json["methods"][0], &chosen = json["methods"][1];
    EXPECT_EQ(wrong["method"], "screen-parity");
    EXPECT_EQ(wrong["verdict"], "wrong");
    EXPECT_EQ(wrong["causes"]["parity of overlapping volumes"], 900);
    EXPECT_EQ(wrong["chosen"], false);
    EXPECT_EQ(chosen["chosen"], true);
    EXPECT_EQ(chosen["proof"], "volumes nest up to 1 deep, 2 can be counted");
    EXPECT_EQ(chosen["planned_passes"], (Json{{"scene", 2}, {"volume", 4}, {"rectangle", 3}, {"copy", 0}}));
    EXPECT_EQ(chosen["windows"][0], (Json{{"x", 60}, {"y", 40}, {"width", 183}, {"height", 122}}));
    EXPECT_EQ(chosen["touched"]["total"], 1000);
    EXPECT_EQ(chosen["touched"]["volume"], 900);
    EXPECT_EQ(chosen["drawn_vertices"], 60);
    EXPECT_EQ(chosen["full"]["touched"]["total"], 2000);
    EXPECT_EQ(chosen["full"]["drawn_vertices"], 240);
    EXPECT_EQ(chosen["effects"][0]["effect"], "near-caps");
    EXPECT_EQ(json["methods"][3]["missing"][0]["source"], "M-TDFX: Napalm, \"only\"");
    const Json cell = toJson(advice().rows[1].cell);
    for (const auto& [key, value] : cell.items()) EXPECT_TRUE(chosen.contains(key)) << key;
}

TEST(AdviceJson, HoldsTheNextCheaperAndTheChosenPlan) {
    const Json json = jsonOf(advice());
    EXPECT_EQ(json["next_cheaper"]["method"], "screen-parity");
    EXPECT_EQ(json["next_cheaper"]["wrong"], 902);
    EXPECT_EQ(json["next_cheaper"]["causes"].begin().key(), "parity of overlapping volumes") << "most first";
    const Json& pass = json["plan"]["passes"][2];
    EXPECT_EQ(pass["kind"], "volume");
    EXPECT_EQ(pass["chip_terms"], "grDepthMask(0)");
    EXPECT_EQ(pass["scissor"]["width"], 90);
    EXPECT_THAT(pass["reason"].get<std::string>(), HasSubstr("90x80 at 60,40"));
    EXPECT_THAT(pass["gl"].get<std::string>(), HasSubstr("glScissor(60, 40, 90, 80);\n"));
    EXPECT_EQ(json["plan"]["beyond_opengl_1_1"], Json::array());
    EXPECT_THAT(json["plan"]["gl_setup"].get<std::string>(), HasSubstr("glDisable(GL_DITHER);\n"));
}

TEST(AdviceJson, IsNullWhereThereIsNothing) {
    Advice a = advice();
    a.rows.erase(a.rows.begin(), a.rows.begin() + 3);
    const Json json = jsonOf(ranked(a));
    for (const char* key : {"chosen", "next_cheaper", "least_wrong", "plan"}) {
        ASSERT_TRUE(json.contains(key)) << key;
        EXPECT_TRUE(json[key].is_null()) << key;
    }
    EXPECT_EQ(jsonOf({})["methods"], Json::array());
}

TEST(AdviceCsv, IsALineForEachMethodUnderAHead) {
    Advice a = advice();
    a.scene = "models/a, \"b\".ply";
    std::istringstream stream(showAdvice(a, Format::Csv));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 7u);
    EXPECT_THAT(
        lines[0],
        HasSubstr("profile,scene,width,height,frame,fidelity,device,method,drawn_as,chosen,verdict,"));
    EXPECT_EQ(
        lines[2],
        "voodoo2,\"models/a, \"\"b\"\".ply\",320,240,3,gl,osmesa,roettger-screen,roettger-screen,true,exact,"
        "\"volumes nest up to 1 deep, 2 can be counted\",,,0,0,2,4,3,0,60,0,100,900,0,0,1000,240,2000,,\r");
    EXPECT_EQ(
        lines[1].substr(lines[1].find("false,wrong")),
        "false,wrong,,,parity of overlapping volumes 900; mask clamps 2,2,900,2,1,2,0,60,0,100,600,0,0,700,"
        "240,1400,,\r");
}

}  // namespace advice_report_test
}  // namespace gnomon
