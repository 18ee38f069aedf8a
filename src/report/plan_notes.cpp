#include "report/plan_notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "report/table.h"

namespace gnomon {
namespace {

/// The fact behind @p effect where the plan has it, for @p light or the frame; "" without a note.
std::string factFor(const std::vector<EffectNote>& effects, Effect effect, int light) {
    for (const EffectNote& note : effects) {
        if (note.effect != effect || !note.isDrawn || (note.light != -1 && note.light != light)) continue;
        return note.isAsked ? fmt::format("--effects asks for it; {}", note.fact) : note.fact;
    }
    return {};
}

/// @p reason with the fact behind @p effect, if there is one.
std::string with(const std::string& reason, const std::vector<EffectNote>& effects, Effect effect,
                 int light) {
    const std::string fact = factFor(effects, effect, light);
    return fact.empty() ? reason : fmt::format("{}; {}: {}", reason, name(effect), fact);
}

/// The mask window of the pass's light, if it is bounded.
const MaskWindow* windowOf(const Plan& plan, const Pass& pass) {
    const bool bounded = pass.extent != Extent::Whole && std::size_t(pass.light) < plan.windows.size();
    return bounded ? &plan.windows[std::size_t(pass.light)] : nullptr;
}

std::string whereShadowsAre(const Plan& plan, const Pass& pass) {
    const MaskWindow* window = windowOf(plan, pass);
    return window ? fmt::format(", and there is none but in {}", rectText(window->all)) : std::string();
}

std::string clearReason(const Plan& plan, const Pass& pass) {
    if (pass.target == Target::DepthMap) return "the map is empty before the casters";
    if (pass.clearsToBackground)
        return fmt::format("the background shows where no surface is{}{}",
                           pass.clearsDepth ? "; depth starts behind all surfaces" : "",
                           pass.clearsStencil ? "; the count starts" : "");
    const char* what = pass.stencilIsBlockers ? "the count starts from what hides the eye"
                       : pass.clearsStencil   ? "the count starts"
                                              : "the mask starts as lit";
    return fmt::format("{}{}", what, whereShadowsAre(plan, pass));
}

std::string sceneReason(const Plan& plan, const Pass& pass, const std::vector<EffectNote>& effects) {
    if (pass.target == Target::DepthMap) return "the map holds what the light sees of the casters";
    if (!pass.write.any()) return "volumes are counted against the depth of what is seen";
    switch (pass.shading) {
        case Shading::Ambient:
            if (pass.depthWrite) return "every surface that is seen, and its depth";
            return with("no shadow takes the ambient part", effects, Effect::Ambient, pass.light);
        case Shading::Mask:
            return "each point that is seen is compared with the map";
        case Shading::HalfDiffuse:
            return with("a shadow keeps half of the light", effects, Effect::Lights, pass.light);
        case Shading::RestDiffuse:
            return "where the count says lit the other half arrives too";
        default:
            break;
    }
    if (pass.depthWrite)
        return with("every surface that is seen, and its depth", effects, Effect::Lights, pass.light);
    const MaskWindow* window = windowOf(plan, pass);
    const std::string where =
        window ? fmt::format("; outside of {} nothing is in shadow", rectText(window->all)) : "";
    return with(fmt::format("the light arrives where the mask is lit{}", where), effects, Effect::Lights,
                pass.light);
}

/// How many volumes the pass draws, and where.
std::string reachText(const Plan& plan, const Pass& pass) {
    const MaskWindow* window = windowOf(plan, pass);
    if (!window) return pass.volume == kAllVolumes ? "all volumes, wherever they are" : "wherever it is";
    if (pass.volume != kAllVolumes && pass.extent == Extent::Volumes) {
        const WindowRect& rect = window->volumes[std::size_t(pass.volume)];
        return rect.empty() ? "it reaches nothing that is seen"
                            : fmt::format("it reaches what is seen in {}", rectText(rect));
    }
    const auto volumes = std::count_if(window->volumes.begin(), window->volumes.end(),
                                       [](const WindowRect& rect) { return !rect.empty(); });
    return fmt::format("{} {} what is seen, in {}", volumes,
                       volumes == 1 ? "volume reaches" : "volumes reach", rectText(window->all));
}

std::string volumeReason(const Plan& plan, const Pass& pass, const std::vector<EffectNote>& effects) {
    if (pass.drawn == Drawn::Blockers) return "the eye may be in a volume: what hides it from the light";
    std::string reason = reachText(plan, pass);
    if (pass.drawn == Drawn::Silhouettes) return reason;
    if (pass.parts.has(Part::NearCap) || pass.parts.has(Part::NearFaces) || pass.parts.has(Part::LightCap))
        reason = with(reason, effects, Effect::NearCaps, pass.light);
    if (pass.parts.has(Part::FarCap)) reason = with(reason, effects, Effect::FarCaps, pass.light);
    return reason;
}

std::string rectangleReason(const Plan& plan, std::size_t index, const std::vector<EffectNote>& effects) {
    const Pass& pass = plan.passes[index];
    if (pass.frameTexture) return "this light's part is drawn; those before it wait in a texture";
    if (pass.texture != MaskTexture::None) return "the scene is drawn; its mask waits in a texture";
    if (pass.stencil.enabled && pass.stencil.writeMask != ~0u)
        return "overlapping volumes would cancel: each is kept before the next";
    const auto tap =
        std::find_if(plan.masks.begin(), plan.masks.end(), [&](const MaskTap& t) { return t.after > index; });
    const bool isNormalising = tap != plan.masks.end() && !pass.stencil.enabled;
    if (!isNormalising) return fmt::format("shadows take the light away{}", whereShadowsAre(plan, pass));
    const std::string reason = fmt::format("the mask must come to one value for lit and one for a shadow{}",
                                           whereShadowsAre(plan, pass));
    const bool doubles = pass.blend.enabled && pass.blend.source == BlendFactor::DstColor &&
                         pass.blend.destination == BlendFactor::One;
    return doubles ? with(reason, effects, Effect::Levels, tap->light) : reason;
}

/// "light 2: " for a note on one of several lights.
std::string lightText(const EffectNote& note, bool severalLights) {
    return note.light >= 0 && severalLights ? fmt::format("light {}: ", note.light) : "";
}

/// The effects of which @p wanted is true, one per line under a head.
template <class Wanted>
std::string sectionText(const char* head, const std::vector<EffectNote>& effects, std::size_t width,
                        const Wanted& wanted) {
    const bool severalLights =
        std::any_of(effects.begin(), effects.end(), [](const EffectNote& note) { return note.light > 0; });
    std::string text;
    for (const EffectNote& note : effects)
        if (wanted(note))
            text += fmt::format(
                "  {:<11}{}\n", name(note.effect),
                wrapText(fmt::format("{}{}", lightText(note, severalLights), note.fact), 13, width));
    return text.empty() ? text : fmt::format("\n{}\n{}", head, text);
}

}  // namespace

std::string rectText(const WindowRect& rect) {
    return rect.empty() ? "no pixel" : fmt::format("{}x{} at {},{}", rect.width, rect.height, rect.x, rect.y);
}

std::string ratioText(std::int64_t part, std::int64_t whole) {
    return whole == 0 ? "-" : fmt::format("{:.2f}", double(part) / double(whole));
}

std::string reasonFor(const Plan& plan, std::size_t index, const std::vector<EffectNote>& effects) {
    const Pass& pass = plan.passes[index];
    switch (pass.kind) {
        case PassKind::Clear:
            return clearReason(plan, pass);
        case PassKind::Scene:
            return sceneReason(plan, pass, effects);
        case PassKind::Volume:
            return volumeReason(plan, pass, effects);
        case PassKind::Rectangle:
            return rectangleReason(plan, index, effects);
        case PassKind::Copy:
            return pass.frameTexture ? "the next light's mask needs the buffer"
                                     : "the scene is to be drawn where the mask stands";
    }
    return {};
}

std::string effectsText(const std::vector<EffectNote>& effects, std::size_t width) {
    std::string text;
    text += sectionText("Left out", effects, width, [](const EffectNote& n) { return !n.isDrawn; });
    text += sectionText("Called for by the frame", effects, width,
                        [](const EffectNote& n) { return n.isDrawn && !n.isAsked; });
    text += sectionText("Kept though nothing calls for it, as --effects says", effects, width,
                        [](const EffectNote& n) { return n.isDrawn && n.isAsked; });
    return text;
}

std::string notesText(const Plan& plan, const PlanNotes& notes, std::size_t width) {
    std::string text;
    if (!notes.drawnAs.empty()) text += fmt::format("\nDrawn as {}\n", notes.drawnAs);
    text += effectsText(notes.effects, width);

    const PassCounts mine = countPasses(plan), full = countPasses(notes.full);
    const DrawnAmount amount = sumOf(notes.amounts);
    const TouchedPixels &p = amount.pixels, &q = notes.fullAmount.pixels;
    std::vector<std::vector<std::string>> rows{{"", "minimal", "full", "ratio"}};
    const auto row = [&](const char* what, std::int64_t part, std::int64_t whole) {
        if (part == 0 && whole == 0) return;
        rows.push_back({what, fmt::format("{}", part), fmt::format("{}", whole), ratioText(part, whole)});
    };
    row("scene passes", mine.scene, full.scene);
    row("volume passes", mine.volume, full.volume);
    row("rectangles", mine.rectangle, full.rectangle);
    row("copies", mine.copy, full.copy);
    row("vertices", amount.vertices, notes.fullAmount.vertices);
    row("touched pixels", p.total(), q.total());
    row("  of clears", p.clear, q.clear);
    row("  of the scene", p.scene, q.scene);
    row("  of volumes", p.volume, q.volume);
    row("  of rectangles", p.rectangle, q.rectangle);
    row("  of copies", p.copy, q.copy);
    text += fmt::format("\n{}", alignColumns(rows, width));
    if (notes.cost) text += fmt::format("\n{}", costText(*notes.cost, width));
    return text;
}

}  // namespace gnomon
