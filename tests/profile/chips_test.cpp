// The profiles that come with gnomon: that they load, that their facts have sources, and the facts that
// contradict the paper or common belief.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include "profile/profile.h"
#include "profile/words.h"
#include "shipped.h"

namespace gnomon {
namespace chips_test {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::SizeIs;
using testing::UnorderedElementsAre;
using testing::UnorderedElementsAreArray;
using enum BlendFactor;

bool isColour(BlendFactor factor) {
    return factor == SrcColor || factor == OneMinusSrcColor || factor == DstColor ||
           factor == OneMinusDstColor || factor == ConstantColor || factor == OneMinusConstantColor;
}

TEST(Chips, AreThoseOfThePlan) {
    EXPECT_THAT(profileIds(kFolder), IsSupersetOf({"banshee",    "dreamcast",  "ds",
                                                   "elan",       "g200",       "g400",
                                                   "g400-565",   "gamecube",   "gamecube-888",
                                                   "geforce256", "geforce2mx", "geforce2mx-565",
                                                   "i740",       "ideal",      "n64",
                                                   "n64-8888",   "o2",         "ps1",
                                                   "ps2",        "ps2-5551",   "psp",
                                                   "psp-4444",   "psp-5551",   "psp-565",
                                                   "rage128",    "ragepro",    "realityengine",
                                                   "riva128",    "tnt",        "tnt-565",
                                                   "tnt2",       "verite",     "virge",
                                                   "virge-888",  "voodoo1",    "voodoo2",
                                                   "voodoo3",    "vsa100-16",  "vsa100-32",
                                                   "xbox",       "xbox-565"}));
}

TEST(Chips, HaveTitlesOfTheirOwn) {
    std::set<std::string> titles;
    for (const std::string& id : profileIds(kFolder)) EXPECT_TRUE(titles.insert(chip(id).title).second) << id;
}

class EachChip : public testing::TestWithParam<std::string> {};

TEST_P(EachChip, LoadsUnderItsId) {
    const Profile profile = chip(GetParam());
    EXPECT_EQ(profile.id, GetParam());
    EXPECT_THAT(profile.id, testing::MatchesRegex("[a-z0-9-]+"));
    EXPECT_FALSE(profile.title.empty());
    EXPECT_FALSE(profile.facts.empty());
}

// Two or three lines that say what is particular about the chip; then the title.
TEST_P(EachChip, BeginsWithWhatIsParticular) {
    std::ifstream file(kFolder / (GetParam() + ".toml"));
    int comments = 0;
    std::string line;
    while (std::getline(file, line) && line.starts_with("# ")) ++comments;
    EXPECT_GE(comments, 2);
    EXPECT_LE(comments, 4);
    EXPECT_EQ(line, "");
}

/// The parts of a fact's source that name one of the list, without what "also" says.
std::vector<std::string> partsOf(const Profile::Fact& fact) {
    std::string rest = fact.source.substr(0, fact.source.find("; also "));
    if (rest.starts_with("derived: ")) rest.erase(0, std::string("derived: ").size());
    std::vector<std::string> parts;
    while (!rest.empty()) {
        const auto end = rest.find("; ");
        parts.push_back(rest.substr(0, end));
        rest = end == std::string::npos ? "" : rest.substr(end + 2);
    }
    return parts;
}

// That each part is in the list is loadProfile()'s to see; here that no source is there for show, and that a
// fact without one says so.
TEST_P(EachChip, NamesASourceForEachFactAndAFactForEachSource) {
    const Profile profile = chip(GetParam());
    std::set<std::string> used;
    for (const Profile::Fact& fact : profile.facts) {
        const bool unsourced = fact.source.starts_with("unsourced");
        EXPECT_TRUE(!unsourced || fact.grade == Evidence::Guess) << fact.key;
        for (const std::string& part : partsOf(fact))
            for (const Profile::Source& source : profile.sources)
                if (part.starts_with(source.key)) used.insert(source.key);
        for (const Profile::Source& source : profile.sources)  // what "also" says
            if (fact.source.find("; also ") != std::string::npos &&
                fact.source.find(source.key, fact.source.find("; also ")) != std::string::npos)
                used.insert(source.key);
    }
    for (const Profile::Source& source : profile.sources) {
        EXPECT_FALSE(source.document.empty()) << source.key;
        EXPECT_TRUE(used.contains(source.key)) << source.key;
    }
}

// Arithmetic that nobody has measured must not look as if somebody had: only the recorded chip is.
TEST_P(EachChip, GradesTheEvidenceForItsBlendUnit) {
    const Profile profile = chip(GetParam());
    ASSERT_FALSE(profile.blendUnits.empty());
    const bool recorded = profile.id.starts_with("xbox");
    EXPECT_EQ(profile.gradeOf("blend_units") == Evidence::Recorded, recorded);
    const bool envelope = std::find(profile.blendUnits.begin(), profile.blendUnits.end(),
                                    BlendUnit::ProductsFloor) != profile.blendUnits.end();
    EXPECT_TRUE(!envelope || profile.gradeOf("blend_units") == Evidence::Guess);
}

// What has more than one format is a profile each: the first is the one that is drawn into.
TEST_P(EachChip, HasTheFormatOfItsId) {
    const Profile profile = chip(GetParam());
    const auto dash = profile.id.find('-');
    if (dash == std::string::npos || profile.id.starts_with("vsa100")) return;
    EXPECT_EQ(profile.colourFormats.front().name, profile.id.substr(dash + 1));
}

// A dithered store is 16-bit business.
TEST_P(EachChip, DithersOnlyBelowEightBits) {
    const Profile profile = chip(GetParam());
    EXPECT_TRUE(profile.colourFormats.front().red < 8 || profile.ditherModes.empty());
}

std::string testName(const testing::TestParamInfo<std::string>& test) {
    std::string id = test.param;
    std::replace(id.begin(), id.end(), '-', '_');
    return id;
}

INSTANTIATE_TEST_SUITE_P(All, EachChip, testing::ValuesIn(profileIds(kFolder)), testName);

TEST(Ideal, LacksNothing) {
    const Profile ideal = chip("ideal");
    EXPECT_THAT(ideal.sourceFactors, SizeIs(names<BlendFactor>().size()));
    EXPECT_EQ(ideal.destinationFactors, ideal.sourceFactors);
    EXPECT_EQ(ideal.alphaSourceFactors, ideal.sourceFactors);
    EXPECT_EQ(ideal.alphaDestinationFactors, ideal.sourceFactors);
    EXPECT_THAT(ideal.blendEquations, SizeIs(6)) << "all but the signed ones of NV2A";
    EXPECT_THAT(ideal.depthFunctions, SizeIs(names<Compare>().size()));
    EXPECT_TRUE(ideal.stencilWrap && ideal.twoSidedStencil && ideal.separateAlphaFactors && ideal.shaders);
    EXPECT_EQ(ideal.maxWidth, 0);
    EXPECT_EQ(ideal.frameBytes, 0);
    for (const Profile::Fact& fact : ideal.facts)
        EXPECT_EQ(fact.source, "no limits: by definition") << fact.key;
}

TEST(Chips, SayWhoseArithmeticIsGuessed) {
    const auto grade = [](const char* id) { return chip(id).gradeOf("blend_units"); };
    for (const char* id : {"voodoo1", "dreamcast", "n64", "gamecube", "psp", "riva128", "virge", "ds", "ps1"})
        EXPECT_EQ(grade(id), Evidence::Emulator) << id;
    EXPECT_EQ(grade("ps2"), Evidence::Document);
    EXPECT_EQ(grade("xbox"), Evidence::Recorded);
    for (const char* id : {"tnt", "g200", "ragepro", "rage128", "i740", "verite", "elan", "vsa100-16"})
        EXPECT_EQ(grade(id), Evidence::Guess) << id;
    EXPECT_EQ(Profile{}.blendUnit(), BlendUnit::IdealRound);
}

// Its successor's recorded arithmetic, not its own: a guess, between two bounds.
TEST(GeForce, RoundsAsTheXboxByGuess) {
    for (const char* id : {"geforce256", "geforce2mx", "geforce2mx-565"}) {
        EXPECT_THAT(chip(id).blendUnits,
                    ElementsAre(BlendUnit::Nv2a, BlendUnit::ProductsRound, BlendUnit::ProductsFloor))
            << id;
        EXPECT_EQ(chip(id).gradeOf("blend_units"), Evidence::Guess) << id;
    }
}

TEST(Voodoo, DithersWithSubtractionUnlessTold) {
    for (const char* id : {"voodoo1", "voodoo2", "banshee", "voodoo3"}) {
        const auto modes = chip(id).ditherModes;
        EXPECT_EQ(modes.front(), DitherMode::Matrix4x4Subtract) << id;
        EXPECT_THAT(modes, Contains(DitherMode::Off));
        EXPECT_THAT(chip(id).blendUnits, UnorderedElementsAre(BlendUnit::VoodooMame, BlendUnit::Voodoo86Box));
    }
}

class EachVoodoo : public testing::TestWithParam<std::string> {};

// The paper's faster variant multiplies destination alpha while it tests depth: twice impossible here.
TEST_P(EachVoodoo, CantKeepTheMaskInAlpha) {
    const Profile voodoo = chip(GetParam());
    EXPECT_TRUE(voodoo.alphaExcludesDepth);
    EXPECT_THAT(voodoo.alphaSourceFactors, ElementsAre(Zero, One));
    EXPECT_THAT(voodoo.alphaDestinationFactors, ElementsAre(Zero, One));
}

TEST_P(EachVoodoo, DoublesHalvesAndInvertsColours) {
    const Profile voodoo = chip(GetParam());
    EXPECT_TRUE(voodoo.allowsBlend(DstColor, One));
    EXPECT_TRUE(voodoo.allowsBlend(DstColor, Zero));
    EXPECT_TRUE(voodoo.allowsBlend(Zero, SrcColor));
    EXPECT_TRUE(voodoo.allowsBlend(OneMinusDstColor, Zero));
    EXPECT_FALSE(voodoo.allowsBlend(SrcColor, Zero));
    EXPECT_FALSE(voodoo.allowsBlend(Zero, DstColor));
    EXPECT_THAT(voodoo.blendEquations, ElementsAre(BlendEquation::Add));
}

TEST_P(EachVoodoo, HasSixteenBitsOfEverythingAndNoStencil) {
    const Profile voodoo = chip(GetParam());
    ASSERT_THAT(voodoo.colourFormats, SizeIs(1));
    EXPECT_EQ(voodoo.colourFormats[0].name, "565");
    EXPECT_THAT(voodoo.depthBits, ElementsAre(16));
    EXPECT_THAT(voodoo.depthFunctions, SizeIs(8));
    EXPECT_EQ(voodoo.stencilBits, 0);
    EXPECT_EQ(voodoo.writeMask, WriteMask::Group);
    EXPECT_EQ(voodoo.maxTextureSize, 256);
    EXPECT_EQ(voodoo.maxTextureAspect, 8);
}

TEST_P(EachVoodoo, WritesDepthAsZOrAsFloatingW) {
    EXPECT_THAT(chip(GetParam()).depthEncodings, ElementsAre(DepthEncoding::Linear, DepthEncoding::VoodooW));
}

INSTANTIATE_TEST_SUITE_P(All, EachVoodoo, testing::Values("voodoo1", "voodoo2", "banshee", "voodoo3"),
                         testName);

// Two colour buffers and one auxiliary buffer of 16 bits at the largest size. Voodoo 3 is left out: there the
// memory is the limit, not the table of modes.
TEST(Voodoo, HoldsItsLargestFrame) {
    for (const char* id : {"voodoo1", "voodoo2"}) {
        const Profile voodoo = chip(id);
        EXPECT_LE(std::int64_t{voodoo.maxWidth} * voodoo.maxHeight * 2 * 3, voodoo.frameBytes) << id;
    }
}

TEST(Voodoo, CullsByTheChipOnlyFromTheSecondOn) {
    EXPECT_FALSE(chip("voodoo1").culling);
    EXPECT_TRUE(chip("voodoo2").culling);
    EXPECT_TRUE(chip("voodoo3").culling);
}

TEST(Voodoo, TellsThatSourcesDisagreeOnItsRate) {
    EXPECT_EQ(chip("voodoo1").sourceOf("megapixels_per_second"), "GPUTECH; FSANG; also IXBT says 45");
}

/// What one input of the chip is multiplied by: linear * C + constant.
struct Weight {
    int linear = 0, constant = 0;
};

/// OpenGL's factor for @p weight of an input if C is @p value; none if OpenGL has no such factor.
std::optional<BlendFactor> factorFor(Weight weight, BlendFactor value, BlendFactor oneMinusValue) {
    if (weight.linear == 0 && weight.constant == 0) return Zero;
    if (weight.linear == 0 && weight.constant == 1) return One;
    if (weight.linear == 1 && weight.constant == 0) return value;
    if (weight.linear == -1 && weight.constant == 1) return oneMinusValue;
    return {};
}

/// All pairs of OpenGL's factors, with equation add, that (A - B) * C + D is for A, B, D of {Cs, Cd, 0} and C
/// of {As, Ad, FIX}. FIX is the constant alpha, or 1 at 0x80. PS2TEK, AlphaBlending.
std::set<BlendPair> pairsOfGraphicsSynthesizer() {
    enum Input { Cs, Cd, Nothing };
    constexpr std::array kInputs{Cs, Cd, Nothing};
    constexpr std::array kValues{std::pair{SrcAlpha, OneMinusSrcAlpha}, std::pair{DstAlpha, OneMinusDstAlpha},
                                 std::pair{ConstantAlpha, OneMinusConstantAlpha}, std::pair{One, Zero}};
    std::set<BlendPair> pairs;
    for (const Input a : kInputs)
        for (const Input b : kInputs)
            for (const Input d : kInputs)
                for (const auto& values : kValues) {
                    // Named anew: clang 14 can't capture a structured binding.
                    const BlendFactor value = values.first, oneMinusValue = values.second;
                    const auto weightOf = [&](Input input) {
                        Weight weight{(a == input) - (b == input), d == input};
                        if (value == One) weight = {0, weight.linear + weight.constant};
                        return weight;
                    };
                    const auto source = factorFor(weightOf(Cs), value, oneMinusValue);
                    const auto destination = factorFor(weightOf(Cd), value, oneMinusValue);
                    if (source && destination) pairs.insert({*source, *destination});
                }
    return pairs;
}

TEST(Ps2, HasExactlyThePairsOfItsBlendFormula) {
    const auto pairs = pairsOfGraphicsSynthesizer();
    EXPECT_THAT(pairs, SizeIs(4u /* of zero and one */ + 3u /* As, Ad, FIX */ * 8u));
    EXPECT_THAT(chip("ps2").blendPairs, UnorderedElementsAreArray(pairs));
    EXPECT_TRUE(chip("ps2").sourceFactors.empty());
    EXPECT_TRUE(chip("ps2").destinationFactors.empty());
}

TEST(Ps2, MultipliesColoursOnlyByAConstant) {
    const Profile ps2 = chip("ps2");
    for (const auto& [source, destination] : ps2.blendPairs)
        EXPECT_FALSE(isColour(source) || isColour(destination)) << name(source) << " " << name(destination);
    EXPECT_FALSE(ps2.allowsBlend(DstColor, One));
    EXPECT_TRUE(ps2.allowsBlendWithConstantSource(DstColor, One));
}

/// What OpenGL multiplies by for a colour factor; colours are 0..1.
double valueOf(BlendFactor factor, double source, double destination) {
    switch (factor) {
        case Zero:
            return 0;
        case One:
            return 1;
        case SrcColor:
            return source;
        case DstColor:
            return destination;
        case OneMinusDstColor:
            return 1 - destination;
        default:
            ADD_FAILURE() << name(factor);
            return 0;
    }
}

/// Whether one setting of ((A - B) * fix >> 7) + D, with Cs = @p cs, gives the sum of OpenGL for the source
/// colour
/// @p k and every stored value, but for the shift, which loses less than 1.
bool realises(const BlendPair& pair, double k, int cs, int fix) {
    const auto matches = [&](int a, int b, int d) {
        for (int cd = 0; cd <= 255; ++cd) {
            const std::array inputs{cs, cd, 0};
            const int chipSum = ((inputs[a] - inputs[b]) * fix >> 7) + inputs[d];
            const double openGl =
                255 * k * valueOf(pair.first, k, cd / 255.0) + cd * valueOf(pair.second, k, cd / 255.0);
            if (std::abs(chipSum - openGl) >= 1) return false;
        }
        return true;
    };
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            for (int d = 0; d < 3; ++d)
                if (matches(a, b, d)) return true;
    return false;
}

// A draw with the constant source k sets the vertex colour to white and FIX to k. FIX = 0x80 is 1, so k is
// taken in steps of 1/128.
TEST(Ps2, RealisesItsConstantPairsForEveryConstant) {
    const Profile ps2 = chip("ps2");
    EXPECT_THAT(ps2.constantSourcePairs,
                UnorderedElementsAre(BlendPair{DstColor, One}, BlendPair{DstColor, Zero},
                                     BlendPair{Zero, SrcColor}, BlendPair{OneMinusDstColor, Zero}));
    for (const BlendPair& pair : ps2.constantSourcePairs)
        for (int fix = 0; fix <= 128; ++fix) {
            const double k = fix / 128.0;
            EXPECT_TRUE(realises(pair, k, 255, fix))
                << name(pair.first) << " " << name(pair.second) << " " << k;
        }
}

// The product of a colour with itself is beyond the formula even for a constant, so the search isn't idle.
TEST(Ps2, RealisesNoSquareOfTheFrame) {
    for (int fix = 0; fix <= 255; ++fix) EXPECT_FALSE(realises({Zero, DstColor}, 1, 255, fix)) << fix;
}

TEST(Ps2, TestsOnlyNearer) {
    EXPECT_THAT(chip("ps2").depthFunctions,
                UnorderedElementsAre(Compare::Never, Compare::Less, Compare::Lequal, Compare::Always));
}

TEST(Ps2, NeverBlendsAlphaButSamplesItsFrame) {
    const Profile ps2 = chip("ps2");
    EXPECT_EQ(ps2.alphaBits, 8);
    EXPECT_FALSE(ps2.alphaExcludesDepth);
    EXPECT_FALSE(ps2.blendWritesAlpha);
    EXPECT_EQ(ps2.frameTexture, FrameTexture::Direct);
    EXPECT_EQ(ps2.writeMask, WriteMask::Channel);
}

TEST(Tnt, RunsBothVariantsOfThePaperBesideAStencil) {
    const Profile tnt = chip("tnt");
    EXPECT_FALSE(tnt.alphaExcludesDepth);
    EXPECT_TRUE(tnt.allowsBlend(DstColor, One));
    EXPECT_THAT(tnt.alphaSourceFactors, Contains(DstAlpha));
    EXPECT_EQ(tnt.stencilBits, 8);
    EXPECT_TRUE(tnt.stencilWrap);
    EXPECT_FALSE(tnt.twoSidedStencil);
    EXPECT_FALSE(tnt.separateAlphaFactors);
    EXPECT_THAT(tnt.blendEquations, ElementsAre(BlendEquation::Add));
}

TEST(GeForce, CountsWithSignByReverseSubtract) {
    for (const char* id : {"geforce256", "geforce2mx", "xbox"}) {
        const Profile geforce = chip(id);
        EXPECT_TRUE(geforce.blendEquations.contains(BlendEquation::ReverseSubtract)) << id;
        EXPECT_THAT(geforce.blendEquations, SizeIs(std::string(id) == "xbox" ? 7 : 5)) << id;
        EXPECT_TRUE(geforce.allowsBlend(One, One)) << id;
        EXPECT_EQ(geforce.alphaSourceFactors, geforce.sourceFactors) << id;
        EXPECT_FALSE(geforce.separateAlphaFactors) << id;
    }
}

TEST(GeForce, HasLogicOperationsFromTheSecondOn) {
    EXPECT_FALSE(chip("geforce256").logicOps);
    EXPECT_TRUE(chip("geforce2mx").logicOps);
    EXPECT_TRUE(chip("xbox").logicOps);
}

TEST(Xbox, StandsOnRecordings) {
    for (const char* id : {"xbox", "xbox-565"}) {
        const Profile xbox = chip(id);
        EXPECT_THAT(xbox.blendUnits, ElementsAre(BlendUnit::Nv2a)) << id;
        for (const char* key : {"source_factors", "destination_factors", "blend_equations", "blend_units"})
            EXPECT_EQ(xbox.gradeOf(key), Evidence::Recorded) << id << " " << key;
    }
    EXPECT_EQ(chip("xbox").gradeOf("stencil_wrap"), Evidence::Recorded);
    EXPECT_TRUE(chip("xbox").stencilWrap);
    EXPECT_FALSE(chip("xbox").twoSidedStencil);
}

// Section 2.4: what Glide forces in 16 bits, a mask can't switch off.
TEST(Vsa100, AlwaysDithersIn16Bits) {
    EXPECT_THAT(chip("vsa100-16").ditherModes, ElementsAre(DitherMode::Matrix2x2Subtract));
    EXPECT_THAT(chip("vsa100-32").ditherModes, IsEmpty());
}

TEST(Vsa100, SubtractsBothWaysAndMasksEachChannel) {
    for (const char* id : {"vsa100-16", "vsa100-32"}) {
        EXPECT_THAT(chip(id).blendEquations,
                    ElementsAre(BlendEquation::Add, BlendEquation::Subtract, BlendEquation::ReverseSubtract))
            << id;
        EXPECT_EQ(chip(id).writeMask, WriteMask::Channel) << id;
        EXPECT_TRUE(chip(id).allowsBlend(SrcColor, DstColor))
            << id << ": the own colour, unlike its forerunners";
    }
    EXPECT_TRUE(chip("vsa100-16").alphaExcludesDepth);
    EXPECT_FALSE(chip("vsa100-32").alphaExcludesDepth);
    EXPECT_EQ(chip("vsa100-32").stencilBits, 8);
}

// COLCLAMP 0, and the signed difference.
TEST(Ps2, CountsByWrappingAndBySubtracting) {
    for (const char* id : {"ps2", "ps2-5551"})
        EXPECT_THAT(chip(id).blendEquations,
                    ElementsAre(BlendEquation::Add, BlendEquation::ReverseSubtract, BlendEquation::AddWrap))
            << id;
    EXPECT_EQ(chip("ps2-5551").alphaBits, 1);
}

// Section 2.6: one weight, its complement beside it, or nothing; and the plain sum.
TEST(Riva128, HalvesButCantDouble) {
    const Profile riva = chip("riva128");
    for (const BlendFactor weight : {SrcAlpha, DstColor}) {
        const BlendFactor complement = weight == SrcAlpha ? OneMinusSrcAlpha : OneMinusDstColor;
        EXPECT_TRUE(riva.allowsBlend(weight, complement) && riva.allowsBlend(weight, Zero) &&
                    riva.allowsBlend(Zero, complement));
        EXPECT_FALSE(riva.allowsBlend(weight, One));
        EXPECT_FALSE(riva.allowsBlend(complement, weight));
    }
    EXPECT_TRUE(riva.allowsBlend(One, One));
    EXPECT_TRUE(riva.allowsBlendWithConstantSource(DstColor, Zero));
    EXPECT_FALSE(riva.allowsBlendWithConstantSource(DstColor, One));
    EXPECT_THAT(riva.blendEquations, ElementsAre(BlendEquation::Add));
    EXPECT_EQ(riva.alphaBits, 0);
}

// Sections 2.15 and 2.21.
TEST(Chips, ThatBlendByAlphaOnlyCanHalveAndNothingElse) {
    for (const char* id : {"virge", "virge-888", "ds"}) {
        const Profile p = chip(id);
        EXPECT_THAT(p.blendPairs,
                    UnorderedElementsAre(BlendPair{One, Zero}, BlendPair{SrcAlpha, OneMinusSrcAlpha}))
            << id;
        EXPECT_TRUE(p.allowsBlendWithConstantSource(DstColor, Zero)) << id;
        EXPECT_FALSE(p.allowsBlendWithConstantSource(DstColor, One)) << id;
        EXPECT_FALSE(p.allowsBlendWithConstantSource(One, One)) << id;
    }
}

// Sections 2.17 and 2.18: no partial write masks, no usable alpha.
TEST(Chips, ThatWriteAllColoursOrNothing) {
    for (const char* id : {"ragepro", "i740"}) {
        EXPECT_EQ(chip(id).writeMask, WriteMask::Fixed) << id;
        EXPECT_EQ(chip(id).alphaBits, 0) << id;
        EXPECT_TRUE(chip(id).allowsBlend(DstColor, One) && chip(id).allowsBlend(DstColor, Zero)) << id;
    }
}

TEST(Rage128, SubtractsInTheWrongOrderForCounting) {
    EXPECT_THAT(chip("rage128").blendEquations, ElementsAre(BlendEquation::Add, BlendEquation::Subtract));
}

// The driver avoids the pair that the chip gets wrong.
TEST(Matrox, LacksOnePairAndOneDepthTest) {
    for (const char* id : {"g200", "g400"}) {
        EXPECT_TRUE(chip(id).allowsBlend(SrcAlphaSaturate, One)) << id;
        EXPECT_FALSE(chip(id).allowsBlend(SrcAlphaSaturate, Zero)) << id;
        EXPECT_THAT(chip(id).depthFunctions, SizeIs(7)) << id;
        EXPECT_FALSE(chip(id).depthFunctions.contains(Compare::Never)) << id;
    }
}

TEST(Sgi, CountsToFifteenOnTheElan) {
    EXPECT_EQ(chip("elan").stencilBits, 4);
    EXPECT_EQ(chip("o2").stencilBits, 8);
}

// 16-bit forms have neither alpha nor stencil beside their depth of 16 bits.
TEST(Chips, LoseAlphaAndStencilIn565) {
    for (const char* id : {"tnt-565", "geforce2mx-565", "xbox-565", "g400-565"}) {
        const Profile p = chip(id);
        EXPECT_EQ(p.alphaBits, 0) << id;
        EXPECT_EQ(p.stencilBits, 0) << id;
        EXPECT_EQ(p.depthBits.front(), 16) << id;
    }
}

}  // namespace chips_test
}  // namespace gnomon
