#pragma once

#include <string>

#include "gl/emulated_draw.h"

namespace gnomon {

/// What the chip's blend unit makes of channel @p c, before its clamp or wrap: a GLSL expression of ints of 8
/// bits, s0 to s3 of the source, d0 to d3 of the destination as it is read back, k0 to k3 of the blend
/// colour. blend() in profile/blend.h is the definition.
/// @throws std::runtime_error  the blend unit has no such setting
std::string blendText(const EmulatedDraw& state, int c);

/// Refuses the factors of the draw under the equation @p what.
/// @throws std::runtime_error  always
[[noreturn]] void refuseSetting(const EmulatedDraw& state, int c, const char* what);

}  // namespace gnomon
