// The profiles that come with gnomon: that they load, that their facts have sources, and the facts that
// contradict the paper or common belief.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "profile/profile.h"
#include "profile/words.h"

namespace gnomon {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::SizeIs;
using testing::UnorderedElementsAre;
using testing::UnorderedElementsAreArray;
using enum BlendFactor;

const std::filesystem::path kFolder = std::filesystem::path(GNOMON_SOURCE) / "profiles";

Profile chip(const std::string& id) {
    return loadProfile(kFolder / (id + ".toml"));
}

bool isColour(BlendFactor factor) {
    return factor == SrcColor || factor == OneMinusSrcColor || factor == DstColor ||
           factor == OneMinusDstColor || factor == ConstantColor || factor == OneMinusConstantColor;
}

TEST(Chips, AreThoseOfThePlan) {
    EXPECT_THAT(profileIds(kFolder),
                IsSupersetOf({"geforce2mx", "ideal", "ps2", "tnt", "voodoo1", "voodoo2", "voodoo3"}));
}

class EachChip : public testing::TestWithParam<std::string> {};

TEST_P(EachChip, LoadsUnderItsId) {
    const Profile profile = chip(GetParam());
    EXPECT_EQ(profile.id, GetParam());
    EXPECT_FALSE(profile.title.empty());
    EXPECT_FALSE(profile.facts.empty());
}

// A source is "unsourced", "derived: ...", or begins with a key that the file's sources explain; several
// stand apart by "; ". The text after "; also " is free.
TEST_P(EachChip, ExplainsTheSourceOfEachFact) {
    const Profile profile = chip(GetParam());
    std::vector<std::string> keys{"unsourced", "derived", "no limits"};
    for (const std::string& source : profile.sources) {
        ASSERT_NE(source.find(": "), std::string::npos) << source;
        keys.push_back(source.substr(0, source.find(':')));
    }
    const auto known = [&](const std::string& part) {
        return std::any_of(keys.begin(), keys.end(), [&](const std::string& key) {
            return part == key || part.starts_with(key + " ") || part.starts_with(key + ":");
        });
    };
    for (const Profile::Fact& fact : profile.facts) {
        std::string rest = fact.source.substr(0, fact.source.find("; also "));
        while (!rest.empty()) {
            const auto end = rest.find("; ");
            EXPECT_TRUE(known(rest.substr(0, end))) << fact.key << ": " << rest.substr(0, end);
            rest = end == std::string::npos ? "" : rest.substr(end + 2);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, EachChip, testing::ValuesIn(profileIds(kFolder)),
                         [](const auto& test) { return test.param; });

TEST(Ideal, LacksNothing) {
    const Profile ideal = chip("ideal");
    EXPECT_THAT(ideal.sourceFactors, SizeIs(names<BlendFactor>().size()));
    EXPECT_EQ(ideal.destinationFactors, ideal.sourceFactors);
    EXPECT_EQ(ideal.alphaSourceFactors, ideal.sourceFactors);
    EXPECT_EQ(ideal.alphaDestinationFactors, ideal.sourceFactors);
    EXPECT_THAT(ideal.blendEquations, SizeIs(names<BlendEquation>().size()));
    EXPECT_THAT(ideal.depthFunctions, SizeIs(names<Compare>().size()));
    EXPECT_TRUE(ideal.stencilWrap && ideal.twoSidedStencil && ideal.separateAlphaFactors && ideal.shaders);
    EXPECT_EQ(ideal.maxWidth, 0);
    EXPECT_EQ(ideal.frameBytes, 0);
    for (const Profile::Fact& fact : ideal.facts)
        EXPECT_EQ(fact.source, "no limits: by definition") << fact.key;
}

// Arithmetic that nobody has measured must not look as if somebody had.
TEST_P(EachChip, GradesTheEvidenceForItsBlendUnit) {
    const Profile profile = chip(GetParam());
    ASSERT_FALSE(profile.blendUnits.empty());
    for (const Profile::Fact& fact : profile.facts)
        if (fact.key == "blend_units" && profile.id != "ideal") {
            EXPECT_TRUE(fact.grade.has_value());
        }
}

TEST(Chips, SayWhoseArithmeticIsGuessed) {
    const auto grade = [](const char* id) {
        const Profile profile = chip(id);
        for (const Profile::Fact& fact : profile.facts)
            if (fact.key == "blend_units") return fact.grade;
        return std::optional<Evidence>();
    };
    EXPECT_EQ(grade("voodoo1"), Evidence::Emulator);
    EXPECT_EQ(grade("ps2"), Evidence::Document);
    EXPECT_EQ(grade("tnt"), Evidence::Guess);
    EXPECT_EQ(grade("geforce2mx"), Evidence::Guess);
    EXPECT_EQ(chip("geforce2mx").blendUnit(), BlendUnit::Nv2a);
    EXPECT_EQ(Profile{}.blendUnit(), BlendUnit::IdealRound);
}

TEST(Voodoo, DithersWithSubtractionUnlessTold) {
    for (const char* id : {"voodoo1", "voodoo2", "voodoo3"}) {
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

INSTANTIATE_TEST_SUITE_P(All, EachVoodoo, testing::Values("voodoo1", "voodoo2", "voodoo3"),
                         [](const auto& test) { return test.param; });

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

TEST(Geforce2Mx, CountsWithSignByReverseSubtract) {
    const Profile geforce = chip("geforce2mx");
    EXPECT_THAT(geforce.blendEquations, SizeIs(5));
    EXPECT_TRUE(geforce.allowsBlend(One, One));
    EXPECT_EQ(geforce.alphaSourceFactors, geforce.sourceFactors);
    EXPECT_FALSE(geforce.separateAlphaFactors);
}

}  // namespace
}  // namespace gnomon
