#pragma once

#include "plan/plan.h"

namespace gnomon {

/// Whether @p pass clears all of the mask of @p place.
inline bool startsMask(const Pass& pass, MaskPlace place) {
    if (pass.kind != PassKind::Clear) return false;
    return place == MaskPlace::Stencil ? pass.clearsStencil && pass.stencil.writeMask == ~0u
           : place == MaskPlace::Alpha ? pass.write.alpha
                                       : pass.write.red;
}

/// @p plan with its mask passes bounded to @p bounds; @p lit is what a lit pixel of the finished mask holds,
/// as 8 bits or as a stencil value.
inline Plan boundTo(Plan plan, const MaskWindow& bounds, double lit) {
    MaskTap& tap = plan.masks.front();
    std::size_t end = tap.after;
    MaskPlace place = tap.place;
    if (place == MaskPlace::Texture) {
        while (plan.passes[end - 1].kind != PassKind::Copy) --end;
        place = plan.passes[end - 1].texture == MaskTexture::Alpha ? MaskPlace::Alpha : MaskPlace::Colour;
    }
    std::size_t start = end;
    while (!startsMask(plan.passes[start - 1], place)) --start;
    for (std::size_t i = start; i < end; ++i) {
        Pass& pass = plan.passes[i];
        const bool isPlain = pass.kind == PassKind::Rectangle || pass.kind == PassKind::Clear;
        if (pass.kind == PassKind::Volume) pass.extent = Extent::Volumes;
        if (isPlain) pass.extent = Extent::Shadows;
    }
    Pass whole = plan.passes[start - 1];
    whole.colour = glm::vec4(float(lit / 255));
    whole.stencilValue = int(lit);
    plan.passes[start - 1].extent = Extent::Shadows;
    plan.passes.insert(plan.passes.begin() + std::ptrdiff_t(start - 1), whole);
    ++tap.after;
    plan.windows = {bounds};
    return plan;
}

}  // namespace gnomon
