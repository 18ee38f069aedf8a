#pragma once

#include <optional>
#include <string>

#include "gl/emulated_draw.h"
#include "gl/pixel_words.h"
#include "plan/plan.h"

namespace gnomon {

/// The fragment program that does to a frame buffer of words (pixel_words.h) what the chip does: reads the
/// pixel by framebuffer fetch, and writes it back. The functions of profile/ are the definition; the program
/// has the same result for all inputs.
///
/// Uniforms: ivec4 constantSource, blendColour (8 bits per channel; the PS2's alphas with 1 at 128),
/// int alphaReference, sampler2D image.
/// @throws std::runtime_error  the blend unit has no such setting
std::string fragmentProgram(const EmulatedDraw& state);

/// What of @p pass the chip's blend unit can't do, in one phrase; nothing if it can, or if the pass doesn't
/// blend.
std::optional<std::string> blendUnitLacks(const BufferFormat& format, const ChipArithmetic& chip,
                                          const Pass& pass);

/// The vertex program that goes with it; empty: OpenGL's own.
std::string vertexProgram(const EmulatedDraw& state);

/// Whether OpenGL's own store of @p channels (bits) gives what the chip's would.
/// @param isOpenGls  the equation, if the draw blends
bool storesAsOpenGl(const BufferFormat& format, const ChipArithmetic& chip, DitherMode dither,
                    unsigned channels, bool blends, bool isOpenGls);

/// Whether what @p pass leaves can depend on the chip's rounding, dither or depth format, so that it is drawn
/// by a program at Fidelity::Chip.
bool dependsOnChip(const BufferFormat& format, const ChipArithmetic& chip, const Pass& pass);

/// Whether the chip's depth must be written by a program: OpenGL's buffer would store another.
bool storesOtherDepth(const BufferFormat& format, const ChipArithmetic& chip);

}  // namespace gnomon
