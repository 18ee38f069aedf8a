#pragma once

#include "plan/plan.h"

namespace gnomon {

/// @p plan with volumes that AtomicZP's geometry shader makes, which counts nothing beside them: so that
/// Z-pass and ++ZP are drawn as AtomicZP is, and compared like with like (Usta et al. 2019, section 4: all of
/// them extrude in a geometry shader). Sides, far caps and what lies between the eye and the near plane.
///
/// @pre a plan of Store::Stencil and Count::Zpass or Count::PlusPlusZp; the chip has geometry shaders
Plan withShaderVolumes(Plan plan);

}  // namespace gnomon
