#pragma once

#include <cstdint>
#include <vector>

#include "gl/pass_runner.h"
#include "gl/surface.h"
#include "plan/plan.h"

namespace gnomon {

/// A mask by pixel of the window, rows from the top: as Rendered::values.
using MaskValues = std::vector<std::uint16_t>;

/// The mask at @p tap, with what stands for pixels that the plan draws none for. The frame stands as before;
/// its state is resetState()'s where the mask is a texture.
/// @pre a plan that leaves out some pixels but not all has a mask as large as the window
MaskValues readMask(Surface& surface, const Plan& plan, const MaskTap& tap, PassRunner& runner);

}  // namespace gnomon
