// Plans as text, JSON and CSV: OpenGL's terms, and the chip's own beside them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/listings.h"

namespace gnomon {
namespace plan_listing_test {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

/// A clear, a volume pass that the chip has words for, a copy.
PlanSheet sheet() {
    PlanSheet s{.method = "m", .shade = "black", .profile = "ps2", .scene = "boxes"};
    s.plan.width = 320, s.plan.height = 240;
    s.plan.passes = {{.kind = PassKind::Clear, .label = "starts"},
                     {.kind = PassKind::Volume, .label = "counts"},
                     {.kind = PassKind::Copy, .label = "copies", .texture = MaskTexture::Rgb}};
    s.chipTerms = {"", "COLCLAMP=0", ""};
    return s;
}

TEST(PlanListing, PutsTheChipsTermsUnderOpenGLsState) {
    const std::string text = showPlans({sheet()}, Format::Text);
    const std::size_t state = text.find("colour 1, write RGB"), terms = text.find("ps2: COLCLAMP=0");
    ASSERT_NE(state, std::string::npos) << text;
    ASSERT_NE(terms, std::string::npos) << text;
    EXPECT_EQ(text.find('\n', state) + 1 + (state - text.rfind('\n', state) - 1), terms)
        << "the next line, in the same column\n"
        << text;
    EXPECT_EQ(text.find("ps2:", terms + 1), std::string::npos) << "passes without terms have no such line";
}

TEST(PlanListing, CountsOneOfAKindInTheSingular) {
    PlanSheet s = sheet();
    EXPECT_THAT(showPlans({s}, Format::Text),
                HasSubstr("\n0 scene passes, 1 volume pass, 0 rectangles, 1 copy\n"));
    s.plan.passes = {{.kind = PassKind::Scene}, {.kind = PassKind::Rectangle}};
    EXPECT_THAT(showPlans({s}, Format::Text),
                HasSubstr("\n1 scene pass, 0 volume passes, 1 rectangle, 0 copies\n"));
}

TEST(PlanListing, GivesTheChipsTermsOfEachPassInJsonAndCsv) {
    const Json json = Json::parse(showPlans({sheet()}, Format::Json));
    EXPECT_EQ(json[0]["passes"][0]["chip_terms"], "");
    EXPECT_EQ(json[0]["passes"][1]["chip_terms"], "COLCLAMP=0");
    const std::string csv = showPlans({sheet()}, Format::Csv);
    EXPECT_THAT(csv, HasSubstr("what,state,chip_terms\r\n"));
    EXPECT_THAT(csv, HasSubstr(",COLCLAMP=0\r\n"));
}

TEST(PlanListing, SaysNothingOfAChipWithoutTerms) {
    PlanSheet s = sheet();
    s.chipTerms.clear();
    const std::string text = showPlans({s}, Format::Text);
    EXPECT_EQ(text.find("ps2:", text.find('\n')), std::string::npos) << text;
    EXPECT_EQ(Json::parse(showPlans({s}, Format::Json))[0]["passes"][1]["chip_terms"], "");
}

}  // namespace plan_listing_test
}  // namespace gnomon
