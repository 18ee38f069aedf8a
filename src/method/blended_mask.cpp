// Masks that are made by blending, or by a logic operation, in a colour or alpha buffer.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "method/builder.h"
#include "method/count_step.h"

namespace gnomon {

using enum BlendFactor;

/// The logic operation is exact on every chip; blending inverts where a chip has none.
void PlanBuilder::countByInversion(int light, ColourWrite write) {
    const auto pass = [&](Parts parts, Compare function, const std::string& where) {
        Pass& p =
            volume(light, kAllVolumes, Faces::Both, parts, function,
                   fmt::format("invert by {}{}", m_profile.logicOps ? "logic operation" : "blending", where));
        p.write = write;
        p.logicInvert = m_profile.logicOps;
        if (!p.logicInvert) p.blend = blending(OneMinusDstColor, Zero);
    };
    const Parts open = this->open(light);
    if (axes.count == Count::Zfail) {
        pass(open, Compare::Greater, " behind the surface");
        pass(Part::LightCap, Compare::Gequal, " behind the surface");
    } else {
        pass(axes.count == Count::ZpassCap ? open | Part::NearCap : open, Compare::Lequal, "");
    }
}

/// All volumes at once: all steps up, then all steps down, so that a difference that clamps at 0 loses none.
void PlanBuilder::countBySteps(int light, ColourWrite write) {
    const bool wraps = countWraps(axes, m_profile);
    const auto pass = [&](Faces faces, Parts parts, Compare function, bool up, const std::string& which) {
        const char* how = wraps ? "by a sum that wraps, in any order"
                          : up  ? "by a sum that clamps, so before all others"
                                : "by a difference that clamps";
        Pass& p = volume(light, kAllVolumes, faces, parts, function,
                         fmt::format("count {}{}, {}", up ? "+1" : "-1", which, how));
        p.blend = blending(One, One);
        p.blend.equation = wraps ? BlendEquation::AddWrap
                           : up  ? BlendEquation::Add
                                 : BlendEquation::ReverseSubtract;
        p.colour = countColour(up);
        p.write = write;
    };
    const Parts open = this->open(light), cap = Part::LightCap;
    if (axes.count != Count::Zfail) {
        const Parts parts = axes.count == Count::ZpassCap ? open | Part::NearCap : open;
        for (const bool up : {true, false})
            pass(up ? Faces::Front : Faces::Back, parts, Compare::Lequal, up, "");
        return;
    }
    for (const bool up : {true, false}) {
        // Seen from infinity back faces go in and front faces out.
        const Faces faces = up ? Faces::Back : Faces::Front, others = up ? Faces::Front : Faces::Back;
        if (passesNearerOnly()) {
            for (const Parts parts : {open, cap}) pass(faces, parts, Compare::Always, up, ", all");
            pass(others, open, Compare::Lequal, up, " back for what is nearer");
            pass(others, cap, Compare::Less, up, " back for what is nearer");
        } else {
            pass(faces, open, Compare::Greater, up, " behind the surface");
            pass(faces, cap, Compare::Gequal, up, " behind the surface");
        }
    }
}

const ColourFormat& PlanBuilder::format() const {
    static const ColourFormat kNone;
    return m_profile.colourFormats.empty() ? kNone : m_profile.colourFormats.front();
}

glm::vec4 PlanBuilder::countColour(bool up) const {
    const bool wraps = countWraps(axes, m_profile);
    const bool doubled = !shadowAlpha().enabled;
    const auto step = [&](int bits) {
        const CountStep one = countStep(m_profile, std::max(bits, 1), wraps, doubled);
        return float(up ? one.up : one.down) / 255;
    };
    const ColourFormat& f = format();
    return {step(f.red), step(f.green), step(f.blue), step(m_profile.alphaBits)};
}

/// Roettger et al. 2002, section 4.2: front faces of a volume, then its back faces, volume by volume.
void PlanBuilder::countByBlending(int light, ColourWrite write) {
    const bool halves = axes.arithmetic == Arithmetic::Halve;
    const int volumes = shape(light).volumes;
    if (volumes == 0) return;
    if (axes.arithmetic == Arithmetic::Parity) return countByInversion(light, write);
    if (axes.arithmetic == Arithmetic::Count) return countBySteps(light, write);
    const Parts open = this->open(light);
    const Parts parts = axes.count == Count::ZpassCap ? open | Part::NearCap : open;
    for (int i = 0; i < volumes; ++i) {
        if (axes.count == Count::Zfail) {
            countZfailByBlending(light, i, write);
            continue;
        }
        for (const Faces faces : {Faces::Front, Faces::Back}) {
            const bool doubles = (faces == Faces::Front) != halves;
            Pass& p = volume(light, i, faces, parts, Compare::Lequal, doubles ? "double" : "halve");
            p.blend = doubles ? blending(DstColor, One) : blending(DstColor, Zero);
            p.colour = glm::vec4(doubles ? 1.0f : kHalf);
            p.write = write;
        }
    }
}

/// Faces behind the surface, counted from infinity: back faces go in, front faces out. A chip that passes no
/// farther fragments counts all and takes the nearer ones back (hardware.md, section 1).
void PlanBuilder::countZfailByBlending(int light, int index, ColourWrite write) {
    const bool halves = axes.arithmetic == Arithmetic::Halve;
    const bool nearerOnly = passesNearerOnly();
    const auto pass = [&](Faces faces, Parts parts, Compare function, bool enters, const std::string& which) {
        const bool doubles = enters != halves;
        Pass& p = volume(light, index, faces, parts, function, (doubles ? "double" : "halve") + which);
        p.blend = doubles ? blending(DstColor, One) : blending(DstColor, Zero);
        p.colour = glm::vec4(doubles ? 1.0f : kHalf);
        p.write = write;
    };
    const Parts open = this->open(light);
    for (const Faces faces : {Faces::Back, Faces::Front}) {
        const bool enters = faces == Faces::Back;
        for (const bool cap : {false, true}) {
            const Parts parts = cap ? Parts(Part::LightCap) : open;
            if (nearerOnly) {
                pass(faces, parts, Compare::Always, enters, ", all");
                pass(faces, parts, cap ? Compare::Less : Compare::Lequal, !enters, " back what is nearer");
            } else {
                pass(faces, parts, cap ? Compare::Gequal : Compare::Greater, enters, " behind the surface");
            }
        }
    }
}

bool PlanBuilder::passesNearerOnly() const {
    const auto& functions = m_profile.depthFunctions;
    const bool farther = functions.contains(Compare::Greater) && functions.contains(Compare::Gequal);
    return !farther && functions.contains(Compare::Always);
}

void PlanBuilder::normaliseCount(const MaskRectangle& rect, ColourWrite write) {
    if (axes.start == Start::Middle)
        rect("take the start away: lit to 0",
             {.enabled = true, .source = One, .destination = One, .equation = BlendEquation::ReverseSubtract},
             maskStart());
    const auto doublingsOf = [&](int bits) { return countDoublings(m_profile, bits); };
    const ColourFormat& f = format();
    const int doublings = write.alpha
                              ? doublingsOf(m_profile.alphaBits)
                              : std::max({doublingsOf(f.red), doublingsOf(f.green), doublingsOf(f.blue)});
    for (int i = 0; i < doublings; ++i)
        rect(i + 1 < doublings ? "double: lit stays 0" : "double: shadows are at 1", blending(DstColor, One),
             1);
    rect("invert: lit to 1, shadows to 0", blending(OneMinusDstColor, Zero), 1);
    if (axes.shade == Shade::Attenuated)
        rect("add 1/2: lit clamps at 1, shadows to 1/2", blending(One, One), kHalf);
}

void PlanBuilder::normalise(int light, ColourWrite write) {
    if (axes.arithmetic == Arithmetic::Count) m_plan.smallestMaskBits = 2;
    if (shadowAlpha().enabled) return;
    const auto rect = [&](const std::string& label, const Blend& how, float value) {
        if (!canShadow(light)) return;  // finished as it starts
        rectangle(label, how, value, write).target = axes.maskDivisor != 1 ? Target::Mask : Target::Window;
        boundLast(light);
    };
    const bool attenuated = axes.shade == Shade::Attenuated;
    if (axes.arithmetic == Arithmetic::Count) {
        normaliseCount(rect, write);
    } else if (axes.arithmetic == Arithmetic::Parity) {
        // Lit is 1 and a shadow 0 as it stands.
        if (attenuated) {
            rect("halve: lit to 1/2", blending(DstColor, Zero), kHalf);
            rect("add 1/2: lit to 1, shadows to 1/2", blending(One, One), kHalf);
        }
    } else if (axes.arithmetic == Arithmetic::Halve && attenuated) {
        rect("raise shadows to 1/2", {.enabled = true, .equation = BlendEquation::Max}, kHalf);
    } else {
        // From 2^-levels to 1/2 for a lit pixel; halving started at 1 and leaves shadows at 1/2 or below,
        // so that inverting comes first there.
        const bool halve = axes.arithmetic == Arithmetic::Halve;
        if (!halve)
            for (int i = 1; i < axes.levels; ++i)
                rect("double: lit to 1/2, shadows clamp at 1", blending(DstColor, One), 1);
        if (halve) {
            rect("invert: lit to 0, shadows to 1/2 or more", blending(OneMinusDstColor, Zero), 1);
            rect("double: shadows to 1", blending(DstColor, One), 1);
        }
        rect("invert: shadows to 0", blending(OneMinusDstColor, Zero), 1);
        if (!halve && attenuated) rect("add 1/2: lit to 1, shadows to 1/2", blending(One, One), kHalf);
        if (!halve && !attenuated) rect("double: lit to 1", blending(DstColor, One), 1);
    }
    if (axes.apply != Apply::Texture) tap(light, write.alpha ? MaskPlace::Alpha : MaskPlace::Colour);
    if (axes.arithmetic == Arithmetic::Count) return;
    m_plan.smallestMaskBits = axes.arithmetic == Arithmetic::Double ? axes.levels : 1;
}

float PlanBuilder::maskStart() const {
    if (axes.arithmetic == Arithmetic::Count) return axes.start == Start::Middle ? kHalf : 0;
    return axes.arithmetic == Arithmetic::Double ? std::ldexp(1.0f, -axes.levels) : 1.0f;
}

void PlanBuilder::copyMask() {
    const bool alpha = axes.store == Store::Alpha;
    const bool multiplies = m_profile.allowsBlend(Zero, SrcColor);
    const bool tests = shadowAlpha().enabled;
    m_texture = alpha ? MaskTexture::Alpha : multiplies && !tests ? MaskTexture::Rgb : MaskTexture::Intensity;
    m_plan.textureWidth = textureSide(m_plan.maskWidth);
    m_plan.textureHeight = textureSide(m_plan.maskHeight);
    Pass& pass =
        add(PassKind::Copy, fmt::format("mask of {}x{} to a texture of {}x{}", m_plan.maskWidth,
                                        m_plan.maskHeight, m_plan.textureWidth, m_plan.textureHeight));
    pass.texture = m_texture;
    pass.nearest = tests;  // between two counts lies no third
}

std::optional<Blend> PlanBuilder::shadowBlend() const {
    const bool attenuated = axes.shade == Shade::Attenuated;
    const auto allowed = [&](const Blend& how) -> std::optional<Blend> {
        if (how.enabled && !m_profile.allowsBlend(how.source, how.destination)) return std::nullopt;
        return how;
    };
    // A texture of alpha leaves the colour of the rectangle alone; one of intensities doesn't.
    if (axes.store == Store::Alpha) return allowed(attenuated ? blending(Zero, SrcColor) : Blend{});
    if (!attenuated) return allowed(blending(Zero, Zero));
    for (const BlendFactor factor : {ConstantAlpha, ConstantColor}) {
        Blend how = blending(Zero, factor);
        how.constant = kHalf;
        if (allowed(how)) return how;
    }
    return std::nullopt;
}

AlphaTest PlanBuilder::shadowAlpha() const {
    if (axes.arithmetic != Arithmetic::Count || axes.apply != Apply::Texture || !shadowBlend()) return {};
    const auto test = [&](Compare function, float reference) {
        const bool has = m_profile.alphaFunctions.contains(function);
        return has ? AlphaTest{true, function, reference} : AlphaTest{};
    };
    if (axes.start == Start::Middle) {
        // Above what fewer bits make of the middle, below one step more, whether they read back with low bits
        // of zero or repeated.
        const int bits = axes.store == Store::Alpha ? m_profile.alphaBits : format().red;
        return test(Compare::Greater, (128 + 0.75f * float(1 << (8 - bits))) / 255);
    }
    const AlphaTest unequal = test(Compare::Notequal, 0);
    return unequal.enabled ? unequal : test(Compare::Greater, 0);
}

void PlanBuilder::applyTexture(int light) {
    if (const AlphaTest test = shadowAlpha(); test.enabled) {
        const bool attenuated = axes.shade == Shade::Attenuated;
        Pass& pass = rectangle(fmt::format("{} where the texture's count is not that of the start",
                                           attenuated ? "attenuate" : "black"),
                               *shadowBlend(), attenuated ? kHalf : 0, kWriteColour);
        pass.texture = m_texture;
        pass.alphaTest = test;
        tap(light, MaskPlace::Texture);
        m_plan.masks.back().alphaTest = test;
        return;
    }
    const Blend how = m_texture == MaskTexture::Rgb ? blending(Zero, SrcColor) : blending(Zero, SrcAlpha);
    rectangle("mask texture times the scene", how, 1, kWriteColour).texture = m_texture;
    tap(light, MaskPlace::Texture);
}

}  // namespace gnomon
