#pragma once

#include <cstddef>

#include "plan/plan.h"

namespace gnomon {

/// The passes that make one mask.
struct MaskRun {
    std::size_t first = 0, last = 0;  ///< of the plan's passes
    std::size_t start =
        0;  ///< the clear from which volumes count; first, unless it clears a part of the mask
    MaskPlace place = MaskPlace::None;  ///< Stencil, Counter, Colour or Alpha
};

/// Whether @p pass may change what stands at @p place.
bool writesMask(const Pass& pass, MaskPlace place);

MaskRun runOf(const Plan& plan, const MaskTap& tap);

/// Whether the passes count up and down in steps that wrap.
bool wrapsIn(const Plan& plan, const MaskRun& run);

}  // namespace gnomon
