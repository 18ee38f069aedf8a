#pragma once

#include <optional>
#include <string>

#include "gl/table.h"
#include "profile/profile.h"

namespace gnomon {

/// What OpenGL has no enumerant for: a sum that wraps, and NV2A's signed sums. Only the chip emulation knows
/// it; no driver gets to see it. From the range that no extension uses.
constexpr GLenum GL_FUNC_ADD_WRAP = 0x6f01, GL_FUNC_SIGNED_ADD = 0x6f02,
                 GL_FUNC_SIGNED_REVERSE_SUBTRACT = 0x6f03;

/// OpenGL's enumerants for the words of profiles and plans, and back; nothing for an enumerant that has no
/// word.
GLenum glEnum(BlendFactor);
GLenum glEnum(BlendEquation);
GLenum glEnum(Compare);
GLenum glEnum(StencilOp);
std::optional<BlendFactor> blendFactorOf(GLenum);
std::optional<BlendEquation> blendEquationOf(GLenum);
std::optional<Compare> compareOf(GLenum);
std::optional<StencilOp> stencilOpOf(GLenum);

/// "GL_STENCIL_TEST", or the number in hexadecimal.
std::string enumName(GLenum value);

}  // namespace gnomon
