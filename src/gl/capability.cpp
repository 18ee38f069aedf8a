#include "gl/capability.h"

#include <fmt/format.h>

#include <memory>
#include <set>

#include "gl/judge.h"
#include "gl/words.h"

namespace gnomon {

CapabilityViolation::CapabilityViolation(std::string call_, std::string argument_, std::string capability_,
                                         std::string source_)
    : std::runtime_error(
          fmt::format("{}({}): the chip lacks {} [{}]", call_, argument_, capability_, source_)),
      call(std::move(call_)),
      argument(std::move(argument_)),
      capability(std::move(capability_)),
      source(std::move(source_)) {}

namespace {

/// Internal formats that hold nothing but alpha: copied from a frame buffer they need destination alpha
/// there.
bool isAlphaOnly(GLenum format) {
    return format == GL_ALPHA || format == GL_ALPHA4 || format == GL_ALPHA8;
}

bool isDepth(GLenum format) {
    return format == GL_DEPTH_COMPONENT || format == GL_DEPTH_COMPONENT16 || format == GL_DEPTH_COMPONENT24 ||
           format == GL_DEPTH_COMPONENT32;
}

/// Which textures hold nothing but alpha, as far as they were specified through the layer.
class TextureFormats {
  public:
    void bind(GLuint texture) { m_bound = texture; }
    void specified(GLenum format) {
        isAlphaOnly(format) ? void(m_alphaOnly.insert(m_bound)) : void(m_alphaOnly.erase(m_bound));
    }
    bool boundIsAlphaOnly() const { return m_alphaOnly.contains(m_bound); }

