#pragma once

#include "gl/chip_arithmetic.h"
#include "gl/pixel_words.h"
#include "gl/table.h"

namespace gnomon {

/// Whether a surface of these buffers needs emulate(): the chip's arithmetic is asked for, or OpenGL has no
/// such buffers.
bool needsEmulation(const BufferFormat& format, const ChipArithmetic& chip);

/// The entry points of @p driver with the chip's arithmetic under them: a decorator for fixed-function state
/// as the caller sets it. Pixels live in a frame buffer of its own as words (pixel_words.h); of 8888 the same
/// memory is an RGBA8 buffer too, and draws that OpenGL itself gets right (opaque ones; depth and stencil
/// alone) go there untouched. A draw that blends, inverts, or stores into fewer bits is done by a program
/// that reads the pixel and writes it back (blend_program.h), chosen from the state at the draw. A sum that
/// wraps (GL_FUNC_ADD_WRAP) is known here and by no driver.
///
/// Clears, read-backs and copies to textures see what the chip holds. The caller's own programs run on 8888
/// where they don't blend. Framebuffer 0 is the emulated one; others are passed on.
///
/// @pre the context is current, and stays the only one that the entry points are called in
/// @throws std::runtime_error  a channel has more than 8 bits, or the driver lacks
///                             GL_EXT_shader_framebuffer_fetch; from a draw: the blend unit has no such
///                             setting
GlTable emulate(const BufferFormat& format, const ChipArithmetic& chip, int width, int height,
                GlTable driver);

}  // namespace gnomon
