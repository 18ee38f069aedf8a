// Passes in the chips' own terms: their exact words, and that a PlayStation 2's registers compute what OpenGL
// asks for.

#include "plan/chip_terms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "profile/blend.h"

namespace gnomon {
namespace chip_terms_test {

using enum BlendFactor;

/// A chip that lacks nothing, of one blend unit and colour format.
Profile chipOf(BlendUnit unit, ColourFormat format = {"8888", 8, 8, 8, 8}) {
    Profile p;
    p.blendUnits = {unit};
    p.colourFormats = {std::move(format)};
    p.alphaBits = p.colourFormats.front().alpha;
    p.blendWritesAlpha = p.logicOps = p.depth = true;
    p.writeMask = WriteMask::Channel;
    for (int i = 0; i < 8; ++i) p.depthFunctions.insert(Compare(i)), p.alphaFunctions.insert(Compare(i));
    for (int i = 0; i <= int(OneMinusConstantAlpha); ++i) p.sourceFactors.insert(BlendFactor(i));
    p.destinationFactors = p.alphaSourceFactors = p.alphaDestinationFactors = p.sourceFactors;
    for (int i = 0; i <= int(BlendEquation::AddWrap); ++i) p.blendEquations.insert(BlendEquation(i));
    p.frameTexture = FrameTexture::Direct;
    p.textureUnits = 1, p.maxTextureSize = 1024;
    return p;
}

const ColourFormat k565{"565", 5, 6, 5, 0}, k555{"555", 5, 5, 5, 0}, k5551{"5551", 5, 5, 5, 1},
    k6666{"6666", 6, 6, 6, 6};

Pass volumeWith(BlendFactor source, BlendFactor destination, float colour = 1,
                BlendEquation equation = BlendEquation::Add) {
    return {.kind = PassKind::Volume,
            .colour = glm::vec4(colour),
            .depthTest = true,
            .depthFunction = Compare::Lequal,
            .blend = {.enabled = true, .source = source, .destination = destination, .equation = equation}};
}

constexpr float kHalf = 128.0f / 255;

Pass stepOf(int value, BlendEquation equation) {
    return volumeWith(One, One, float(value) / 255, equation);
}

TEST(ChipTerms, OfAPlayStation2SayFixAndColclamp) {
    const Profile ps2 = chipOf(BlendUnit::Gs);
    const std::string rest = ", FBMSK=0xFF000000, TEST ZTST=GEQUAL, ZMSK=1";
    EXPECT_EQ(chipTerms(volumeWith(DstColor, One), ps2),
              "ALPHA A=Cd B=0 C=FIX D=Cd, FIX=0x80, COLCLAMP=1" + rest);
    EXPECT_EQ(chipTerms(volumeWith(DstColor, Zero, kHalf), ps2),
              "ALPHA A=Cd B=0 C=FIX D=0, FIX=0x40, COLCLAMP=1" + rest);
    EXPECT_EQ(chipTerms(volumeWith(OneMinusDstColor, Zero), ps2),
              "ALPHA A=Cs B=Cd C=FIX D=0, FIX=0x80, Cs=0xFF, COLCLAMP=1" + rest);
    EXPECT_EQ(chipTerms(stepOf(8, BlendEquation::AddWrap), ps2),
              "ALPHA A=Cs B=0 C=FIX D=Cd, FIX=0x80, Cs=0x08, COLCLAMP=0" + rest);
    EXPECT_EQ(chipTerms(stepOf(255, BlendEquation::AddWrap), ps2),
              "ALPHA A=Cs B=0 C=FIX D=Cd, FIX=0x80, Cs=0xFF, COLCLAMP=0" + rest);
    EXPECT_EQ(chipTerms(stepOf(1, BlendEquation::ReverseSubtract), ps2),
              "ALPHA A=0 B=Cs C=FIX D=Cd, FIX=0x80, Cs=0x01, COLCLAMP=1" + rest);
}

TEST(ChipTerms, OfAPlayStation2SayTestsMasksAndTheFrameAsATexture) {
    const Profile ps2 = chipOf(BlendUnit::Gs);
    const Pass apply{
        .kind = PassKind::Rectangle,
        .blend = {.enabled = true, .source = Zero, .destination = ConstantAlpha, .constant = kHalf},
        .alphaTest = {true, Compare::Notequal, 96 / 255.0f},
        .texture = MaskTexture::Intensity};
    EXPECT_EQ(chipTerms(apply, ps2),
              "ALPHA A=Cd B=0 C=FIX D=0, FIX=0x40, COLCLAMP=1, FBMSK=0xFF000000, "
              "TEST ATST=NOTEQUAL AREF=0x60 AFAIL=KEEP ZTST=ALWAYS, ZMSK=1");
    EXPECT_EQ(chipTerms({.kind = PassKind::Rectangle, .write = kWriteAlpha}, ps2),
              "FBMSK=0x00FFFFFF, FBA=0, TEST ZTST=ALWAYS, ZMSK=1");
    EXPECT_EQ(
        chipTerms({.kind = PassKind::Scene, .depthTest = true, .depthWrite = true, .write = kWriteNothing},
                  ps2),
        "FBMSK=0xFFFFFFFF, TEST ZTST=GREATER, ZMSK=0");
    EXPECT_EQ(chipTerms({.kind = PassKind::Copy, .texture = MaskTexture::Rgb}, ps2),
              "TEX0 at the frame buffer, TEXFLUSH");
}

/// What follows @p key in "KEY=VALUE".
std::string valueOf(const std::string& terms, const std::string& key) {
    const std::size_t at = terms.find(key + "=");
    if (at == std::string::npos) return "";
    const std::size_t from = at + key.size() + 1;
    return terms.substr(from, terms.find_first_of(" ,", from) - from);
}

/// The share that a factor is, of alphas that are 1 at 128 and a constant of 1/2.
double share(BlendFactor factor, double source, double destination, double sourceAlpha,
             double destinationAlpha) {
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
        case SrcAlpha:
            return sourceAlpha;
        case OneMinusSrcAlpha:
            return 1 - sourceAlpha;
        case DstAlpha:
            return destinationAlpha;
        case OneMinusDstAlpha:
            return 1 - destinationAlpha;
        case ConstantAlpha:
        case OneMinusConstantAlpha:
            return 0.5;
        default:
            ADD_FAILURE() << name(factor);
            return 0;
    }
}

// The registers, as printed, through the unit's integer function: within 1 of the sum that OpenGL means.
TEST(ChipTerms, OfAPlayStation2ComputeWhatOpenGLAsksFor) {
    const Profile ps2 = loadProfile(std::string(GNOMON_SOURCE) + "/profiles/ps2.toml");
    std::set<BlendPair> pairs = ps2.blendPairs;
    pairs.insert(ps2.constantSourcePairs.begin(), ps2.constantSourcePairs.end());
    ASSERT_GT(pairs.size(), 25u);
    for (const auto& pair : pairs) {
        const BlendFactor s = pair.first, d = pair.second;
        // A colour in FIX is a grey of its own; otherwise any.
        const bool throughFix = ps2.constantSourcePairs.contains(pair);
        const int source = throughFix ? 128 : 77;
        Pass pass = volumeWith(s, d, float(source) / 255);
        pass.blend.constant = 0.5f;
        const std::string terms = chipTerms(pass, ps2);
        ASSERT_NE(terms, "") << name(s) << " " << name(d);
        const auto input = [&](const char* key) {
            const std::string v = valueOf(terms, key);
            return v == "Cs" ? GsInput::Source : v == "Cd" ? GsInput::Destination : GsInput::Zero;
        };
        const std::string printed = valueOf(terms, "Cs");
        const int register_ = printed.empty() ? source : std::stoi(printed, nullptr, 16);
        const int sourceAlpha = 96, destinationAlpha = 32;
        const std::string c = valueOf(terms, "C");
        const int coefficient = c == "As"   ? sourceAlpha
                                : c == "Ad" ? destinationAlpha
                                            : std::stoi(valueOf(terms, "FIX"), nullptr, 16);
        for (const int destination : {0, 1, 64, 128, 200, 255}) {
            const int result = blendGs({input("A"), input("B"), coefficient, input("D")}, register_,
                                       destination, valueOf(terms, "COLCLAMP") == "1");
            const auto factor = [&](BlendFactor f) {
                return share(f, source / 255.0, destination / 255.0, sourceAlpha / 128.0,
                             destinationAlpha / 128.0);
            };
            const double meant = std::clamp(source * factor(s) + destination * factor(d), 0.0, 255.0);
            EXPECT_NEAR(result, meant, 1.01)
                << name(s) << " " << name(d) << ": " << terms << ", Cd " << destination;
        }
    }
}

TEST(ChipTerms, OfAnN64SayForceBlendAndItsColour) {
    const Profile n64 = chipOf(BlendUnit::Rdp, k5551);
    const std::string rest = ", dither off, antialiasing off, z compare, mode opaque, z update off";
    EXPECT_EQ(chipTerms(stepOf(17, BlendEquation::AddWrap), n64),
              "force blend, P=blend colour A=fog alpha 255 M=memory B=1, blend colour 17" + rest);
    EXPECT_EQ(chipTerms(stepOf(248, BlendEquation::AddWrap), n64),
              "force blend, P=blend colour A=fog alpha 255 M=memory B=1, blend colour 248" + rest);
    EXPECT_EQ(chipTerms(volumeWith(DstColor, Zero, kHalf), n64),
              "force blend, P=blend colour A=pixel alpha M=memory B=1-A, blend colour 0, alpha 128" + rest);
    EXPECT_EQ(chipTerms({.kind = PassKind::Scene, .depthTest = true, .depthWrite = true}, n64),
              "z compare, mode transparent, z update on");
    EXPECT_EQ(chipTerms(volumeWith(OneMinusDstColor, Zero), n64), "") << "it can't invert";
    EXPECT_EQ(chipTerms(stepOf(17, BlendEquation::Add), n64), "") << "its sums wrap";
    Pass farther = stepOf(17, BlendEquation::AddWrap);
    farther.depthFunction = Compare::Greater;
    EXPECT_EQ(chipTerms(farther, n64), "") << "there is no farther mode";
}

TEST(ChipTerms, OfAGameCubeSayItsBlendMode) {
    const Profile gamecube = chipOf(BlendUnit::Flipper, k6666);
    Pass down = stepOf(4, BlendEquation::ReverseSubtract);
    down.write = kWriteAlpha;
    EXPECT_EQ(chipTerms(down, gamecube),
              "blend mode subtract, colour 0x04, colour update off, alpha update on, dither off, z LEQUAL, "
              "z update off");
    Pass up = down;
    up.blend.equation = BlendEquation::Add;
    EXPECT_EQ(
        chipTerms(up, gamecube),
        "blend mode blend, source one, destination one, colour 0x04, colour update off, alpha update on, "
        "dither off, z LEQUAL, z update off");
    Pass invert{.kind = PassKind::Volume, .depthTest = true, .logicInvert = true};
    EXPECT_EQ(
        chipTerms(invert, gamecube),
        "blend mode logic, invert, colour update on, alpha update off, dither off, z LESS, z update off");
    EXPECT_EQ(
        chipTerms(volumeWith(DstColor, One), chipOf(BlendUnit::Flipper, {"888", 8, 8, 8, 0})),
        "blend mode blend, source other colour, destination one, colour 0xFF, colour update on, z LEQUAL, "
        "z update off");
    const Pass apply{.kind = PassKind::Rectangle,
                     .alphaTest = {true, Compare::Notequal, 0},
                     .texture = MaskTexture::Alpha};
    EXPECT_EQ(chipTerms(apply, gamecube),
              "blend mode none, colour update on, alpha update off, alpha compare NOTEQUAL 0x00 and ALWAYS, "
              "z ALWAYS, z update off");
    EXPECT_EQ(chipTerms({.kind = PassKind::Copy, .texture = MaskTexture::Alpha}, gamecube), "EFB copy to A8");
    EXPECT_EQ(chipTerms(volumeWith(SrcColor, Zero), gamecube), "") << "no factor of its own side's colour";
}

TEST(ChipTerms, OfADreamcastSayFactorsSelectsAndNoSorting) {
    const Profile dreamcast = chipOf(BlendUnit::PowerVr);
    EXPECT_EQ(chipTerms(volumeWith(DstColor, One), dreamcast),
              "source other colour, destination one, source select 0, destination select 0, autosort off, "
              "depth GEQUAL, z write off");
    EXPECT_EQ(chipTerms(volumeWith(Zero, DstColor), dreamcast), "");
    EXPECT_EQ(chipTerms(stepOf(1, BlendEquation::ReverseSubtract), dreamcast), "");
}

TEST(ChipTerms, OfAPspSayItsFixedColours) {
    const Profile psp = chipOf(BlendUnit::Ge, k565);
    const std::string rest = ", dither off, colour mask 0x000000, z LEQUAL, z mask 1";
    EXPECT_EQ(chipTerms(volumeWith(DstColor, One), psp),
              "blend add, source other colour, destination fix B 0xFFFFFF, colour 0xFF" + rest);
    EXPECT_EQ(chipTerms(volumeWith(DstColor, Zero, kHalf), psp),
              "blend add, source other colour, destination fix B 0x000000, colour 0x80" + rest);
    Pass down = stepOf(8, BlendEquation::ReverseSubtract);
    down.colour = glm::vec4(8, 4, 8, 0) / 255.0f;
    EXPECT_EQ(
        chipTerms(down, psp),
        "blend reverse subtract, source fix A 0xFFFFFF, destination fix B 0xFFFFFF, colour 0x080408" + rest);
    Pass invert{.kind = PassKind::Volume, .depthTest = true, .logicInvert = true};
    EXPECT_EQ(chipTerms(invert, psp), "logic op invert, colour mask 0x000000, z LESS, z mask 1");
    EXPECT_EQ(chipTerms(stepOf(8, BlendEquation::AddWrap), psp), "") << "its sums clamp";
}

TEST(ChipTerms, OfAVoodooAreGlidesCallsWithoutDither) {
    const Profile voodoo = chipOf(BlendUnit::VoodooMame, k565);
    const std::string rest =
        ", grDitherMode(GR_DITHER_DISABLE), grColorMask(FXTRUE, FXFALSE), "
        "grDepthBufferFunction(GR_CMP_LEQUAL), grDepthMask(FXFALSE)";
    EXPECT_EQ(chipTerms(volumeWith(DstColor, One), voodoo),
              "grAlphaBlendFunction(GR_BLEND_DST_COLOR, GR_BLEND_ONE, GR_BLEND_ONE, GR_BLEND_ZERO)" + rest);
    EXPECT_EQ(
        chipTerms(volumeWith(OneMinusDstColor, Zero), voodoo),
        "grAlphaBlendFunction(GR_BLEND_ONE_MINUS_DST_COLOR, GR_BLEND_ZERO, GR_BLEND_ONE, GR_BLEND_ZERO)" +
            rest);
    EXPECT_EQ(chipTerms({.kind = PassKind::Scene, .depthTest = true, .depthWrite = true}, voodoo),
              "grAlphaBlendFunction(GR_BLEND_ONE, GR_BLEND_ZERO, GR_BLEND_ONE, GR_BLEND_ZERO), "
              "grColorMask(FXTRUE, FXFALSE), grDepthBufferFunction(GR_CMP_LESS), grDepthMask(FXTRUE)");
    // VSA-100's equations.
    EXPECT_EQ(chipTerms(stepOf(8, BlendEquation::ReverseSubtract), voodoo),
              "grAlphaBlendFunctionExt(GR_BLEND_ONE, GR_BLEND_ONE, GR_BLEND_OP_REVSUB, GR_BLEND_ONE, "
              "GR_BLEND_ZERO, GR_BLEND_OP_ADD)" +
                  rest);
    EXPECT_EQ(chipTerms(stepOf(8, BlendEquation::AddWrap), voodoo), "");
}

TEST(ChipTerms, OfARiva128SayItsModeAndBeta) {
    const Profile riva = chipOf(BlendUnit::Nv3, k555);
    const std::string rest = ", dither off, z LEQUAL, z write off";
    EXPECT_EQ(chipTerms(stepOf(8, BlendEquation::Add), riva), "mode ADD" + rest);
    EXPECT_EQ(chipTerms(volumeWith(DstColor, Zero), riva),
              "mode BLEND, beta destination colour, destination factor ZERO" + rest);
    EXPECT_EQ(chipTerms(volumeWith(Zero, SrcColor, kHalf), riva),
              "mode BLEND, beta source alpha, source factor ZERO, alpha 128" + rest);
    EXPECT_EQ(blendNv3(0, 16, 128 >> 3, true), 8) << "that alpha halves";
    EXPECT_EQ(chipTerms(volumeWith(DstColor, One), riva), "") << "it can't double";
}

TEST(ChipTerms, OfAVirgeSaySourceAlphaAndNoFog) {
    const Profile virge = chipOf(BlendUnit::Virge, k555);
    const std::string rest = ", fog off, dither off, z LEQUAL, z write off";
    EXPECT_EQ(chipTerms(volumeWith(SrcAlpha, OneMinusSrcAlpha), virge), "blend by source alpha" + rest);
    EXPECT_EQ(chipTerms(volumeWith(DstColor, Zero, kHalf), virge),
              "blend by source alpha, colour 0, alpha 127" + rest);
    EXPECT_EQ(chipTerms(volumeWith(One, One), virge), "");
}

TEST(ChipTerms, OfAPlayStationAreItsFourBlends) {
    const Profile psx = chipOf(BlendUnit::Psx, k5551);
    EXPECT_EQ(chipTerms(stepOf(8, BlendEquation::Add), psx), "B+F, dither off");
    EXPECT_EQ(chipTerms(stepOf(8, BlendEquation::ReverseSubtract), psx), "B-F, dither off");
    EXPECT_EQ(chipTerms(volumeWith(DstColor, Zero, kHalf), psx), "B/2+F/2, F=0, dither off");
    EXPECT_EQ(chipTerms(volumeWith(DstColor, One), psx), "");
    Profile real = psx;
    real.depth = false;
    EXPECT_EQ(chipTerms(stepOf(8, BlendEquation::Add), real), "") << "it has no depth to test";
}

TEST(ChipTerms, AreNoneForWhatHasNoWordsOnTheChip) {
    Pass invert{.kind = PassKind::Volume, .logicInvert = true}, tested{.kind = PassKind::Rectangle},
        stencilled{.kind = PassKind::Volume};
    tested.alphaTest = {true, Compare::Notequal, 0};
    stencilled.stencil.enabled = true;
    for (const auto& [unit, inverts, tests] :
         {std::tuple(BlendUnit::Gs, false, true), std::tuple(BlendUnit::VoodooMame, false, true),
          std::tuple(BlendUnit::Flipper, true, true), std::tuple(BlendUnit::Ge, true, true),
          std::tuple(BlendUnit::PowerVr, false, false), std::tuple(BlendUnit::Rdp, false, false),
          std::tuple(BlendUnit::Nv3, false, false)}) {
        Profile p = chipOf(unit);
        p.stencilBits = 8;
        EXPECT_EQ(chipTerms(invert, p) != "", inverts) << name(unit);
        EXPECT_EQ(chipTerms(tested, p) != "", tests) << name(unit);
        EXPECT_EQ(chipTerms(stencilled, p), "") << name(unit);
        EXPECT_NE(chipTerms({.kind = PassKind::Scene, .depthTest = true}, p), "") << name(unit);
    }
}

TEST(ChipTerms, AreNoneWhereTheChipLacksSomethingOrSpeaksOpenGL) {
    Profile ps2 = chipOf(BlendUnit::Gs);
    ps2.blendEquations = {BlendEquation::Add};
    EXPECT_EQ(chipTerms(stepOf(1, BlendEquation::AddWrap), ps2), "");
    EXPECT_NE(chipTerms(stepOf(1, BlendEquation::Add), ps2), "");
    EXPECT_EQ(chipTerms({.kind = PassKind::Clear}, ps2), "");
    for (const BlendUnit unit : {BlendUnit::IdealRound, BlendUnit::ProductsFloor, BlendUnit::Nv2a})
        EXPECT_EQ(chipTerms(volumeWith(DstColor, One), chipOf(unit)), "");
}

// Rows of chips begin at the top: 120 - 40 - 64 = 16.
TEST(ChipTerms, BoundAPassWhereTheWordsAreKnown) {
    Plan plan{.height = 120, .windows = {{{12, 40, 96, 64}, {{12, 40, 32, 64}, {}}}}};
    Pass pass = stepOf(8, BlendEquation::Add);
    const auto added = [&](BlendUnit unit) {
        const Profile p = chipOf(unit);
        const std::string whole = chipTerms(pass, p);
        const std::string got = chipTerms(pass, p, plan);
        EXPECT_NE(whole, "");
        EXPECT_EQ(got.substr(0, whole.size()), whole);
        return got.substr(whole.size());
    };
    EXPECT_EQ(added(BlendUnit::Gs), "") << "a whole pass";
    pass.extent = Extent::Shadows;
    EXPECT_EQ(added(BlendUnit::Gs), ", SCISSOR X0=12 X1=107 Y0=16 Y1=79");
    EXPECT_EQ(added(BlendUnit::Psx), ", drawing area 12,16 96x64");
    EXPECT_EQ(added(BlendUnit::Flipper), "") << "unknown";
    pass.extent = Extent::Volumes;
    EXPECT_EQ(added(BlendUnit::Gs), ", SCISSOR of each volume");
    pass.volume = 0;
    EXPECT_EQ(added(BlendUnit::Gs), ", SCISSOR X0=12 X1=43 Y0=16 Y1=79");
    pass.volume = 1;
    EXPECT_EQ(added(BlendUnit::Gs), "") << "nothing is drawn";
}

}  // namespace chip_terms_test
}  // namespace gnomon
