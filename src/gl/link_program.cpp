#include "gl/link_program.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace gnomon {
namespace {

using GetParameter = std::function<void(GLuint, GLenum, GLint*)>;
using GetLog = std::function<void(GLuint, GLsizei, GLsizei*, GLchar*)>;

void check(const GetParameter& get, const GetLog& log, GLuint object, GLenum what, const char* name) {
    GLint ok = 0;
    get(object, what, &ok);
    if (ok) return;
    std::array<char, 2000> text{};
    log(object, GLsizei(text.size()), nullptr, text.data());
    throw std::runtime_error(fmt::format("program {}: {}", name, text.data()));
}

}  // namespace

GLuint linkProgram(const GlTable& gl, const char* name, std::span<const ShaderStage> stages) {
    const GLuint program = gl.CreateProgram();
    for (const ShaderStage& stage : stages) {
        const GLuint shader = gl.CreateShader(stage.type);
        gl.ShaderSource(shader, 1, &stage.source, nullptr);
        gl.CompileShader(shader);
        check(gl.GetShaderiv, gl.GetShaderInfoLog, shader, GL_COMPILE_STATUS, name);
        gl.AttachShader(program, shader);
        gl.DeleteShader(shader);
    }
    gl.LinkProgram(program);
    check(gl.GetProgramiv, gl.GetProgramInfoLog, program, GL_LINK_STATUS, name);
    return program;
}

}  // namespace gnomon
