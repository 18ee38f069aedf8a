#include "gl/capability.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <memory>

#include "gl/words.h"
#include "plan/plan.h"

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

/// The state that decides whether a draw is allowed, as far as the caller has set it.
struct DrawState {
    bool blend = false;
    bool logicOp = false;  ///< takes the place of blending
    GLenum source = GL_ONE, destination = GL_ZERO, alphaSource = GL_ONE, alphaDestination = GL_ZERO;
    GLenum equation = GL_FUNC_ADD;
    bool red = true, green = true, blue = true;
    bool alpha = false;  ///< asked for by the caller; the initial mask asks for nothing
    bool colourArray = false, texture = false, program = false;
    bool toTexture = false;     ///< draws to a texture instead of the window
    bool alphaTexture = false;  ///< the texture specified last holds nothing but alpha
    glm::vec4 colour{1};
};

bool readsDestinationAlpha(GLenum factor) {
    return factor == GL_DST_ALPHA || factor == GL_ONE_MINUS_DST_ALPHA || factor == GL_SRC_ALPHA_SATURATE;
}

bool isConstantFactor(GLenum factor) {
    return factor == GL_CONSTANT_COLOR || factor == GL_ONE_MINUS_CONSTANT_COLOR ||
           factor == GL_CONSTANT_ALPHA || factor == GL_ONE_MINUS_CONSTANT_ALPHA;
}

/// In the alpha channel a colour factor means the alpha value of the same side.
GLenum inAlphaChannel(GLenum factor) {
    switch (factor) {
        case GL_SRC_COLOR:
            return GL_SRC_ALPHA;
        case GL_ONE_MINUS_SRC_COLOR:
            return GL_ONE_MINUS_SRC_ALPHA;
        case GL_DST_COLOR:
            return GL_DST_ALPHA;
        case GL_ONE_MINUS_DST_COLOR:
            return GL_ONE_MINUS_DST_ALPHA;
        default:
            return factor;
    }
}

/// What the profile allows, asked in OpenGL's enumerants. Every refusal is a thrown violation.
class Judge {
  public:
    Judge(const Profile& profile, const BufferFormat& buffers) : p(profile), b(buffers) {}

    void need(bool has, const char* call, const std::string& argument, const std::string& capability) const {
        if (!has) throw CapabilityViolation(call, argument, capability, p.sourceOf(capability));
    }

    void enable(GLenum what) const {
        const char* call = "glEnable";
        const std::string word = enumName(what);
        if (what == GL_DEPTH_TEST) need(p.depth, call, word, "depth_bits");
        if (what == GL_STENCIL_TEST) need(p.stencilBits > 0, call, word, "stencil_bits");
        if (what == GL_ALPHA_TEST) need(!p.alphaFunctions.empty(), call, word, "alpha_functions");
        if (what == GL_COLOR_LOGIC_OP) need(p.logicOps, call, word, "logic_ops");
        if (what == GL_DEPTH_CLAMP) need(p.depthClamp, call, word, "depth_clamp");
        if (what == GL_TEXTURE_2D) need(p.textureUnits > 0, call, word, "texture_units");
        if (what == GL_POLYGON_OFFSET_FILL)
            need(p.polygonOffsetUnits || p.polygonOffsetFactor, call, word, "polygon_offset_units");
        if (what >= GL_CLIP_PLANE0 && what < GL_CLIP_PLANE0 + 32)
            need(int(what - GL_CLIP_PLANE0) < p.clipPlanes, call, word, "clip_planes");
    }

    void stencil(const char* call, const std::string& argument) const {
        need(p.stencilBits > 0, call, argument, "stencil_bits");
    }

    void stencilOps(const char* call, std::initializer_list<GLenum> ops) const {
        for (const GLenum op : ops)
            if (op == GL_INCR_WRAP || op == GL_DECR_WRAP)
                need(p.stencilWrap, call, enumName(op), "stencil_wrap");
    }

    void oneSide(const char* call, GLenum face) const {
        stencil(call, enumName(face));
        need(face == GL_FRONT_AND_BACK || p.twoSidedStencil, call, enumName(face), "two_sided_stencil");
    }

