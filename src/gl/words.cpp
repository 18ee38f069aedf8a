#include "gl/words.h"

#include <fmt/format.h>

#include <array>

#include "profile/words.h"

namespace gnomon {
namespace {

constexpr std::array<GLenum, 15> kFactors{GL_ZERO,
                                          GL_ONE,
                                          GL_SRC_COLOR,
                                          GL_ONE_MINUS_SRC_COLOR,
                                          GL_DST_COLOR,
                                          GL_ONE_MINUS_DST_COLOR,
                                          GL_SRC_ALPHA,
                                          GL_ONE_MINUS_SRC_ALPHA,
                                          GL_DST_ALPHA,
                                          GL_ONE_MINUS_DST_ALPHA,
                                          GL_SRC_ALPHA_SATURATE,
                                          GL_CONSTANT_COLOR,
                                          GL_ONE_MINUS_CONSTANT_COLOR,
                                          GL_CONSTANT_ALPHA,
                                          GL_ONE_MINUS_CONSTANT_ALPHA};
constexpr std::array<GLenum, 8> kEquations{
    GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN,
    GL_MAX,      GL_FUNC_ADD_WRAP, GL_FUNC_SIGNED_ADD,       GL_FUNC_SIGNED_REVERSE_SUBTRACT};
constexpr std::array<GLenum, 8> kCompares{GL_NEVER,   GL_LESS,     GL_EQUAL,  GL_LEQUAL,
                                          GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
constexpr std::array<GLenum, 8> kStencilOps{GL_KEEP, GL_ZERO,   GL_REPLACE,   GL_INCR,
                                            GL_DECR, GL_INVERT, GL_INCR_WRAP, GL_DECR_WRAP};

template <class Word, std::size_t N>
std::optional<Word> find(const std::array<GLenum, N>& values, GLenum value) {
    for (std::size_t i = 0; i < N; ++i)
        if (values[i] == value) return Word(i);
    return std::nullopt;
}

}  // namespace

GLenum glEnum(BlendFactor v) {
    return kFactors[std::size_t(v)];
}
GLenum glEnum(BlendEquation v) {
    return kEquations[std::size_t(v)];
}
GLenum glEnum(Compare v) {
    return kCompares[std::size_t(v)];
}
GLenum glEnum(StencilOp v) {
    return kStencilOps[std::size_t(v)];
}
std::optional<BlendFactor> blendFactorOf(GLenum v) {
    return find<BlendFactor>(kFactors, v);
}
std::optional<BlendEquation> blendEquationOf(GLenum v) {
    return find<BlendEquation>(kEquations, v);
}
std::optional<Compare> compareOf(GLenum v) {
    // As OpenGL numbers them; asked at each call of a frame.
    static_assert(GL_ALWAYS - GL_NEVER == GLenum(Compare::Always));
    if (v < GL_NEVER || v > GL_ALWAYS) return std::nullopt;
    return Compare(v - GL_NEVER);
}
std::optional<StencilOp> stencilOpOf(GLenum v) {
    return find<StencilOp>(kStencilOps, v);
}

std::string enumName(GLenum value) {
    switch (value) {
        case GL_SCISSOR_TEST:
            return "GL_SCISSOR_TEST";
        case GL_DEPTH_TEST:
            return "GL_DEPTH_TEST";
        case GL_STENCIL_TEST:
            return "GL_STENCIL_TEST";
        case GL_ALPHA_TEST:
            return "GL_ALPHA_TEST";
        case GL_COLOR_LOGIC_OP:
            return "GL_COLOR_LOGIC_OP";
        case GL_STENCIL_BUFFER_BIT:
            return "GL_STENCIL_BUFFER_BIT";
        case GL_DEPTH_BUFFER_BIT:
            return "GL_DEPTH_BUFFER_BIT";
        case GL_TEXTURE_2D:
            return "GL_TEXTURE_2D";
        case GL_POLYGON_OFFSET_FILL:
            return "GL_POLYGON_OFFSET_FILL";
        case GL_DEPTH_CLAMP:
            return "GL_DEPTH_CLAMP";
        case GL_DEPTH_COMPONENT16:
            return "GL_DEPTH_COMPONENT16";
        case GL_DEPTH_COMPONENT24:
            return "GL_DEPTH_COMPONENT24";
        case GL_DEPTH_COMPONENT32:
            return "GL_DEPTH_COMPONENT32";
        case GL_FRONT:
            return "GL_FRONT";
        case GL_BACK:
            return "GL_BACK";
        case GL_FRONT_AND_BACK:
            return "GL_FRONT_AND_BACK";
        case GL_VERTEX_SHADER:
            return "GL_VERTEX_SHADER";
        case GL_FRAGMENT_SHADER:
            return "GL_FRAGMENT_SHADER";
        case GL_GEOMETRY_SHADER:
            return "GL_GEOMETRY_SHADER";
        default:
            break;
    }
    if (value >= GL_TEXTURE0 && value < GL_TEXTURE0 + 32)
        return fmt::format("GL_TEXTURE{}", value - GL_TEXTURE0);
    if (value >= GL_CLIP_PLANE0 && value < GL_CLIP_PLANE0 + 8)
        return fmt::format("GL_CLIP_PLANE{}", value - GL_CLIP_PLANE0);
    if (value > 1) {
        if (const auto word = compareOf(value)) return "GL_" + upperCase(name(*word));
        if (const auto word = stencilOpOf(value)) return "GL_" + upperCase(name(*word));
        if (const auto word = blendFactorOf(value)) return "GL_" + upperCase(name(*word));
        if (const auto word = blendEquationOf(value)) return "GL_" + upperCase(name(*word));
    }
    if (value == GL_ZERO) return "GL_ZERO";
    if (value == GL_ONE) return "GL_ONE";
    return fmt::format("0x{:04x}", value);
}

}  // namespace gnomon
