#pragma once

#include "method/method.h"
#include "profile/shipped.h"
#include "report/listings.h"

namespace gnomon {

/// The plan of one light and three volumes, of which the last reaches nothing that is seen; bounded to the
/// others. With notes as a frame gives them, and a full plan that touches twice as much.
inline PlanSheet explainedSheet(const std::string& method, Shade shade = Shade::Attenuated) {
    Axes axes = findMethod(method)->axes;
    axes.shade = shade;
    PlanSheet s{.method = method, .shade = name(shade), .profile = "ideal", .scene = "boxes", .frame = 7};
    PlanNotes notes;
    notes.full = planFrame(axes, {320, 240, {{.volumes = 3}}}, chip("ideal"));
    s.plan = notes.full;
    s.plan.windows = {{.all = {60, 40, 183, 122}, .volumes = {{60, 40, 90, 80}, {100, 80, 143, 82}, {}}}};
    for (Pass& pass : s.plan.passes) {
        if (pass.kind == PassKind::Volume) pass.extent = Extent::Volumes;
        if (pass.kind == PassKind::Rectangle && pass.target == Target::Window && !pass.frameTexture)
            pass.extent = Extent::Shadows;
        notes.amounts.push_back({{.volume = 100}, 30});
    }
    notes.fullAmount = {{.volume = 200 * std::int64_t(s.plan.passes.size())}, 1234};
    notes.effects = {
        {Effect::Volumes, 0, false, false, "1 of 3 volumes holds no point that is seen"},
        {Effect::NearCaps, 0, false, false, "nearest volume is 1.21 units from the near rectangle"},
        {Effect::FarCaps, 0, true, false, "the background is seen in 41 blocks inside of volumes"},
        {Effect::Levels, 0, true, true, "volumes nest up to 1 deep; 2 levels are drawn"},
        {Effect::Ambient, -1, true, false, "ambient 0.2 of the reflectance"},
    };
    s.notes = std::move(notes);
    return s;
}

}  // namespace gnomon