  private:
    GLuint m_bound = 0;
    std::set<GLuint> m_alphaOnly{};
};

}  // namespace

GlTable restrictTo(const Profile& profile, const BufferFormat& buffers, GlTable next) {
    const auto judge = std::make_shared<const Judge>(profile, buffers);
    const auto state = std::make_shared<DrawState>();
    const auto textures = std::make_shared<TextureFormats>();
    const auto driver = std::make_shared<const GlTable>(std::move(next));
    GlTable gl = *driver;

    // Frame buffer
    gl.Clear = [=](GLbitfield mask) {
        if (mask & GL_STENCIL_BUFFER_BIT) judge->stencil("glClear", "GL_STENCIL_BUFFER_BIT");
        if (mask & GL_DEPTH_BUFFER_BIT)
            judge->need(judge->p.depth, "glClear", "GL_DEPTH_BUFFER_BIT", "depth_bits");
        if ((mask & GL_COLOR_BUFFER_BIT) && state->alpha) judge->alphaPlanes("glClear", "writing alpha");
        driver->Clear(mask);
    };
    gl.ClearStencil = [=](GLint value) {
        judge->stencil("glClearStencil", [=] { return fmt::format("{}", value); });
        driver->ClearStencil(value);
    };
    gl.ColorMask = [=](GLboolean r, GLboolean g, GLboolean b, GLboolean a) {
        judge->colourMask(r, g, b, a);
        state->red = r, state->green = g, state->blue = b, state->alpha = a;
        driver->ColorMask(r, g, b, a);
    };
    gl.Viewport = [=](GLint x, GLint y, GLsizei width, GLsizei height) {
        // A texture that is drawn to has limits of its own.
        if (!state->toTexture) judge->viewport(x, y, width, height);
        driver->Viewport(x, y, width, height);
    };

    // Tests
    gl.Enable = [=](GLenum what) {
        judge->enable(what);
        if (what == GL_BLEND) state->blend = true;
        if (what == GL_COLOR_LOGIC_OP) state->logicOp = true;
        if (what == GL_TEXTURE_2D) state->texture = true;
        driver->Enable(what);
    };
    gl.Disable = [=](GLenum what) {
        if (what == GL_BLEND) state->blend = false;
        if (what == GL_COLOR_LOGIC_OP) state->logicOp = false;
        if (what == GL_TEXTURE_2D) state->texture = false;
        driver->Disable(what);
    };
    gl.DepthFunc = [=](GLenum function) {
        judge->depthFunction(function);
        driver->DepthFunc(function);
    };
    gl.DepthMask = [=](GLboolean write) {
        judge->need(!write || judge->p.depth, "glDepthMask", "GL_TRUE", "depth_bits");
        driver->DepthMask(write);
    };
    gl.AlphaFunc = [=](GLenum function, GLfloat reference) {
        judge->alphaFunction(function);
        driver->AlphaFunc(function, reference);
    };
    gl.StencilFunc = [=](GLenum function, GLint reference, GLuint mask) {
        judge->stencil("glStencilFunc", function);
        driver->StencilFunc(function, reference, mask);
    };
    gl.StencilOp = [=](GLenum fail, GLenum depthFail, GLenum pass) {
        judge->stencil("glStencilOp", pass);
        judge->stencilOps("glStencilOp", {fail, depthFail, pass});
        driver->StencilOp(fail, depthFail, pass);
    };
    gl.StencilMask = [=](GLuint mask) {
        judge->stencil("glStencilMask", [=] { return fmt::format("0x{:x}", mask); });
        driver->StencilMask(mask);
    };
    gl.StencilFuncSeparate = [=](GLenum face, GLenum function, GLint reference, GLuint mask) {
        judge->oneSide("glStencilFuncSeparate", face);
        driver->StencilFuncSeparate(face, function, reference, mask);
    };
    gl.StencilOpSeparate = [=](GLenum face, GLenum fail, GLenum depthFail, GLenum pass) {
        judge->oneSide("glStencilOpSeparate", face);
        judge->stencilOps("glStencilOpSeparate", {fail, depthFail, pass});
        driver->StencilOpSeparate(face, fail, depthFail, pass);
    };
    gl.StencilMaskSeparate = [=](GLenum face, GLuint mask) {
        judge->oneSide("glStencilMaskSeparate", face);
        driver->StencilMaskSeparate(face, mask);
    };

    // Blending
    gl.BlendFunc = [=](GLenum source, GLenum destination) {
        judge->blendPair("glBlendFunc", source, destination);
        state->source = state->alphaSource = source;
        state->destination = state->alphaDestination = destination;
        driver->BlendFunc(source, destination);
    };
    gl.BlendFuncSeparate = [=](GLenum source, GLenum destination, GLenum alphaSource,
                               GLenum alphaDestination) {
        const bool same = source == alphaSource && destination == alphaDestination;
        judge->need(
            same || judge->p.separateAlphaFactors, "glBlendFuncSeparate",
            [=] {
                return fmt::format("{}, {}, {}, {}", enumName(source), enumName(destination),
                                   enumName(alphaSource), enumName(alphaDestination));
            },
            "separate_alpha_factors");
        judge->blendPair("glBlendFuncSeparate", source, destination);
        state->source = source, state->destination = destination;
        state->alphaSource = alphaSource, state->alphaDestination = alphaDestination;
        driver->BlendFuncSeparate(source, destination, alphaSource, alphaDestination);
    };
    gl.BlendEquation = [=](GLenum equation) {
        judge->blendEquation("glBlendEquation", equation);
        state->equation = equation;
        driver->BlendEquation(equation);
    };
    gl.BlendEquationSeparate = [=](GLenum colour, GLenum alpha) {
        judge->need(
            colour == alpha || judge->p.separateAlphaFactors, "glBlendEquationSeparate",
            [=] { return fmt::format("{}, {}", enumName(colour), enumName(alpha)); },
            "separate_alpha_factors");
        judge->blendEquation("glBlendEquationSeparate", colour);
        judge->blendEquation("glBlendEquationSeparate", alpha);
        state->equation = colour;
        driver->BlendEquationSeparate(colour, alpha);
    };
    gl.BlendColor = [=](GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
        judge->blendColour();
        driver->BlendColor(r, g, b, a);
    };
    gl.LogicOp = [=](GLenum operation) {
        judge->need(judge->p.logicOps, "glLogicOp", operation, "logic_ops");
        driver->LogicOp(operation);
    };

    // Geometry
    gl.PolygonOffset = [=](GLfloat factor, GLfloat units) {
        judge->need(
            factor == 0 || judge->p.polygonOffsetFactor, "glPolygonOffset",
            [=] { return fmt::format("factor {}", factor); }, "polygon_offset_factor");
        judge->need(
            units == 0 || judge->p.polygonOffsetUnits, "glPolygonOffset",
            [=] { return fmt::format("units {}", units); }, "polygon_offset_units");
        driver->PolygonOffset(factor, units);
    };
    gl.ClipPlane = [=](GLenum plane, const GLdouble* equation) {
        judge->need(int(plane - GL_CLIP_PLANE0) < judge->p.clipPlanes, "glClipPlane", plane, "clip_planes");
        driver->ClipPlane(plane, equation);
    };
    gl.Color4f = [=](GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
        state->colour = {r, g, b, a};
        driver->Color4f(r, g, b, a);
    };
    gl.EnableClientState = [=](GLenum array) {
        if (array == GL_COLOR_ARRAY) state->colourArray = true;
        driver->EnableClientState(array);
    };
    gl.DisableClientState = [=](GLenum array) {
        if (array == GL_COLOR_ARRAY) state->colourArray = false;
        driver->DisableClientState(array);
    };
    gl.DrawArrays = [=](GLenum mode, GLint first, GLsizei count) {
        judge->draw("glDrawArrays", *state);
        driver->DrawArrays(mode, first, count);
    };

    // Textures
    gl.BindTexture = [=](GLenum target, GLuint texture) {
        textures->bind(texture);
        driver->BindTexture(target, texture);
    };
    gl.TexImage2D = [=](GLenum target, GLint level, GLint format, GLsizei width, GLsizei height, GLint border,
                        GLenum pixels, GLenum type, const void* data) {
        if (pixels == GL_DEPTH_COMPONENT) judge->depthTexture("glTexImage2D", "GL_DEPTH_COMPONENT");
        judge->texture("glTexImage2D", width, height);
        textures->specified(GLenum(format));
        driver->TexImage2D(target, level, format, width, height, border, pixels, type, data);
    };
    gl.CopyTexImage2D = [=](GLenum target, GLint level, GLenum format, GLint x, GLint y, GLsizei width,
                            GLsizei height, GLint border) {
        judge->copy("glCopyTexImage2D", format);
        if (isDepth(format)) judge->depthTexture("glCopyTexImage2D", format);
        judge->texture("glCopyTexImage2D", width, height);
        if (isAlphaOnly(format)) judge->alphaPlanes("glCopyTexImage2D", "alpha");
        textures->specified(format);
        driver->CopyTexImage2D(target, level, format, x, y, width, height, border);
    };
    gl.CopyTexSubImage2D = [=](GLenum target, GLint level, GLint s, GLint t, GLint x, GLint y, GLsizei width,
                               GLsizei height) {
        judge->copy("glCopyTexSubImage2D", [=] { return fmt::format("{}x{}", width, height); });
        if (textures->boundIsAlphaOnly()) judge->alphaPlanes("glCopyTexSubImage2D", "alpha");
        driver->CopyTexSubImage2D(target, level, s, t, x, y, width, height);
    };
    gl.ActiveTexture = [=](GLenum unit) {
        judge->need(int(unit - GL_TEXTURE0) < judge->p.textureUnits, "glActiveTexture", unit,
                    "texture_units");
        driver->ActiveTexture(unit);
    };

    // Frame buffers of textures: so far only depth maps are drawn to.
    gl.BindFramebuffer = [=](GLenum target, GLuint framebuffer) {
        if (framebuffer != 0)
            judge->depthTexture("glBindFramebuffer", [=] { return fmt::format("{}", framebuffer); });
        state->toTexture = framebuffer != 0;
        driver->BindFramebuffer(target, framebuffer);
    };

    // Programs
    gl.CreateShader = [=](GLenum type) {
        judge->shader(type);
        return driver->CreateShader(type);
    };
    gl.ShaderSource = [=](GLuint shader, GLsizei count, const GLchar* const* strings, const GLint* lengths) {
        std::string text;
        for (GLsizei i = 0; i < count; ++i)
            text += lengths && lengths[i] >= 0 ? std::string(strings[i], std::size_t(lengths[i]))
                                               : std::string(strings[i]);
        judge->shaderSource(text);
        driver->ShaderSource(shader, count, strings, lengths);
    };
    gl.CreateProgram = [=]() {
        judge->need(judge->p.shaders, "glCreateProgram", "", "shaders");
        return driver->CreateProgram();
    };
    gl.UseProgram = [=](GLuint program) {
        judge->need(
            judge->p.shaders, "glUseProgram", [=] { return fmt::format("{}", program); }, "shaders");
        state->program = program != 0;
        driver->UseProgram(program);
    };
    gl.BindBufferBase = [=](GLenum target, GLuint index, GLuint buffer) {
        judge->need(judge->p.atomicCounters || target != GL_ATOMIC_COUNTER_BUFFER, "glBindBufferBase",
                    "GL_ATOMIC_COUNTER_BUFFER", "atomic_counters");
        driver->BindBufferBase(target, index, buffer);
    };
    gl.DrawElements = [=](GLenum mode, GLsizei count, GLenum type, const void* indices) {
        judge->draw("glDrawElements", *state);
        driver->DrawElements(mode, count, type, indices);
    };
    return gl;
}

}  // namespace gnomon
