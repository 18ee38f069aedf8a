#include "predict/mask_run.h"

#include <algorithm>

namespace gnomon {
namespace {

bool wrapsUp(const StencilSide& side) {
    return side.onPass == StencilOp::IncrWrap || side.onDepthFail == StencilOp::IncrWrap;
}

}  // namespace

bool writesMask(const Pass& pass, MaskPlace place) {
    switch (place) {
        case MaskPlace::Stencil:
            return pass.kind == PassKind::Clear ? pass.clearsStencil : pass.stencil.enabled;
        case MaskPlace::Alpha:
            return pass.write.alpha;
        default:
            return pass.write.red;
    }
}

MaskRun runOf(const Plan& plan, const MaskTap& tap) {
    MaskRun run{.last = tap.after, .place = tap.place};
    if (tap.place == MaskPlace::Texture) {
        // It is finished where it is copied.
        std::size_t copy = tap.after;
        while (copy > 0 &&
               (plan.passes[copy - 1].kind != PassKind::Copy || plan.passes[copy - 1].frameTexture))
            --copy;
        run.last = copy == 0 ? 0 : copy - 1;
        run.place =
            plan.passes[run.last].texture == MaskTexture::Alpha ? MaskPlace::Alpha : MaskPlace::Colour;
    }
    const auto starts = [&](const Pass& pass) {
        return pass.kind == PassKind::Clear && writesMask(pass, run.place) &&
               (run.place != MaskPlace::Stencil || (pass.stencil.writeMask & 0xffu) == 0xffu);
    };
    const auto clearBefore = [&](std::size_t pass) {
        while (pass > 0 && !starts(plan.passes[pass - 1])) --pass;
        return pass > 0 ? pass - 1 : 0;
    };
    run.first = run.start = clearBefore(run.last);
    // What a bounded clear leaves was cleared before, if it is asked for.
    while (tap.outside < 0 && run.first > 0 && plan.passes[run.first].extent != Extent::Whole)
        run.first = clearBefore(run.first);
    return run;
}

bool wrapsIn(const Plan& plan, const MaskRun& run) {
    const auto at = [&](std::size_t pass) { return plan.passes.begin() + std::ptrdiff_t(pass); };
    return std::any_of(at(run.first), at(run.last), [](const Pass& pass) {
        return pass.kind == PassKind::Volume &&
               (wrapsUp(pass.stencil.front) || wrapsUp(pass.stencil.back) ||
                pass.program == Program::CountFaces ||
                (pass.blend.enabled && pass.blend.equation == BlendEquation::AddWrap));
    });
}

}  // namespace gnomon
