#pragma once

#include "gl/table.h"
#include "plan/plan.h"

namespace gnomon {

/// The part of the window outside of which a mask that stands in the buffer's lower left corner, once copied
/// to a texture that is stretched over the window with bilinear filtering, holds one: the scene times one is
/// the scene. Empty if it holds one everywhere.
///
/// Reads the mask back: for a driver whose frame buffer lies in the host's memory.
WindowRect darkenedPart(const GlTable& gl, const Plan& plan, MaskTexture texture);

/// Whether @p pass multiplies what it is drawn over by the mask's texture, and does nothing else.
bool multipliesByMask(const Pass& pass);

}  // namespace gnomon