    void depthFunction(GLenum function) const {
        need(p.depth, "glDepthFunc", enumName(function), "depth_bits");
        const auto word = compareOf(function);
        need(!word || p.depthFunctions.contains(*word), "glDepthFunc", enumName(function), "depth_functions");
    }

    void alphaFunction(GLenum function) const {
        const auto word = compareOf(function);
        need(!word || p.alphaFunctions.contains(*word), "glAlphaFunc", enumName(function), "alpha_functions");
    }

    /// A pair that no state makes possible is refused where it is set; one that needs a constant source at
    /// the draw.
    void blendPair(const char* call, GLenum source, GLenum destination) const {
        const auto s = blendFactorOf(source), d = blendFactorOf(destination);
        if (!s || !d) return;
        const std::string pair = enumName(source) + ", " + enumName(destination);
        const bool asColour = p.allowsBlend(*s, *d) || p.allowsBlendWithConstantSource(*s, *d);
        need(asColour || allowsAlphaPair(source, destination), call, pair, blendKey());
    }

    bool allowsAlphaPair(GLenum source, GLenum destination) const {
        const auto has = [](const std::set<BlendFactor>& factors, GLenum f) {
            const auto plain = blendFactorOf(f), alpha = blendFactorOf(inAlphaChannel(f));
            return (plain && factors.contains(*plain)) || (alpha && factors.contains(*alpha));
        };
        return p.blendWritesAlpha && has(p.alphaSourceFactors, source) &&
               has(p.alphaDestinationFactors, destination);
    }

    void blendEquation(const char* call, GLenum equation) const {
        const auto word = blendEquationOf(equation);
        need(!word || p.blendEquations.contains(*word), call, enumName(equation), "blend_equations");
    }

    void blendColour() const {
        const auto isConstant = [](BlendFactor f) { return isConstantFactor(glEnum(f)); };
        const auto any = [&](const std::set<BlendFactor>& set) {
            return std::any_of(set.begin(), set.end(), isConstant);
        };
        const bool inPairs = std::any_of(
            p.blendPairs.begin(), p.blendPairs.end(),
            [&](const BlendPair& pair) { return isConstant(pair.first) || isConstant(pair.second); });
        need(any(p.sourceFactors) || any(p.destinationFactors) || inPairs, "glBlendColor", "constant colour",
             blendKey());
    }

    void colourMask(bool r, bool g, bool blue, bool a) const {
        const std::string argument = fmt::format("{:d}, {:d}, {:d}, {:d}", r, g, blue, a);
        const bool partial = r != g || g != blue;
        need(!partial || p.writeMask == WriteMask::Channel, "glColorMask", argument, "write_mask");
        need(p.writeMask != WriteMask::Fixed || p.alphaBits == 0 || r == a, "glColorMask", argument,
             "write_mask");
    }

    void viewport(GLint x, GLint y, GLsizei width, GLsizei height) const {
        const int right = x + width, top = y + height;
        const std::string argument = fmt::format("{}x{}", right, top);
        need(!p.maxWidth || right <= p.maxWidth, "glViewport", argument, "max_width");
        need(!p.maxHeight || top <= p.maxHeight, "glViewport", argument, "max_height");
        need(!p.frameBytes || gnomon::frameBytes(p, right, top) <= p.frameBytes, "glViewport", argument,
             "frame_bytes");
    }

    void texture(const char* call, GLsizei width, GLsizei height) const {
        const std::string argument = fmt::format("{}x{}", width, height);
        need(p.textureUnits > 0, call, argument, "texture_units");
        const int longest = std::max(width, height), shortest = std::min(width, height);
        need(longest <= p.maxTextureSize, call, argument, "max_texture_size");
        need(!p.maxTextureAspect || longest <= p.maxTextureAspect * shortest, call, argument,
             "max_texture_aspect");
        const bool powers = std::has_single_bit(unsigned(longest)) && std::has_single_bit(unsigned(shortest));
        need(powers || p.textureNonPowerOfTwo, call, argument, "texture_non_power_of_two");
    }

