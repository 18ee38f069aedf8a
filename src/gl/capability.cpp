#include "gl/capability.h"

#include <fmt/format.h>

#include <optional>
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

/// What the entry points share.
struct CapabilityLayer::Layer {
    std::optional<Judge> judge{};  ///< none before the first profile
    DrawState state{};
    TextureFormats textures{};
    const GlTable driver;
};

namespace {

GlTable entryPoints(const std::shared_ptr<CapabilityLayer::Layer>& layer) {
    GlTable gl = layer->driver;

    // Frame buffer
    gl.Clear = [=](GLbitfield mask) {
        if (mask & GL_STENCIL_BUFFER_BIT) layer->judge->stencil("glClear", "GL_STENCIL_BUFFER_BIT");
        if (mask & GL_DEPTH_BUFFER_BIT)
            layer->judge->need(layer->judge->p.depth, "glClear", "GL_DEPTH_BUFFER_BIT", "depth_bits");
        if ((mask & GL_COLOR_BUFFER_BIT) && layer->state.alpha)
            layer->judge->alphaPlanes("glClear", "writing alpha");
        layer->driver.Clear(mask);
    };
    gl.ClearStencil = [=](GLint value) {
        layer->judge->stencil("glClearStencil", [=] { return fmt::format("{}", value); });
        layer->driver.ClearStencil(value);
    };
    gl.ColorMask = [=](GLboolean r, GLboolean g, GLboolean b, GLboolean a) {
        layer->judge->colourMask(r, g, b, a);
        layer->state.red = r, layer->state.green = g, layer->state.blue = b, layer->state.alpha = a;
        layer->driver.ColorMask(r, g, b, a);
    };
    gl.Viewport = [=](GLint x, GLint y, GLsizei width, GLsizei height) {
        // A texture that is drawn to has limits of its own.
        if (!layer->state.toTexture) layer->judge->viewport(x, y, width, height);
        layer->driver.Viewport(x, y, width, height);
    };

    // Tests
    gl.Enable = [=](GLenum what) {
        layer->judge->enable(what);
        if (what == GL_BLEND) layer->state.blend = true;
        if (what == GL_COLOR_LOGIC_OP) layer->state.logicOp = true;
        if (what == GL_TEXTURE_2D) layer->state.texture = true;
        layer->driver.Enable(what);
    };
    gl.Disable = [=](GLenum what) {
        if (what == GL_BLEND) layer->state.blend = false;
        if (what == GL_COLOR_LOGIC_OP) layer->state.logicOp = false;
        if (what == GL_TEXTURE_2D) layer->state.texture = false;
        layer->driver.Disable(what);
    };
    gl.DepthFunc = [=](GLenum function) {
        layer->judge->depthFunction(function);
        layer->driver.DepthFunc(function);
    };
    gl.DepthMask = [=](GLboolean write) {
        layer->judge->need(!write || layer->judge->p.depth, "glDepthMask", "GL_TRUE", "depth_bits");
        layer->driver.DepthMask(write);
    };
    gl.AlphaFunc = [=](GLenum function, GLfloat reference) {
        layer->judge->alphaFunction(function);
        layer->driver.AlphaFunc(function, reference);
    };
    gl.StencilFunc = [=](GLenum function, GLint reference, GLuint mask) {
        layer->judge->stencil("glStencilFunc", function);
        layer->driver.StencilFunc(function, reference, mask);
    };
    gl.StencilOp = [=](GLenum fail, GLenum depthFail, GLenum pass) {
        layer->judge->stencil("glStencilOp", pass);
        layer->judge->stencilOps("glStencilOp", {fail, depthFail, pass});
        layer->driver.StencilOp(fail, depthFail, pass);
    };
    gl.StencilMask = [=](GLuint mask) {
        layer->judge->stencil("glStencilMask", [=] { return fmt::format("0x{:x}", mask); });
        layer->driver.StencilMask(mask);
    };
    gl.StencilFuncSeparate = [=](GLenum face, GLenum function, GLint reference, GLuint mask) {
        layer->judge->oneSide("glStencilFuncSeparate", face);
        layer->driver.StencilFuncSeparate(face, function, reference, mask);
    };
    gl.StencilOpSeparate = [=](GLenum face, GLenum fail, GLenum depthFail, GLenum pass) {
        layer->judge->oneSide("glStencilOpSeparate", face);
        layer->judge->stencilOps("glStencilOpSeparate", {fail, depthFail, pass});
        layer->driver.StencilOpSeparate(face, fail, depthFail, pass);
    };
    gl.StencilMaskSeparate = [=](GLenum face, GLuint mask) {
        layer->judge->oneSide("glStencilMaskSeparate", face);
        layer->driver.StencilMaskSeparate(face, mask);
    };

    // Blending
    gl.BlendFunc = [=](GLenum source, GLenum destination) {
        layer->judge->blendPair("glBlendFunc", source, destination);
        layer->state.source = layer->state.alphaSource = source;
        layer->state.destination = layer->state.alphaDestination = destination;
        layer->driver.BlendFunc(source, destination);
    };
    gl.BlendFuncSeparate = [=](GLenum source, GLenum destination, GLenum alphaSource,
                               GLenum alphaDestination) {
        const bool same = source == alphaSource && destination == alphaDestination;
        layer->judge->need(
            same || layer->judge->p.separateAlphaFactors, "glBlendFuncSeparate",
            [=] {
                return fmt::format("{}, {}, {}, {}", enumName(source), enumName(destination),
                                   enumName(alphaSource), enumName(alphaDestination));
            },
            "separate_alpha_factors");
        layer->judge->blendPair("glBlendFuncSeparate", source, destination);
        layer->state.source = source, layer->state.destination = destination;
        layer->state.alphaSource = alphaSource, layer->state.alphaDestination = alphaDestination;
        layer->driver.BlendFuncSeparate(source, destination, alphaSource, alphaDestination);
    };
    gl.BlendEquation = [=](GLenum equation) {
        layer->judge->blendEquation("glBlendEquation", equation);
        layer->state.equation = equation;
        layer->driver.BlendEquation(equation);
    };
    gl.BlendEquationSeparate = [=](GLenum colour, GLenum alpha) {
        layer->judge->need(
            colour == alpha || layer->judge->p.separateAlphaFactors, "glBlendEquationSeparate",
            [=] { return fmt::format("{}, {}", enumName(colour), enumName(alpha)); },
            "separate_alpha_factors");
        layer->judge->blendEquation("glBlendEquationSeparate", colour);
        layer->judge->blendEquation("glBlendEquationSeparate", alpha);
        layer->state.equation = colour;
        layer->driver.BlendEquationSeparate(colour, alpha);
    };
    gl.BlendColor = [=](GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
        layer->judge->blendColour();
        layer->driver.BlendColor(r, g, b, a);
    };
    gl.LogicOp = [=](GLenum operation) {
        layer->judge->need(layer->judge->p.logicOps, "glLogicOp", operation, "logic_ops");
        layer->driver.LogicOp(operation);
    };

    // Geometry
    gl.PolygonOffset = [=](GLfloat factor, GLfloat units) {
        layer->judge->need(
            factor == 0 || layer->judge->p.polygonOffsetFactor, "glPolygonOffset",
            [=] { return fmt::format("factor {}", factor); }, "polygon_offset_factor");
        layer->judge->need(
            units == 0 || layer->judge->p.polygonOffsetUnits, "glPolygonOffset",
            [=] { return fmt::format("units {}", units); }, "polygon_offset_units");
        layer->driver.PolygonOffset(factor, units);
    };
    gl.ClipPlane = [=](GLenum plane, const GLdouble* equation) {
        layer->judge->need(int(plane - GL_CLIP_PLANE0) < layer->judge->p.clipPlanes, "glClipPlane", plane,
                           "clip_planes");
        layer->driver.ClipPlane(plane, equation);
    };
    gl.Color4f = [=](GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
        layer->state.colour = {r, g, b, a};
        layer->driver.Color4f(r, g, b, a);
    };
    gl.EnableClientState = [=](GLenum array) {
        if (array == GL_COLOR_ARRAY) layer->state.colourArray = true;
        layer->driver.EnableClientState(array);
    };
    gl.DisableClientState = [=](GLenum array) {
        if (array == GL_COLOR_ARRAY) layer->state.colourArray = false;
        layer->driver.DisableClientState(array);
    };
    gl.DrawArrays = [=](GLenum mode, GLint first, GLsizei count) {
        layer->judge->draw("glDrawArrays", layer->state);
        layer->driver.DrawArrays(mode, first, count);
    };

    // Textures
    gl.BindTexture = [=](GLenum target, GLuint texture) {
        layer->textures.bind(texture);
        layer->driver.BindTexture(target, texture);
    };
    gl.TexImage2D = [=](GLenum target, GLint level, GLint format, GLsizei width, GLsizei height, GLint border,
                        GLenum pixels, GLenum type, const void* data) {
        if (pixels == GL_DEPTH_COMPONENT) layer->judge->depthTexture("glTexImage2D", "GL_DEPTH_COMPONENT");
        layer->judge->texture("glTexImage2D", width, height);
        layer->textures.specified(GLenum(format));
        layer->driver.TexImage2D(target, level, format, width, height, border, pixels, type, data);
    };
    gl.CopyTexImage2D = [=](GLenum target, GLint level, GLenum format, GLint x, GLint y, GLsizei width,
                            GLsizei height, GLint border) {
        layer->judge->copy("glCopyTexImage2D", format);
        if (isDepth(format)) layer->judge->depthTexture("glCopyTexImage2D", format);
        layer->judge->texture("glCopyTexImage2D", width, height);
        if (isAlphaOnly(format)) layer->judge->alphaPlanes("glCopyTexImage2D", "alpha");
        layer->textures.specified(format);
        layer->driver.CopyTexImage2D(target, level, format, x, y, width, height, border);
    };
    gl.CopyTexSubImage2D = [=](GLenum target, GLint level, GLint s, GLint t, GLint x, GLint y, GLsizei width,
                               GLsizei height) {
        layer->judge->copy("glCopyTexSubImage2D", [=] { return fmt::format("{}x{}", width, height); });
        if (layer->textures.boundIsAlphaOnly()) layer->judge->alphaPlanes("glCopyTexSubImage2D", "alpha");
        layer->driver.CopyTexSubImage2D(target, level, s, t, x, y, width, height);
    };
    gl.ActiveTexture = [=](GLenum unit) {
        layer->judge->need(int(unit - GL_TEXTURE0) < layer->judge->p.textureUnits, "glActiveTexture", unit,
                           "texture_units");
        layer->driver.ActiveTexture(unit);
    };

    // Frame buffers of textures: so far only depth maps are drawn to.
    gl.BindFramebuffer = [=](GLenum target, GLuint framebuffer) {
        if (framebuffer != 0)
            layer->judge->depthTexture("glBindFramebuffer", [=] { return fmt::format("{}", framebuffer); });
        layer->state.toTexture = framebuffer != 0;
        layer->driver.BindFramebuffer(target, framebuffer);
    };

    // Programs
    gl.CreateShader = [=](GLenum type) {
        layer->judge->shader(type);
        return layer->driver.CreateShader(type);
    };
    gl.ShaderSource = [=](GLuint shader, GLsizei count, const GLchar* const* strings, const GLint* lengths) {
        std::string text;
        for (GLsizei i = 0; i < count; ++i)
            text += lengths && lengths[i] >= 0 ? std::string(strings[i], std::size_t(lengths[i]))
                                               : std::string(strings[i]);
        layer->judge->shaderSource(text);
        layer->driver.ShaderSource(shader, count, strings, lengths);
    };
    gl.CreateProgram = [=]() {
        layer->judge->need(layer->judge->p.shaders, "glCreateProgram", "", "shaders");
        return layer->driver.CreateProgram();
    };
    gl.UseProgram = [=](GLuint program) {
        layer->judge->need(
            layer->judge->p.shaders, "glUseProgram", [=] { return fmt::format("{}", program); }, "shaders");
        layer->state.program = program != 0;
        layer->driver.UseProgram(program);
    };
    gl.BindBufferBase = [=](GLenum target, GLuint index, GLuint buffer) {
        layer->judge->need(layer->judge->p.atomicCounters || target != GL_ATOMIC_COUNTER_BUFFER,
                           "glBindBufferBase", "GL_ATOMIC_COUNTER_BUFFER", "atomic_counters");
        layer->driver.BindBufferBase(target, index, buffer);
    };
    gl.DrawElements = [=](GLenum mode, GLsizei count, GLenum type, const void* indices) {
        layer->judge->draw("glDrawElements", layer->state);
        layer->driver.DrawElements(mode, count, type, indices);
    };
    return gl;
}

}  // namespace

CapabilityLayer::CapabilityLayer(const BufferFormat& buffers, GlTable next)
    : m_buffers(buffers),
      m_layer(std::make_shared<Layer>(Layer{.driver = std::move(next)})),
      m_gl(entryPoints(m_layer)) {}

const GlTable& CapabilityLayer::holdTo(const Profile& profile) {
    m_layer->judge.emplace(profile, m_buffers);
    m_layer->state = {};
    m_layer->textures.bind(0);
    return m_gl;
}

GlTable restrictTo(const Profile& profile, const BufferFormat& buffers, GlTable next) {
    return CapabilityLayer(buffers, std::move(next)).holdTo(profile);
}

}  // namespace gnomon
