#include "matrix/minimal_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "gl/blend_program.h"

namespace gnomon {
namespace {

int brightestOf(const std::vector<VertexColour>& shades) {
    int most = 0;
    for (const VertexColour& c : shades) most = std::max({most, int(c.r), int(c.g), int(c.b)});
    return most;
}

}  // namespace

void MinimalPlanner::select() {
    if (m_predictor) m_predictor->select(m_frame.view());
    if (m_needs) m_needs->select(m_frame.view());
}

FramePredictor& MinimalPlanner::predictor() {
    if (!m_predictor) {
        m_predictor.emplace(m_frame.scene());
        m_predictor->select(m_frame.view());
    }
    return *m_predictor;
}

NeedsFinder& MinimalPlanner::needsFinder() {
    if (!m_needs) {
        m_needs.emplace(m_frame.scene());
        m_needs->select(m_frame.view());
    }
    return *m_needs;
}

/// What the frame calls for of what @p axes draw.
FrameNeeds MinimalPlanner::needsOf(const On& on, const Axes& axes) {
    const bool hasVolumes =
        axes.store != Store::None && axes.store != Store::DepthMap && axes.count != Count::AtomicZp;
    FrameNeeds all;
    for (int i = 0; i < m_frame.lights(); ++i) {
        LightNeeds one;
        if (hasVolumes) {
            const Nesting full = m_frame.nestingOf(axes, i);
            one = needsFinder().volumes(
                {.light = i,
                 .axes = axes,
                 .depthBits = on.format.depth,
                 .depth = on.chip.depth,
                 .lit = m_frame.litOf(i, axes.silhouette, axes.capFaces),
                 .drawn = m_frame.volumesOf(i, m_frame.volumeKey(on.profile, axes, i))->ordinals,
                 .full = full});
        }
        one.brightest = brightestOf(m_frame.coloursOf(i)->diffuse);
        all.lights.push_back(std::move(one));
    }
    all.brightestAmbient = brightestOf(m_frame.surfacesOf().ambient);
    all.nearestSurface = needsFinder().nearestSurface();
    return all;
}

/// Calls @p use with what is predicted of a channel of the mask of light @p index, as @p drawing makes it.
template <class Use>
auto MinimalPlanner::withPlanned(const On& on, const Drawing& drawing, int index, int colour,
                                 const Use& use) {
    const auto drawn = drawing.axes.count == Count::AtomicZp
                           ? std::make_shared<const FrameVolumes>()
                           : drawnVolumes(m_frame, on.profile, drawing, index);
    return use(PlannedMask{.plan = drawing.plan,
                           .axes = drawing.axes,
                           .format = on.format,
                           .chip = on.chip,
                           .light = index,
                           .ordinals = drawn->ordinals,
                           .leavesOut = !drawing.isFull,
                           .colour = colour});
}

int MinimalPlanner::wrongPixels(const Profile& profile, const Drawing& drawing,
                                const FidelityChoice& fidelity) {
    const On on = onOf(profile, fidelity);
    int wrong = 0;
    for (const MaskTap& tap : drawing.plan.masks)
        wrong += withPlanned(on, drawing, tap.light, 0, [&](const PlannedMask& mask) {
            const auto truth =
                m_frame.truthOf(tap.light, on.format.depth, on.chip.depth, drawing.axes.silhouette);
            return predictor().wrongPixels(mask, *truth);
        });
    return wrong;
}

/// Whether exact arithmetic has the same masks by both.
bool MinimalPlanner::areSame(const On& on, const Drawing& a, const Drawing& b) {
    const auto areSameIn = [&](int light, int colour) {
        return withPlanned(on, a, light, colour, [&](const PlannedMask& first) {
            return withPlanned(on, b, light, colour,
                               [&](const PlannedMask& second) { return predictor().areSame(first, second); });
        });
    };
    const int channels = a.axes.store == Store::Screen ? 3 : 1;
    for (const MaskTap& tap : b.plan.masks)
        for (int colour = 0; colour < channels; ++colour)
            if (!areSameIn(tap.light, colour)) return false;
    return true;
}

std::int64_t MinimalPlanner::touched(const Profile& profile, const MinimalPlan& plan) {
    return sumOf(amountsOf(m_frame, profile, drawingOf(plan))).pixels.total();
}

/// Where a mask may lose entries or exits, or keep a residue of them, exact arithmetic decides whether what
/// is left out changes anything.
MinimalPlan MinimalPlanner::leastPlan(const On& on, const Axes& axes, const Effects& wanted) {
    const FrameShape shape = m_frame.frameShape(on.profile, axes);
    const MaskChannel channel = maskChannel(on.format, on.chip, axes);
    const auto planned = [&](const FrameNeeds& needs) {
        return minimalPlan(axes, shape, on.profile, needs, channel, wanted);
    };
    FrameNeeds needs = needsOf(on, axes);
    if (!mayLoseCounts(axes, shape, on.profile, needs, channel)) return planned(needs);
    for (LightNeeds& light : needs.lights) light.losesNothing = true;
    MinimalPlan least = planned(needs);
    if (areSame(on, {.axes = axes, .plan = planFrame(axes, shape, on.profile)}, drawingOf(least)))
        return least;
    for (LightNeeds& light : needs.lights) light.losesNothing = false;
    return planned(needs);
}

MinimalPlan MinimalPlanner::plan(const Profile& profile, const Axes& axes, const FidelityChoice& fidelity,
                                 const Effects& wanted) {
    const On on = onOf(profile, fidelity);
    MinimalPlan least = leastPlan(on, axes, wanted);
    if (axes.count == Count::Zfail && least.axes.count == Count::ZpassCap) {
        // Caps at the near plane fill the window where it lies in a volume.
        Effects zfail = wanted;
        zfail.add(Effect::NearCaps);
        MinimalPlan other = leastPlan(on, axes, zfail);
        if (touched(profile, other) < touched(profile, least)) {
            least = std::move(other);
            for (EffectNote& note : least.notes) {
                if (note.effect != Effect::NearCaps) continue;
                note.isAsked = false;
                note.fact += "; z-fail touches fewer pixels there than z-pass with near caps";
            }
        }
    }
    if (fidelity.fidelity != Fidelity::Chip) return least;
    const auto depends = [&](const Pass& pass) { return dependsOnChip(on.format, on.chip, pass); };
    const auto& passes = least.plan.passes;
    const auto count = std::size_t(std::count_if(passes.begin(), passes.end(), depends));
    const bool isAsked = wanted.has(Effect::Emulation) && count < passes.size();
    least.notes.push_back(
        {.effect = Effect::Emulation,
         .isDrawn = isAsked || count == passes.size(),
         .isAsked = isAsked,
         .fact = fmt::format("{} of {} passes can depend on the chip's rounding, dither or depth format",
                             count, passes.size())});
    return least;
}

}  // namespace gnomon