    void depthTexture(const char* call, const std::string& argument) const {
        need(p.depthTextures, call, argument, "depth_textures");
    }

    void shader(GLenum type) const {
        need(p.shaders, "glCreateShader", enumName(type), "shaders");
        need(type != GL_GEOMETRY_SHADER || p.geometryShaders, "glCreateShader", enumName(type),
             "geometry_shaders");
    }

    /// A program's text: what it asks for by name.
    void shaderSource(const std::string& text) const {
        need(p.framebufferFetch || text.find("GL_EXT_shader_framebuffer_fetch") == text.npos,
             "glShaderSource", "GL_EXT_shader_framebuffer_fetch", "framebuffer_fetch");
        need(p.atomicCounters || text.find("atomic_uint") == text.npos, "glShaderSource", "atomic_uint",
             "atomic_counters");
    }

    void copy(const char* call, const std::string& argument) const {
        need(p.textureUnits > 0, call, argument, "texture_units");
        need(p.frameTexture != FrameTexture::None, call, argument, "frame_texture");
    }

    void alphaPlanes(const char* call, const std::string& argument) const {
        need(p.alphaBits > 0, call, argument, "alpha_bits");
        need(!p.alphaExcludesDepth || b.alpha > 0, call, argument, "alpha_excludes_depth");
    }

    /// A draw under the state that the caller has set.
    void draw(const char* call, const DrawState& s) const {
        const bool colour = s.red || s.green || s.blue;
        if (s.alpha) alphaPlanes(call, "writing alpha");
        if (s.logicOp)
            return need(!s.alpha || p.blendWritesAlpha, call, "a logic op on alpha", "blend_writes_alpha");
        if (!s.blend || !(colour || s.alpha)) return;
        if (s.equation == GL_MIN || s.equation == GL_MAX) return;
        const std::string pair = "blending " + enumName(s.source) + ", " + enumName(s.destination);
        if (readsDestinationAlpha(s.source) || readsDestinationAlpha(s.destination)) alphaPlanes(call, pair);
        if (colour) {
            const auto source = *blendFactorOf(s.source), destination = *blendFactorOf(s.destination);
            const bool constantGrey = !s.colourArray && !s.texture && !s.program &&
                                      s.colour.r == s.colour.g && s.colour.g == s.colour.b;
            const bool byConstant = p.allowsBlendWithConstantSource(source, destination);
            need(p.allowsBlend(source, destination) || (byConstant && constantGrey), call,
                 pair + (byConstant ? " with a varying source colour" : ""), blendKey());
        }
        if (s.alpha) {
            need(p.blendWritesAlpha, call, "blending alpha", "blend_writes_alpha");
            need(allowsAlphaPair(s.alphaSource, s.alphaDestination), call, pair + " in alpha",
                 "alpha_source_factors");
        }
    }

    const Profile p;
    const BufferFormat b;

  private:
    std::string blendKey() const { return p.blendPairs.empty() ? "source_factors" : "blend_pairs"; }
};

/// Internal formats that hold nothing but alpha: copied from a frame buffer they need destination alpha
/// there.
bool isAlphaOnly(GLenum format) {
    return format == GL_ALPHA || format == GL_ALPHA4 || format == GL_ALPHA8;
}

bool isDepth(GLenum format) {
    return format == GL_DEPTH_COMPONENT || format == GL_DEPTH_COMPONENT16 || format == GL_DEPTH_COMPONENT24 ||
           format == GL_DEPTH_COMPONENT32;
}

}  // namespace

