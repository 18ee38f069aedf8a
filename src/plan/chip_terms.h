#pragma once

#include <string>

#include "plan/plan.h"

namespace gnomon {

/// The state of @p pass in the chip's own registers or calls, as its blend unit tells which chip it is:
/// "ALPHA A=Cd B=0 C=FIX D=Cd, FIX=0x80, COLCLAMP=1, FBMSK=0xFF000000, TEST ZTST=GEQUAL, ZMSK=1" on a
/// PlayStation 2. Only what makes a mask is said: blending, write masks, tests; and a scissor, of which the
/// words are known for PlayStation and PlayStation 2 alone (describeState() has it for all).
///
/// @param plan  that the pass is of; it may be left out where no pass is bounded
///
/// Empty for a clear, where the chip lacks something for the pass (missing() says what), for a stencil, and
/// for chips whose words are OpenGL's, or unknown.
///
/// Source: hardware.md, sections 2.1 and 2.4 (Glide), 2.5 (PS2TEK), 2.6 (ENVY), 2.9 (REFSW, KOS), 2.10
/// (ANGRY), 2.11 (PSXSPX), 2.12 (DOLPHIN), 2.14 (PPSSPP), 2.15 (86VIRGE).
std::string chipTerms(const Pass& pass, const Profile& profile, const Plan& plan = {});

}  // namespace gnomon
