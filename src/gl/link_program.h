#pragma once

#include <span>

#include "gl/table.h"

namespace gnomon {

/// One shader of a program.
struct ShaderStage {
    GLenum type = 0;
    const char* source = nullptr;
};

/// Compiles and links @p stages.
/// @param name  for the message
/// @throws std::runtime_error  with OpenGL's log, if that fails
GLuint linkProgram(const GlTable& gl, const char* name, std::span<const ShaderStage> stages);

}  // namespace gnomon