GlTable restrictTo(const Profile& profile, const BufferFormat& buffers, GlTable next) {
    const auto judge = std::make_shared<const Judge>(profile, buffers);
    const auto state = std::make_shared<DrawState>();
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
        judge->stencil("glClearStencil", fmt::format("{}", value));
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
        judge->stencil("glStencilFunc", enumName(function));
        driver->StencilFunc(function, reference, mask);
    };
    gl.StencilOp = [=](GLenum fail, GLenum depthFail, GLenum pass) {
        judge->stencil("glStencilOp", enumName(pass));
        judge->stencilOps("glStencilOp", {fail, depthFail, pass});
        driver->StencilOp(fail, depthFail, pass);
    };
    gl.StencilMask = [=](GLuint mask) {
        judge->stencil("glStencilMask", fmt::format("0x{:x}", mask));
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
        judge->need(same || judge->p.separateAlphaFactors, "glBlendFuncSeparate",
                    fmt::format("{}, {}, {}, {}", enumName(source), enumName(destination),
                                enumName(alphaSource), enumName(alphaDestination)),
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
        judge->need(colour == alpha || judge->p.separateAlphaFactors, "glBlendEquationSeparate",
                    enumName(colour) + ", " + enumName(alpha), "separate_alpha_factors");
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
        judge->need(judge->p.logicOps, "glLogicOp", enumName(operation), "logic_ops");
        driver->LogicOp(operation);
    };

    // Geometry
    gl.PolygonOffset = [=](GLfloat factor, GLfloat units) {
        judge->need(factor == 0 || judge->p.polygonOffsetFactor, "glPolygonOffset",
                    fmt::format("factor {}", factor), "polygon_offset_factor");
        judge->need(units == 0 || judge->p.polygonOffsetUnits, "glPolygonOffset",
                    fmt::format("units {}", units), "polygon_offset_units");
        driver->PolygonOffset(factor, units);
    };
    gl.ClipPlane = [=](GLenum plane, const GLdouble* equation) {
        judge->need(int(plane - GL_CLIP_PLANE0) < judge->p.clipPlanes, "glClipPlane", enumName(plane),
                    "clip_planes");
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
    gl.TexImage2D = [=](GLenum target, GLint level, GLint format, GLsizei width, GLsizei height, GLint border,
                        GLenum pixels, GLenum type, const void* data) {
        if (pixels == GL_DEPTH_COMPONENT) judge->depthTexture("glTexImage2D", "GL_DEPTH_COMPONENT");
        judge->texture("glTexImage2D", width, height);
        state->alphaTexture = isAlphaOnly(GLenum(format));
        driver->TexImage2D(target, level, format, width, height, border, pixels, type, data);
    };
    gl.CopyTexImage2D = [=](GLenum target, GLint level, GLenum format, GLint x, GLint y, GLsizei width,
                            GLsizei height, GLint border) {
        judge->copy("glCopyTexImage2D", enumName(format));
        if (isDepth(format)) judge->depthTexture("glCopyTexImage2D", enumName(format));
        judge->texture("glCopyTexImage2D", width, height);
        if (isAlphaOnly(format)) judge->alphaPlanes("glCopyTexImage2D", "alpha");
        state->alphaTexture = isAlphaOnly(format);
        driver->CopyTexImage2D(target, level, format, x, y, width, height, border);
    };
    gl.CopyTexSubImage2D = [=](GLenum target, GLint level, GLint s, GLint t, GLint x, GLint y, GLsizei width,
                               GLsizei height) {
        judge->copy("glCopyTexSubImage2D", fmt::format("{}x{}", width, height));
        if (state->alphaTexture) judge->alphaPlanes("glCopyTexSubImage2D", "alpha");
        driver->CopyTexSubImage2D(target, level, s, t, x, y, width, height);
    };
    gl.ActiveTexture = [=](GLenum unit) {
        judge->need(int(unit - GL_TEXTURE0) < judge->p.textureUnits, "glActiveTexture", enumName(unit),
                    "texture_units");
        driver->ActiveTexture(unit);
    };

    // Frame buffers of textures: so far only depth maps are drawn to.
    gl.BindFramebuffer = [=](GLenum target, GLuint framebuffer) {
        if (framebuffer != 0) judge->depthTexture("glBindFramebuffer", fmt::format("{}", framebuffer));
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
        judge->need(judge->p.shaders, "glUseProgram", fmt::format("{}", program), "shaders");
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
