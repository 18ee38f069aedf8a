#include "plan/chip_terms.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "profile/words.h"

namespace gnomon {
namespace {

using enum BlendFactor;

/// Phrases of one pass; nothing if it can't be said.
using Terms = std::optional<std::vector<std::string>>;

/// A colour of 0..1 on 8 bits, or where 1 is another value.
int scaled(float value, int one = 255) {
    return int(std::lround(value * float(one)));
}

bool draws(const Pass& pass, BlendFactor source, BlendFactor destination) {
    return pass.blend.enabled && pass.blend.source == source && pass.blend.destination == destination;
}

bool isConstant(const Pass& pass) {
    return pass.kind != PassKind::Scene && pass.texture == MaskTexture::None;
}

/// A constant grey by which the frame buffer is multiplied, whichever way round the factors stand.
std::optional<float> constantScale(const Pass& pass) {
    const bool scales = draws(pass, DstColor, Zero) || draws(pass, Zero, SrcColor);
    return scales && isConstant(pass) ? std::optional(pass.colour.r) : std::nullopt;
}

/// Source values of a draw in one colour: "0x04", or "0x080408" where channels differ.
std::string constantColour(const Pass& pass) {
    const glm::vec4& c = pass.colour;
    if (!pass.write.red) return fmt::format("0x{:02X}", scaled(c.a));
    if (c.r == c.g && c.g == c.b) return fmt::format("0x{:02X}", scaled(c.r));
    return fmt::format("0x{:02X}{:02X}{:02X}", scaled(c.r), scaled(c.g), scaled(c.b));
}

/// For values that are whole on the chip: what is greater than the reference is greater than its floor.
int alphaReference(const Pass& pass) {
    return int(std::floor(pass.alphaTest.reference * 255 + 1e-3f));
}

Compare depthFunction(const Pass& pass) {
    return pass.depthTest ? pass.depthFunction : Compare::Always;
}

/// Where a greater depth is the nearer.
Compare turnedRound(Compare function) {
    switch (function) {
        case Compare::Less:
            return Compare::Greater;
        case Compare::Lequal:
            return Compare::Gequal;
        case Compare::Greater:
            return Compare::Less;
        case Compare::Gequal:
            return Compare::Lequal;
        default:
            return function;
    }
}

const char* onOff(bool on) {
    return on ? "on" : "off";
}

bool isNarrow(const Profile& p) {
    return !p.colourFormats.empty() && p.colourFormats.front().green < 8;
}

// PlayStation 2: ((A - B) * C >> 7) + D.

/// A, B and D are Cs, Cd or 0; C is As, Ad or FIX.
struct GsAlpha {
    std::string_view a = "0", b = "0", c = "FIX", d = "0";
    int fix = 0x80;
    bool takesSource() const { return a == "Cs" || b == "Cs" || d == "Cs"; }
};

/// C for a factor that isn't a colour; nothing for a colour.
std::optional<const char*> gsCoefficient(BlendFactor factor) {
    switch (factor) {
        case SrcAlpha:
        case OneMinusSrcAlpha:
            return "As";
        case DstAlpha:
        case OneMinusDstAlpha:
            return "Ad";
        case ConstantAlpha:
        case OneMinusConstantAlpha:
            return "FIX";
        default:
            return std::nullopt;
    }
}

bool isComplement(BlendFactor factor) {
    return factor == OneMinusSrcAlpha || factor == OneMinusDstAlpha || factor == OneMinusConstantAlpha;
}

/// A product of two colours goes through FIX, where one of them is constant.
std::optional<GsAlpha> gsConstant(const Pass& pass) {
    if (!isConstant(pass)) return std::nullopt;
    const int fix = scaled(pass.colour.r, 0x80);
    if (draws(pass, DstColor, One)) return GsAlpha{"Cd", "0", "FIX", "Cd", fix};
    if (constantScale(pass)) return GsAlpha{"Cd", "0", "FIX", "0", fix};
    if (draws(pass, OneMinusDstColor, Zero)) return GsAlpha{"Cs", "Cd", "FIX", "0", fix};
    return std::nullopt;
}

std::optional<GsAlpha> gsAlpha(const Pass& pass) {
    const auto [s, d] = std::pair(pass.blend.source, pass.blend.destination);
    if (pass.blend.equation == BlendEquation::ReverseSubtract)
        return s == One && d == One ? std::optional(GsAlpha{"0", "Cs", "FIX", "Cd"}) : std::nullopt;
    if (pass.blend.equation != BlendEquation::Add && pass.blend.equation != BlendEquation::AddWrap)
        return std::nullopt;
    if (const auto constant = gsConstant(pass)) return constant;

    const auto whole = [](BlendFactor f) { return f == Zero || f == One; };
    if (whole(s) && whole(d)) {
        if (s == One && d == One) return GsAlpha{"Cs", "0", "FIX", "Cd"};
        return GsAlpha{"0", "0", "FIX", s == One ? "Cs" : d == One ? "Cd" : "0"};
    }
    const auto sourceC = gsCoefficient(s), destinationC = gsCoefficient(d);
    if ((!whole(s) && !sourceC) || (!whole(d) && !destinationC)) return std::nullopt;
    const int fix = scaled(pass.blend.constant, 0x80);
    if (sourceC && destinationC)  // one coefficient and its complement
        return isComplement(s) ? GsAlpha{"Cd", "Cs", *sourceC, "Cs", fix}
                               : GsAlpha{"Cs", "Cd", *sourceC, "Cd", fix};
    const char* varying = sourceC ? "Cs" : "Cd";
    const char* other = (sourceC ? d : s) == One ? (sourceC ? "Cd" : "Cs") : "0";
    const char* coefficient = sourceC ? *sourceC : *destinationC;
    if (isComplement(sourceC ? s : d)) return GsAlpha{"0", varying, coefficient, varying, fix};
    return GsAlpha{varying, "0", coefficient, other, fix};
}

Terms gsTerms(const Pass& pass) {
    if (pass.kind == PassKind::Copy) return {{"TEX0 at the frame buffer, TEXFLUSH"}};
    std::vector<std::string> terms;
    if (pass.blend.enabled && pass.write.any()) {
        const auto alpha = gsAlpha(pass);
        if (!alpha) return std::nullopt;
        terms.push_back(fmt::format("ALPHA A={} B={} C={} D={}", alpha->a, alpha->b, alpha->c, alpha->d));
        if (alpha->c == "FIX") terms.push_back(fmt::format("FIX=0x{:02X}", alpha->fix));
        // Inversion takes 1 from the destination, and the colour as FIX.
        const bool inverts = draws(pass, OneMinusDstColor, Zero);
        if (isConstant(pass) && alpha->takesSource())
            terms.push_back(fmt::format("Cs={}", inverts ? "0xFF" : constantColour(pass)));
        terms.push_back(fmt::format("COLCLAMP={}", pass.blend.equation == BlendEquation::AddWrap ? 0 : 1));
    }
    const ColourWrite& w = pass.write;
    const unsigned kept = (w.red ? 0 : 0xffu) | (w.green ? 0 : 0xff00u) | (w.blue ? 0 : 0xff0000u) |
                          (w.alpha ? 0 : 0xff000000u);
    terms.push_back(fmt::format("FBMSK=0x{:08X}", kept));
    if (w.alpha) terms.push_back("FBA=0");
    const std::string alphaTest =
        pass.alphaTest.enabled ? fmt::format(" ATST={} AREF=0x{:02X} AFAIL=KEEP",
                                             upperCase(name(pass.alphaTest.function)), alphaReference(pass))
                               : "";
    terms.push_back(
        fmt::format("TEST{} ZTST={}", alphaTest, upperCase(name(turnedRound(depthFunction(pass))))));
    terms.push_back(fmt::format("ZMSK={}", pass.depthWrite ? 0 : 1));
    return terms;
}

// N64: (P * a + M * (b + 1)) >> 5, forced, of 5-bit weights.

Terms rdpBlend(const Pass& pass) {
    const auto force = [](const char* p, const char* a, const char* b) {
        return fmt::format("force blend, P={} A={} M=memory B={}", p, a, b);
    };
    const bool wraps = pass.blend.equation == BlendEquation::AddWrap;
    if (wraps && draws(pass, One, One) && isConstant(pass))
        return {{force("blend colour", "fog alpha 255", "1"),
                 fmt::format("blend colour {}", scaled(pass.colour.r))}};
    if (wraps && draws(pass, One, One)) return {{force("pixel", "fog alpha 255", "1")}};
    if (pass.blend.equation != BlendEquation::Add) return std::nullopt;
    if (draws(pass, SrcAlpha, OneMinusSrcAlpha)) return {{force("pixel", "pixel alpha", "1-A")}};
    if (draws(pass, DstColor, One) && isConstant(pass) && pass.colour.r == 1)
        return {{force("memory", "fog alpha 255", "1")}};
    if (const auto scale = constantScale(pass)) {
        // b + 1 = 32 - a is the share that is kept.
        const int a = 32 - scaled(*scale, 32);
        if (a < 1 || a > 31) return std::nullopt;
        return {
            {force("blend colour", "pixel alpha", "1-A"), "blend colour 0", fmt::format("alpha {}", a << 3)}};
    }
    return std::nullopt;
}

Terms rdpTerms(const Pass& pass) {
    if (pass.kind == PassKind::Copy) return std::nullopt;
    std::vector<std::string> terms;
    if (pass.blend.enabled && pass.write.any()) {
        const Terms blend = rdpBlend(pass);
        if (!blend) return std::nullopt;
        terms = *blend;
        terms.push_back("dither off, antialiasing off");
    }
    switch (depthFunction(pass)) {
        case Compare::Less:
            terms.push_back("z compare, mode transparent");
            break;
        case Compare::Lequal:
            terms.push_back("z compare, mode opaque");
            break;
        case Compare::Always:
            terms.push_back("z compare off");
            break;
        default:
            return std::nullopt;
    }
    terms.push_back(fmt::format("z update {}", onOff(pass.depthWrite)));
    return terms;
}

// GameCube and Dreamcast: a factor can be the other side's colour.

/// Nothing for a colour of the factor's own side, a constant, or the saturating factor.
std::optional<std::string> powerVrFactor(BlendFactor factor, bool ofSource) {
    switch (factor) {
        case Zero:
            return "zero";
        case One:
            return "one";
        case SrcAlpha:
            return "source alpha";
        case OneMinusSrcAlpha:
            return "1 - source alpha";
        case DstAlpha:
            return "destination alpha";
        case OneMinusDstAlpha:
            return "1 - destination alpha";
        case SrcColor:
        case DstColor:
            return (factor == DstColor) == ofSource ? std::optional<std::string>("other colour")
                                                    : std::nullopt;
        case OneMinusSrcColor:
        case OneMinusDstColor:
            return (factor == OneMinusDstColor) == ofSource ? std::optional<std::string>("1 - other colour")
                                                            : std::nullopt;
        default:
            return std::nullopt;
    }
}

/// How a GameCube blends.
std::optional<std::string> flipperBlend(const Pass& pass) {
    if (pass.logicInvert) return "blend mode logic, invert";
    if (!pass.blend.enabled || !pass.write.any()) return "blend mode none";
    if (pass.blend.equation == BlendEquation::ReverseSubtract) return "blend mode subtract";
    const auto s = powerVrFactor(pass.blend.source, true), d = powerVrFactor(pass.blend.destination, false);
    if (pass.blend.equation != BlendEquation::Add || !s || !d) return std::nullopt;
    return fmt::format("blend mode blend, source {}, destination {}", *s, *d);
}

Terms flipperTerms(const Pass& pass, const Profile& profile) {
    if (pass.kind == PassKind::Copy) {
        const char* format = pass.texture == MaskTexture::Alpha       ? " to A8"
                             : pass.texture == MaskTexture::Intensity ? " to I8"
                                                                      : "";
        return {{fmt::format("EFB copy{}", format)}};
    }
    const auto blend = flipperBlend(pass);
    if (!blend) return std::nullopt;
    std::vector<std::string> terms{*blend};
    if (pass.blend.enabled && isConstant(pass)) terms.push_back("colour " + constantColour(pass));
    terms.push_back(fmt::format("colour update {}", onOff(pass.write.red)));
    if (profile.alphaBits > 0) terms.push_back(fmt::format("alpha update {}", onOff(pass.write.alpha)));
    if (pass.alphaTest.enabled)
        terms.push_back(fmt::format("alpha compare {} 0x{:02X} and ALWAYS",
                                    upperCase(name(pass.alphaTest.function)), alphaReference(pass)));
    if (isNarrow(profile) && (pass.blend.enabled || pass.logicInvert)) terms.push_back("dither off");
    terms.push_back("z " + upperCase(name(depthFunction(pass))));
    terms.push_back(fmt::format("z update {}", onOff(pass.depthWrite)));
    return terms;
}

Terms powerVrTerms(const Pass& pass) {
    if (pass.kind == PassKind::Copy) return std::nullopt;
    std::vector<std::string> terms;
    if (pass.blend.enabled) {
        const auto s = powerVrFactor(pass.blend.source, true),
                   d = powerVrFactor(pass.blend.destination, false);
        if (pass.blend.equation != BlendEquation::Add || !s || !d) return std::nullopt;
        // Sorting by the hardware would change the order of passes over the mask.
        terms = {fmt::format("source {}, destination {}", *s, *d),
                 "source select 0, destination select 0, autosort off"};
    }
    terms.push_back("depth " + upperCase(name(turnedRound(depthFunction(pass)))));
    terms.push_back(fmt::format("z write {}", onOff(pass.depthWrite)));
    return terms;
}

// PSP: fixed colours stand in for one and zero.

std::optional<std::string> geFactor(const Pass& pass, bool ofSource) {
    const BlendFactor factor = ofSource ? pass.blend.source : pass.blend.destination;
    const char* fix = ofSource ? "fix A" : "fix B";
    if (factor == Zero || factor == One)
        return fmt::format("{} 0x{}", fix, factor == One ? "FFFFFF" : "000000");
    if (factor == ConstantColor || factor == ConstantAlpha) {
        const int c = scaled(pass.blend.constant);
        return fmt::format("{} 0x{:02X}{:02X}{:02X}", fix, c, c, c);
    }
    return powerVrFactor(factor, ofSource);
}

Terms geTerms(const Pass& pass, const Profile& profile) {
    if (pass.kind == PassKind::Copy) return std::nullopt;
    std::vector<std::string> terms;
    if (pass.logicInvert) {
        terms.push_back("logic op invert");
    } else if (pass.blend.enabled && pass.write.any()) {
        std::string equation = name(pass.blend.equation);
        std::replace(equation.begin(), equation.end(), '_', ' ');
        const auto s = geFactor(pass, true), d = geFactor(pass, false);
        const bool extreme =
            pass.blend.equation == BlendEquation::Min || pass.blend.equation == BlendEquation::Max;
        if (pass.blend.equation == BlendEquation::AddWrap || (!extreme && (!s || !d))) return std::nullopt;
        terms.push_back(extreme ? fmt::format("blend {}", equation)
                                : fmt::format("blend {}, source {}, destination {}", equation, *s, *d));
        if (isConstant(pass)) terms.push_back("colour " + constantColour(pass));
        if (isNarrow(profile)) terms.push_back("dither off");
    }
    terms.push_back(fmt::format("colour mask 0x{:02X}{:02X}{:02X}", pass.write.blue ? 0 : 0xff,
                                pass.write.green ? 0 : 0xff, pass.write.red ? 0 : 0xff));
    if (pass.alphaTest.enabled)
        terms.push_back(fmt::format("alpha test {} 0x{:02X}", upperCase(name(pass.alphaTest.function)),
                                    alphaReference(pass)));
    terms.push_back("z " + upperCase(name(depthFunction(pass))));
    terms.push_back(fmt::format("z mask {}", pass.depthWrite ? 0 : 1));
    return terms;
}

// 3dfx: Glide's calls. Alpha blends by one and zero only, so that it is written as it comes.

/// One code is the other side's colour; VSA-100 has one more for its own side's.
std::string glideFactor(BlendFactor factor, bool ofSource) {
    switch (factor) {
        case SrcColor:
        case DstColor:
            if ((factor == DstColor) == ofSource) return "GR_BLEND_" + upperCase(name(factor));
            return "GR_BLEND_SAME_COLOR_EXT";
        case OneMinusSrcColor:
        case OneMinusDstColor:
            if ((factor == OneMinusDstColor) == ofSource) return "GR_BLEND_" + upperCase(name(factor));
            return "GR_BLEND_ONE_MINUS_SAME_COLOR_EXT";
        case SrcAlphaSaturate:
            return "GR_BLEND_ALPHA_SATURATE";
        default:
            return "GR_BLEND_" + upperCase(name(factor));
    }
}

Terms glideTerms(const Pass& pass) {
    if (pass.kind == PassKind::Copy) return std::nullopt;
    std::vector<std::string> terms;
    const bool blends = pass.blend.enabled && pass.write.any();
    const BlendFactor source = blends ? pass.blend.source : One,
                      destination = blends ? pass.blend.destination : Zero;
    const std::string s = glideFactor(source, true), d = glideFactor(destination, false);
    const bool alpha = blends && pass.write.alpha;
    const std::string alphas = alpha ? fmt::format("{}, {}", s, d) : "GR_BLEND_ONE, GR_BLEND_ZERO";
    switch (pass.blend.equation) {
        case BlendEquation::Add:
            terms.push_back(fmt::format("grAlphaBlendFunction({}, {}, {})", s, d, alphas));
            break;
        case BlendEquation::Subtract:
        case BlendEquation::ReverseSubtract: {
            const char* op =
                pass.blend.equation == BlendEquation::Subtract ? "GR_BLEND_OP_SUB" : "GR_BLEND_OP_REVSUB";
            terms.push_back(fmt::format("grAlphaBlendFunctionExt({}, {}, {}, {}, {})", s, d, op, alphas,
                                        alpha ? op : "GR_BLEND_OP_ADD"));
            break;
        }
        default:
            return std::nullopt;
    }
    if (blends) terms.push_back("grDitherMode(GR_DITHER_DISABLE)");
    const auto flag = [](bool on) { return on ? "FXTRUE" : "FXFALSE"; };
    terms.push_back(fmt::format("grColorMask({}, {})", flag(pass.write.red), flag(pass.write.alpha)));
    if (pass.alphaTest.enabled)
        terms.push_back(fmt::format("grAlphaTestFunction(GR_CMP_{}), grAlphaTestReferenceValue({})",
                                    upperCase(name(pass.alphaTest.function)), alphaReference(pass)));
    terms.push_back(fmt::format("grDepthBufferFunction(GR_CMP_{})", upperCase(name(depthFunction(pass)))));
    terms.push_back(fmt::format("grDepthMask({})", flag(pass.depthWrite)));
    return terms;
}

// Chips with fixed blends.

/// RIVA 128: one weight, beta, and its complement; or a sum without weights.
std::optional<std::string> nv3Blend(const Pass& pass) {
    if (pass.blend.equation != BlendEquation::Add) return std::nullopt;
    const auto [s, d] = std::pair(pass.blend.source, pass.blend.destination);
    if (s == One && d == One) return "mode ADD";
    for (const auto& [beta, weight, rest] : {std::tuple("source alpha", SrcAlpha, OneMinusSrcAlpha),
                                             std::tuple("destination colour", DstColor, OneMinusDstColor)}) {
        if ((s != weight && s != Zero) || (d != rest && d != Zero) || (s == Zero && d == Zero)) continue;
        return fmt::format("mode BLEND, beta {}{}{}", beta, s == Zero ? ", source factor ZERO" : "",
                           d == Zero ? ", destination factor ZERO" : "");
    }
    if (const auto scale = constantScale(pass))
        return fmt::format("mode BLEND, beta source alpha, source factor ZERO, alpha {}",
                           (16 - scaled(*scale, 16)) * 16);
    return std::nullopt;
}

/// ViRGE: source alpha and its complement, in the unit that fog would use.
std::optional<std::string> virgeBlend(const Pass& pass) {
    if (pass.blend.equation != BlendEquation::Add) return std::nullopt;
    if (draws(pass, SrcAlpha, OneMinusSrcAlpha)) return "blend by source alpha, fog off";
    if (const auto scale = constantScale(pass))
        return fmt::format("blend by source alpha, colour 0, alpha {}, fog off", 255 - scaled(*scale));
    return std::nullopt;
}

/// PlayStation: B is the frame buffer, F the source.
std::optional<std::string> psxBlend(const Pass& pass) {
    if (draws(pass, One, One) && pass.blend.equation == BlendEquation::Add) return "B+F";
    if (draws(pass, One, One) && pass.blend.equation == BlendEquation::ReverseSubtract) return "B-F";
    const auto scale = constantScale(pass);
    if (pass.blend.equation == BlendEquation::Add && scale && scaled(*scale, 2) == 1) return "B/2+F/2, F=0";
    return std::nullopt;
}

Terms fixedTerms(const Pass& pass, std::optional<std::string> (*blend)(const Pass&), bool hasDepth) {
    if (pass.kind == PassKind::Copy) return std::nullopt;
    std::vector<std::string> terms;
    if (pass.blend.enabled && pass.write.any()) {
        const auto how = blend(pass);
        if (!how) return std::nullopt;
        terms = {*how, "dither off"};
    }
    if (!hasDepth) return terms;
    terms.push_back("z " + upperCase(name(depthFunction(pass))));
    terms.push_back(fmt::format("z write {}", onOff(pass.depthWrite)));
    return terms;
}

/// Whether there are words for all that @p pass asks of @p unit besides blending.
bool hasWords(BlendUnit unit, const Pass& pass) {
    const bool glide = unit == BlendUnit::VoodooMame || unit == BlendUnit::Voodoo86Box;
    const bool gs = unit == BlendUnit::Gs || unit == BlendUnit::GsWrap;
    const bool modern = unit == BlendUnit::Flipper || unit == BlendUnit::Ge;
    return (!pass.logicInvert || modern) && (!pass.alphaTest.enabled || modern || gs || glide) &&
           !pass.stencil.enabled && pass.program == Program::None;
}

Terms termsOf(const Pass& pass, const Profile& profile) {
    if (!hasWords(profile.blendUnit(), pass)) return std::nullopt;
    switch (profile.blendUnit()) {
        case BlendUnit::Gs:
        case BlendUnit::GsWrap:
            return gsTerms(pass);
        case BlendUnit::Rdp:
            return rdpTerms(pass);
        case BlendUnit::Flipper:
            return flipperTerms(pass, profile);
        case BlendUnit::PowerVr:
            return powerVrTerms(pass);
        case BlendUnit::Ge:
            return geTerms(pass, profile);
        case BlendUnit::VoodooMame:
        case BlendUnit::Voodoo86Box:
            return glideTerms(pass);
        case BlendUnit::Nv3:
            return fixedTerms(pass, nv3Blend, true);
        case BlendUnit::Virge:
            return fixedTerms(pass, virgeBlend, true);
        case BlendUnit::Psx:
            return fixedTerms(pass, psxBlend, false);
        default:
            return std::nullopt;
    }
}

/// The rectangle that bounds a pass; rows from the top, as these chips count them. Nothing for a whole pass,
/// and for chips of which the words are not known.
std::string scissorTerms(const Pass& pass, const Profile& profile, const Plan& plan) {
    const BlendUnit unit = profile.blendUnit();
    const bool gs = unit == BlendUnit::Gs || unit == BlendUnit::GsWrap;
    if (plan.windows.empty() || (!gs && unit != BlendUnit::Psx)) return "";
    const auto part = scissorOf(pass, plan.windows);
    if (!part || part->empty()) return "";
    const char* name = gs ? "SCISSOR" : "drawing area";
    if (pass.extent == Extent::Volumes && pass.volume == kAllVolumes)
        return fmt::format("{} of each volume", name);
    const int top = plan.height - part->y - part->height;
    return gs ? fmt::format("{} X0={} X1={} Y0={} Y1={}", name, part->x, part->x + part->width - 1, top,
                            top + part->height - 1)
              : fmt::format("{} {},{} {}x{}", name, part->x, top, part->width, part->height);
}

}  // namespace

std::string chipTerms(const Pass& pass, const Profile& profile, const Plan& plan) {
    if (pass.kind == PassKind::Clear) return "";
    // A copy's texture is the plan's matter.
    const bool lacks = pass.kind != PassKind::Copy && !missing(profile, {.passes = {pass}}).empty();
    Terms terms = lacks ? std::nullopt : termsOf(pass, profile);
    if (!terms) return "";
    if (const std::string scissor = scissorTerms(pass, profile, plan); !scissor.empty())
        terms->push_back(scissor);
    return fmt::format("{}", fmt::join(*terms, ", "));
}

}  // namespace gnomon
