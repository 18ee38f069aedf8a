#pragma once

#include <optional>
#include <string>

#include "gl/emulated_draw.h"

namespace gnomon {

// How the emulated chip reads and writes its frame buffer, as GLSL expressions of ints: c0 to c3 are the
// codes that are stored, cell is the dither cell at the pixel. The functions of profile/frame_channel.h are
// the definition.

/// Whether dithering changes what channel @p c stores.
bool dithersChannel(const EmulatedDraw& state, int c);

/// The dither cell of @p mode at the pixel in row (from the top of the window) and column.
std::string cellText(DitherMode mode);

/// The value of 8 bits that the blend unit reads for the code of channel @p c.
std::string readBackText(const EmulatedDraw& state, int c);

/// The code that channel @p c stores for a value of 8 bits, or for the sum before its clamp.
/// @throws std::runtime_error  a sum that wraps, at Fidelity::Gl, of anything but one and one
std::string storedText(const EmulatedDraw& state, int c, const std::string& sum);

/// What the draw makes of channel @p c as a short expression of its code, if there is one that is equal for
/// all codes: of draws in one known colour, without dithering.
std::optional<std::string> shortForm(const EmulatedDraw& state, int c);

}  // namespace gnomon
