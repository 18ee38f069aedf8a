#pragma once

#include "gl/buffer_format.h"
#include "gl/table.h"

namespace gnomon {

/// The entry points of @p driver with a frame buffer object of renderbuffers in the place of frame buffer 0:
/// for contexts that have none. It is bound, and viewport and scissor are its size, as in a new context with
/// a window. Where the driver can (GL_MESA_framebuffer_flip_y), its rows stand in memory as those of a window
/// do, from the top: Mesa's rasterisers then give the same bits in both.
///
/// glDrawBuffer and glReadBuffer don't know the names of a window's buffers (GL_BACK) here.
///
/// @pre the context is current, and stays the only one that the entry points are called in
/// @throws std::runtime_error  OpenGL has no such renderbuffers, or the driver can't draw to them
GlTable withWindowObject(const BufferFormat& format, int width, int height, GlTable driver);

}  // namespace gnomon
