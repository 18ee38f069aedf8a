// The chips as text, JSON and CSV.

#include "report/listings.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon {
namespace {

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

TEST(ListProfiles, ShowsTheBlendUnitAndItsEvidence) {
    const std::string line = lineWith(listProfiles({measured()}, Format::Text), "Microsoft");
    EXPECT_THAT(line, HasSubstr("  add sub rev wrap logic  4x2048    any      nv2a +1     recorded"));
}

TEST(ListProfiles, MarksWhatIsAbsent) {
    Profile bare;
    bare.id = "bare", bare.title = "Bare";
    bare.colourFormats = {{"565", 5, 6, 5, 0}};
    const std::string line = lineWith(listProfiles({bare}, Format::Text), "Bare");
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

}  // namespace
}  // namespace gnomon
