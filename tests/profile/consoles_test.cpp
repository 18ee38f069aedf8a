// The profiles of consoles: what their chips' fixed ways of blending are in OpenGL's words.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "profile/words.h"
#include "shipped.h"

namespace gnomon {
namespace consoles_test {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::SizeIs;
using testing::UnorderedElementsAre;
using testing::UnorderedElementsAreArray;
using enum BlendFactor;

/// The pairs of OpenGL's factors that P * A + M * B is for P, M of pixel and memory, A of an alpha or
/// nothing, and B of 1 - A, one, nothing; P differs from M. Section 2.10 (ANGRY).
std::set<BlendPair> pairsOfRdp() {
    std::set<BlendPair> pairs;
    for (const auto& [alpha, complement] :
         {std::pair{SrcAlpha, OneMinusSrcAlpha}, std::pair{ConstantAlpha, OneMinusConstantAlpha},
          std::pair{Zero, One}})
        for (const BlendFactor b : {complement, One, Zero}) {
            pairs.insert({alpha, b});  // P is the pixel
            pairs.insert({b, alpha});  // P is memory
        }
    return pairs;
}

TEST(N64, HasThePairsOfItsMultiplexers) {
    for (const char* id : {"n64", "n64-8888"}) {
        auto pairs = pairsOfRdp();
        pairs.insert({One, One});  // the greatest alpha, 31 of 32, for one
        EXPECT_THAT(chip(id).blendPairs, UnorderedElementsAreArray(pairs)) << id;
    }
}

TEST(N64, WrapsAndHasNoAlphaAndNoFartherTest) {
    for (const char* id : {"n64", "n64-8888"}) {
        const Profile n64 = chip(id);
        EXPECT_THAT(n64.blendEquations, Contains(BlendEquation::AddWrap)) << id;
        EXPECT_EQ(n64.alphaBits, 0) << id << ": its alpha bits are coverage";
        EXPECT_EQ(n64.stencilBits, 0);
        EXPECT_THAT(n64.depthFunctions,
                    UnorderedElementsAre(Compare::Less, Compare::Lequal, Compare::Always));
        EXPECT_THAT(n64.depthEncodings, ElementsAre(DepthEncoding::N64));
        EXPECT_FALSE(n64.allowsBlendWithConstantSource(OneMinusDstColor, Zero)) << "no inversion";
    }
}

TEST(Ps1, HasNoDepthAndSaysWhoSaysSo) {
    const Profile ps1 = chip("ps1");
    EXPECT_FALSE(ps1.depth);
    EXPECT_THAT(ps1.sourceOf("depth_bits"), testing::StartsWith("PSXSPX"));
    EXPECT_EQ(ps1.gradeOf("depth_bits"), Evidence::Document);
    EXPECT_TRUE(ps1.allowsBlend(One, One));
    EXPECT_THAT(ps1.blendEquations, ElementsAre(BlendEquation::Add, BlendEquation::ReverseSubtract));
}

// Its alpha is its stencil, and blending can't touch it.
TEST(Psp, KeepsItsStencilInAlpha) {
    for (const auto& [id, bits] :
         {std::pair{"psp", 8}, std::pair{"psp-4444", 4}, std::pair{"psp-5551", 1}, std::pair{"psp-565", 0}}) {
        const Profile psp = chip(id);
        EXPECT_EQ(psp.alphaBits, bits) << id;
        EXPECT_EQ(psp.stencilBits, bits) << id;
        EXPECT_FALSE(psp.stencilWrap || psp.blendWritesAlpha) << id;
        EXPECT_TRUE(psp.allowsBlend(DstColor, One) && psp.allowsBlend(DstColor, Zero)) << id;
        EXPECT_EQ(psp.maxWidth, 480);
    }
}

TEST(GameCube, HasAlphaOnlyBesideSixBits) {
    const Profile rgba6 = chip("gamecube"), rgb8 = chip("gamecube-888");
    EXPECT_EQ(rgba6.alphaBits, 6);
    EXPECT_TRUE(rgba6.blendWritesAlpha);
    EXPECT_EQ(rgb8.alphaBits, 0);
    for (const Profile& p : {rgba6, rgb8}) {
        EXPECT_THAT(p.blendEquations, ElementsAre(BlendEquation::Add, BlendEquation::ReverseSubtract))
            << p.id;
        EXPECT_TRUE(p.logicOps) << p.id << ": parity by inversion";
        EXPECT_EQ(p.stencilBits, 0);
        EXPECT_EQ(p.writeMask, WriteMask::Group);
    }
}

TEST(Dreamcast, BlendsEightBitsWithAlphaButWithoutStencil) {
    const Profile dreamcast = chip("dreamcast");
    EXPECT_EQ(dreamcast.colourFormats.front().name, "8888");
    EXPECT_THAT(dreamcast.ditherModes, IsEmpty()) << "it dithers when a tile is written out";
    EXPECT_TRUE(dreamcast.allowsBlend(DstColor, One));
    EXPECT_THAT(dreamcast.alphaSourceFactors, Contains(DstColor));
    EXPECT_EQ(dreamcast.stencilBits, 0);
    EXPECT_THAT(dreamcast.blendEquations, ElementsAre(BlendEquation::Add));
}

TEST(Ds, IsSmallerThanTheUsualFrame) {
    EXPECT_EQ(chip("ds").maxWidth, 256);
    EXPECT_EQ(chip("ds").maxHeight, 192);
}

}  // namespace consoles_test
}  // namespace gnomon
