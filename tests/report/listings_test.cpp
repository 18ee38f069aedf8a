// The chips as text, JSON and CSV.

#include "report/listings.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon {
namespace listings_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

Profile measured() {
    Profile p;
    p.id = "xbox", p.title = "Microsoft Xbox", p.year = 2001;
    p.sources = {{"NV2A", Evidence::Recorded, "pictures of a console"}, {"XEMU", Evidence::Emulator, "nv2a"}};
    p.colourFormats = {{"8888", 8, 8, 8, 8}};
    p.alphaBits = 8, p.stencilBits = 8, p.textureUnits = 4, p.maxTextureSize = 2048;
    p.depth = true, p.depthBits = {24, 16};
    p.blendEquations = {BlendEquation::Add, BlendEquation::Subtract, BlendEquation::ReverseSubtract,
                        BlendEquation::AddWrap};
    p.logicOps = true;
    p.blendUnits = {BlendUnit::Nv2a, BlendUnit::ProductsFloor};
    p.facts = {{"alpha_bits", "8", "XEMU; also NV2A", Evidence::Emulator},
               {"blend_units", "nv2a, products_floor", "NV2A Blend_tests", Evidence::Recorded},
               {"culling", "true", "unsourced", Evidence::Guess}};
    return p;
}

std::string lineWith(const std::string& text, const std::string& words) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (line.find(words) != std::string::npos) return line;
    return "no line with " + words;
}

/// A page on which no table is broken.
Page widePage() {
    Page page;
    page.width = 400;
    return page;
}

TEST(ListProfiles, ShowsTheBlendUnitAndItsEvidence) {
    const std::string line = lineWith(listProfiles({measured()}, widePage()), "Microsoft");
    EXPECT_THAT(line, HasSubstr("  add sub rev wrap logic  4x2048    any      nv2a +1     recorded"));
}

TEST(ListProfiles, MarksWhatIsAbsent) {
    Profile bare;
    bare.id = "bare", bare.title = "Bare";
    bare.colourFormats = {{"565", 5, 6, 5, 0}};
    const std::string line = lineWith(listProfiles({bare}, widePage()), "Bare");
    EXPECT_EQ(
        line,
        "bare     Bare         565     -      -      -                   -         any      -           -");
}

TEST(ListProfiles, HasFullWordsInJsonAndCsv) {
    const Json json = Json::parse(listProfiles({measured()}, Format::Json));
    EXPECT_EQ(json[0]["equations"], "add subtract reverse_subtract add_wrap");
    EXPECT_EQ(json[0]["logic_ops"], "true");
    EXPECT_EQ(json[0]["blend_unit"], "nv2a");
    EXPECT_EQ(json[0]["evidence"], "recorded");
    EXPECT_THAT(listProfiles({measured()}, Format::Csv),
                AllOf(HasSubstr(",blend_unit,evidence\r\n"), HasSubstr(",nv2a,recorded\r\n")));
}

TEST(ShowProfile, HasAColumnForTheGradeOfEachFact) {
    const std::string text = showProfile(measured(), Format::Text);
    EXPECT_THAT(text, AllOf(HasSubstr("\nalpha_bits                emulator  8\n"),
                            HasSubstr("\nblend_units               recorded  nv2a, products_floor\n"),
                            HasSubstr("\nculling                   guess     true\n")));
    EXPECT_THAT(text, AllOf(HasSubstr("   [XEMU; also NV2A]\n"), HasSubstr("   [unsourced]\n")));
    EXPECT_THAT(text, HasSubstr("\n  NV2A [recorded]: pictures of a console\n"));
    EXPECT_THAT(text, Not(HasSubstr("ideal rounding")));
}

TEST(ShowProfile, HasTheGradesInJsonAndCsv) {
    const Json json = Json::parse(showProfile(measured(), Format::Json));
    EXPECT_EQ(json[0]["facts"][1]["grade"], "recorded");
    EXPECT_EQ(json[0]["facts"][2]["grade"], "guess");
    EXPECT_EQ(json[0]["sources"][1], (Json{{"key", "XEMU"}, {"grade", "emulator"}, {"document", "nv2a"}}));
    EXPECT_THAT(showProfile(measured(), Format::Csv), AllOf(HasSubstr("fact,value,source,grade\r\n"),
                                                            HasSubstr("culling,true,unsourced,guess\r\n")));
}

Scene hardScene() {
    Scene scene;
    scene.id = "hard/x", scene.title = "a title";
    scene.hard = HardCase{.family = "eyes", .what = "hard to see", .source = "a paper"};
    scene.hard->fails = {{.method = "heidmann", .cause = "eye inside a volume"}};
    scene.hard->exact = {{.method = "carmack", .options = {{"levels", "3"}}}};
    return scene;
}

TEST(ListScenes, PutsHardCasesUnderAHeadingOfTheirOwn) {
    Scene plain;
    plain.id = "plain", plain.title = "another";
    const std::string text = listScenes({plain, hardScene()}, Format::Text);
    EXPECT_THAT(lineWith(text, "plain"), HasSubstr("another"));
    EXPECT_THAT(lineWith(text, "hard/x"),
                AllOf(HasSubstr("eyes"), HasSubstr("hard to see"), Not(HasSubstr("a title"))));
    EXPECT_LT(text.find("plain"), text.find("hard case"));
    EXPECT_EQ(listScenes({plain}, Format::Text).find("hard case"), std::string::npos);
    EXPECT_THAT(listScenes({plain, hardScene()}, Format::Csv),
                HasSubstr("hard/x,0,0,0,0,a title,eyes,hard to see"));
}

TEST(ListScenes, ShowsThePromisesOfOneHardCaseAsCommands) {
    const std::string text = listScenes({hardScene()}, Format::Text);
    EXPECT_THAT(text, HasSubstr("source: a paper\n"));
    EXPECT_THAT(text, HasSubstr("\nmust be wrong\n  gnomon render hard/x --method heidmann --profile ideal\n"
                                "    eye inside a volume\n"));
    EXPECT_THAT(
        text,
        HasSubstr("\nmust be exact\n  gnomon render hard/x --method carmack --profile ideal --levels 3\n"));

    const Json json = Json::parse(listScenes({hardScene()}, Format::Json));
    EXPECT_EQ(json[0]["fails"][0]["cause"], "eye inside a volume");
    EXPECT_EQ(json[0]["exact"][0]["arguments"], "--method carmack --profile ideal --levels 3");
    EXPECT_FALSE(json[0]["exact"][0].contains("cause"));
}

}  // namespace listings_test
}  // namespace gnomon
