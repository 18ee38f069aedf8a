#include "gl/emulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include "gl/blend_program.h"
#include "gl/extensions.h"
#include "gl/link_program.h"
#include "gl/words.h"
#include "profile/blend.h"
#include "profile/pixel.h"

namespace gnomon {
namespace {

/// Drivers know no others.
bool equationIsOpenGls(GLenum equation) {
    return equation != GL_FUNC_ADD_WRAP && equation != GL_FUNC_SIGNED_ADD &&
           equation != GL_FUNC_SIGNED_REVERSE_SUBTRACT;
}

/// What the caller has set, as far as it decides how a draw is done.
struct CallerState {
    bool blend = false, logicOps = false, dither = false;
    bool depthTest = false, stencilTest = false, alphaTest = false, cull = false, texture = false;
    bool depthWrite = true;
    std::array<BlendFactor, 2> source{BlendFactor::One, BlendFactor::One};
    std::array<BlendFactor, 2> destination{BlendFactor::Zero, BlendFactor::Zero};
    std::array<BlendEquation, 2> equation{};
    GLenum logicOp = GL_COPY;
    Compare alphaFunction = Compare::Always;
    float alphaReference = 0;
    std::array<bool, 4> write{true, true, true, true};
    std::array<float, 4> colour{1, 1, 1, 1}, blendColour{}, clearColour{};
    bool colourArray = false;
    GLuint boundTexture = 0, program = 0, framebuffer = 0;
    std::map<GLuint, GLenum> textureFormats{};
    std::array<GLint, 4> viewport{};
};

/// What the driver was told last of the state that the emulation decides.
struct DriverState {
    bool blend = false, logicOps = false, alphaTest = false;
    std::array<bool, 4> write{true, true, true, true};
    GLuint program = 0;
    GLuint framebuffer = 0;
};

class Emulation {
  public:
    Emulation(const BufferFormat& format, const ChipArithmetic& chip, int width, int height, GlTable driver)
        : gl(std::move(driver)), m_format(format), m_chip(chip), m_width(width), m_height(height) {
        s.viewport = {0, 0, width, height};
        makeBuffers();
    }

    /// Before a draw: the buffer and the program that it needs.
    void prepare() {
        if (s.framebuffer != 0) return plain(s.framebuffer);
        unsigned channels = 0;
        for (int c = 0; c < 4; ++c)
            if (s.write[std::size_t(c)] && channelBits(m_format, c) > 0) channels |= 1u << c;
        const bool otherDepth = storesOtherDepth(m_format, m_chip) && (s.depthTest || s.depthWrite);
        if (!otherDepth && (channels == 0 || storesAsOpenGl(channels))) return plain(m_bytes);
        if (s.program != 0)
            throw std::runtime_error("a program of the caller's under the chip's own arithmetic");
        if (channels != 0 && s.logicOps && s.logicOp != GL_INVERT && s.logicOp != GL_COPY)
            throw std::runtime_error("of logic operations on emulated pixels only GL_COPY and GL_INVERT");
        useProgramFor(stateFor(channels, otherDepth));
        set(m_driverState.blend, false, GL_BLEND);
        set(m_driverState.logicOps, false, GL_COLOR_LOGIC_OP);
        set(m_driverState.alphaTest, false, GL_ALPHA_TEST);
        mask({channels != 0, channels != 0, channels != 0, channels != 0});
        bind(m_words);
    }

    void clear(GLbitfield bits) {
        if (s.framebuffer != 0 || !(bits & GL_COLOR_BUFFER_BIT)) {
            plain(s.framebuffer != 0 ? s.framebuffer : m_driverState.framebuffer);
            return gl.Clear(bits);
        }
        if (isBytes() && !(isGs() && s.write[3])) {
            plain(m_bytes);
            return gl.Clear(bits);
        }
        if (bits & ~GLbitfield(GL_COLOR_BUFFER_BIT)) {
            plain(m_driverState.framebuffer);
            gl.Clear(bits & ~GLbitfield(GL_COLOR_BUFFER_BIT));
        }
        clearWords();
    }

    void readPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum what, GLenum type, void* out) {
        const bool colour = what == GL_RGB || what == GL_RGBA;
        if (s.framebuffer != 0 || !colour || isBytes()) {
            bind(s.framebuffer != 0 ? s.framebuffer : m_bytes);
            return gl.ReadPixels(x, y, width, height, what, type, out);
        }
        if (type != GL_UNSIGNED_BYTE) throw std::runtime_error("glReadPixels of emulated pixels: bytes only");
        const std::vector<std::uint8_t> bytes = bytesOf(words(x, y, width, height), m_format, m_chip);
        const std::size_t step = what == GL_RGB ? 3 : 4;
        auto* target = static_cast<std::uint8_t*>(out);
        for (std::size_t i = 0; i < bytes.size() / 4; ++i)
            std::copy_n(bytes.data() + 4 * i, step, target + step * i);
    }

    void copyTexImage(GLenum target, GLint level, GLenum format, GLint x, GLint y, GLsizei width,
                      GLsizei height, GLint border) {
        s.textureFormats[s.boundTexture] = format;
        if (s.framebuffer != 0 || isBytes()) {
            bind(s.framebuffer != 0 ? s.framebuffer : m_bytes);
            return gl.CopyTexImage2D(target, level, format, x, y, width, height, border);
        }
        const auto texels = texelsOf(words(x, y, width, height), m_format, m_chip);
        gl.TexImage2D(target, level, GLint(format), width, height, border, GL_RGBA, GL_UNSIGNED_BYTE,
                      texels.data());
    }

    void copyTexSubImage(GLenum target, GLint level, GLint left, GLint bottom, GLint x, GLint y,
                         GLsizei width, GLsizei height) {
        if (s.framebuffer != 0 || isBytes()) {
            bind(s.framebuffer != 0 ? s.framebuffer : m_bytes);
            return gl.CopyTexSubImage2D(target, level, left, bottom, x, y, width, height);
        }
        const auto texels = texelsOf(words(x, y, width, height), m_format, m_chip);
        gl.TexSubImage2D(target, level, left, bottom, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                         texels.data());
    }

    void useProgram(GLuint program) {
        if (m_driverState.program == program) return;
        gl.UseProgram(program);
        m_driverState.program = program;
    }

    void bind(GLuint framebuffer) {
        if (m_driverState.framebuffer == framebuffer) return;
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        m_driverState.framebuffer = framebuffer;
    }

    CallerState s{};
    const GlTable gl;

  private:
    /// Alpha is 1 at 128, unlike in OpenGL's bytes.
    bool isGs() const { return gnomon::isGs(m_chip.unit); }

    DitherMode ditherMode() const { return s.dither ? m_chip.dither : m_chip.undithered; }

    bool isBytes() const { return gnomon::isBytes(m_format); }

    /// Whether OpenGL's own store is the chip's for the state as it is.
    bool storesAsOpenGl(unsigned channels) const {
        if (m_chip.everywhere) return false;
        // A logic operation takes the place of blending.
        const bool openGls = s.equation[0] < BlendEquation::AddWrap && s.equation[1] < BlendEquation::AddWrap;
        return gnomon::storesAsOpenGl(m_format, m_chip, ditherMode(), channels, s.blend && !s.logicOps,
                                      openGls);
    }

    void makeBuffers() {
        for (int c = 0; c < 4; ++c)
            if (channelBits(m_format, c) > 8)
                throw std::runtime_error(fmt::format("no buffer of {}, {}, {} and {} bits", m_format.red,
                                                     m_format.green, m_format.blue, m_format.alpha));
        if (!hasExtension(gl, "GL_EXT_shader_framebuffer_fetch"))
            throw std::runtime_error(
                "the driver has no GL_EXT_shader_framebuffer_fetch, which a chip's own arithmetic and "
                "formats "
                "take");
        const bool bytes = isBytes();
        const GLenum word = wordBits(m_format) == 16 ? GL_R16UI : GL_R32UI;
        std::array<GLuint, 2> textures{};
        gl.GenTextures(2, textures.data());
        gl.BindTexture(GL_TEXTURE_2D, textures[0]);
        gl.TexStorage2D(GL_TEXTURE_2D, 1, bytes ? GL_RGBA8 : word, m_width, m_height);
        gl.BindTexture(GL_TEXTURE_2D, 0);
        if (bytes) gl.TextureView(textures[1], GL_TEXTURE_2D, textures[0], GL_R32UI, 0, 1, 0, 1);

        GLuint depth = 0;
        GLenum attachment = GL_DEPTH_ATTACHMENT;
        if (m_format.depth > 0 || m_format.stencil > 0) {
            gl.GenRenderbuffers(1, &depth);
            gl.BindRenderbuffer(GL_RENDERBUFFER, depth);
            const GLenum format = m_format.stencil > 0   ? GL_DEPTH24_STENCIL8
                                  : m_format.depth == 16 ? GL_DEPTH_COMPONENT16
                                  : m_format.depth == 32 ? GL_DEPTH_COMPONENT32
                                                         : GL_DEPTH_COMPONENT24;
            if (m_format.stencil > 0) attachment = GL_DEPTH_STENCIL_ATTACHMENT;
            gl.RenderbufferStorage(GL_RENDERBUFFER, format, m_width, m_height);
        }
        const auto framebuffer = [&](GLuint texture) {
            GLuint made = 0;
            gl.GenFramebuffers(1, &made);
            gl.BindFramebuffer(GL_FRAMEBUFFER, made);
            if (texture)
                gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
            else
                gl.DrawBuffer(GL_NONE);
            if (depth) gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, depth);
            if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
                throw std::runtime_error("the driver can't draw to words of a pixel");
            m_driverState.framebuffer = made;
            return made;
        };
        // Fixed functions can't draw to words, not even depth.
        m_words = framebuffer(textures[bytes ? 1 : 0]);
        m_bytes = bytes ? framebuffer(textures[0]) : depth ? framebuffer(0) : m_words;
        gl.Viewport(0, 0, m_width, m_height);
    }

    /// OpenGL's own fixed functions, on @p framebuffer.
    void plain(GLuint framebuffer) {
        bind(framebuffer);
        useProgram(s.program);
        set(m_driverState.blend, s.blend && !s.logicOps, GL_BLEND);
        set(m_driverState.logicOps, s.logicOps, GL_COLOR_LOGIC_OP);
        set(m_driverState.alphaTest, s.alphaTest, GL_ALPHA_TEST);
        mask(s.write);
    }

    EmulatedDraw stateFor(unsigned channels, bool otherDepth) const {
        EmulatedDraw state{.format = m_format,
                           .chip = m_chip,
                           .dither = ditherMode(),
                           .channels = channels,
                           .blends = s.blend && !s.logicOps,
                           .inverts = s.logicOps && s.logicOp == GL_INVERT,
                           .writesDepth = otherDepth,
                           .rows = m_height};
        if (state.blends)
            state.source = s.source, state.destination = s.destination, state.equation = s.equation;
        if (s.alphaTest) state.alphaTest = s.alphaFunction;
        if (s.texture) {
            const auto format = s.textureFormats.find(s.boundTexture);
            const GLenum base = format == s.textureFormats.end() ? GLenum(GL_RGBA) : format->second;
            state.from = base == GL_RGB     ? FragmentSource::TextureColour
                         : base == GL_ALPHA ? FragmentSource::TextureAlpha
                                            : FragmentSource::TextureAll;
        } else if (s.colourArray && channels != 0) {
            state.from = FragmentSource::Interpolated;
        }
        // A colour of its own costs a program of its own, and makes it faster. Callers that use many get one
        // that takes any.
        constexpr std::size_t kMostPrograms = 200;
        if (state.from == FragmentSource::Constant && m_programs.size() < kMostPrograms)
            state.constant = bytesOfColour(s.colour);
        return state;
    }

    /// 8 bits; the PS2's alpha is 1 at 128.
    std::array<int, 4> bytesOfColour(const std::array<float, 4>& colour) const {
        std::array<int, 4> bytes{};
        for (std::size_t c = 0; c < 4; ++c) {
            const float one = isGs() && c == 3 ? 128.0f : 255.0f;
            bytes[c] = int(std::floor(std::clamp(colour[c], 0.0f, 1.0f) * one + 0.5f));
        }
        return bytes;
    }

    void useProgramFor(const EmulatedDraw& state) {
        auto at = m_programs.find(state);
        if (at == m_programs.end()) {
            const std::string vertex = vertexProgram(state), fragment = fragmentProgram(state);
            std::vector<ShaderStage> stages{{GL_FRAGMENT_SHADER, fragment.c_str()}};
            if (!vertex.empty()) stages.push_back({GL_VERTEX_SHADER, vertex.c_str()});
            Linked made;
            made.program = linkProgram(gl, "of a chip's blend unit", stages);
            made.source = gl.GetUniformLocation(made.program, "constantSource");
            made.blendColour = gl.GetUniformLocation(made.program, "blendColour");
            made.reference = gl.GetUniformLocation(made.program, "alphaReference");
            at = m_programs.emplace(state, made).first;
        }
        const Linked& linked = at->second;
        useProgram(linked.program);
        const std::array<int, 4> source = bytesOfColour(s.colour), blend = bytesOfColour(s.blendColour);
        if (linked.source >= 0) gl.Uniform4i(linked.source, source[0], source[1], source[2], source[3]);
        if (linked.blendColour >= 0) gl.Uniform4i(linked.blendColour, blend[0], blend[1], blend[2], blend[3]);
        if (linked.reference >= 0)
            gl.Uniform1i(linked.reference, bytesOfColour({0, 0, 0, s.alphaReference})[3]);
    }

    /// Draws a rectangle over the whole buffer in the colour that clears: through masks and dithering, as
    /// the chips do.
    void clearWords() {
        CallerState kept = s;
        s.blend = s.logicOps = s.alphaTest = s.texture = s.colourArray = false;
        s.depthTest = s.depthWrite = false;
        s.program = 0;
        s.colour = s.clearColour;
        const auto off = [&](bool on, GLenum what) {
            if (on) gl.Disable(what);
        };
        off(kept.depthTest, GL_DEPTH_TEST), off(kept.stencilTest, GL_STENCIL_TEST);
        off(kept.cull, GL_CULL_FACE);
        gl.DepthMask(GL_FALSE);
        gl.Viewport(0, 0, m_width, m_height);
        prepare();
        gl.Rectf(-1, -1, 1, 1);
        const auto on = [&](bool was, GLenum what) {
            if (was) gl.Enable(what);
        };
        on(kept.depthTest, GL_DEPTH_TEST), on(kept.stencilTest, GL_STENCIL_TEST);
        on(kept.cull, GL_CULL_FACE);
        gl.DepthMask(kept.depthWrite);
        gl.Viewport(kept.viewport[0], kept.viewport[1], kept.viewport[2], kept.viewport[3]);
        s = std::move(kept);
    }

    std::vector<std::uint32_t> words(GLint x, GLint y, GLsizei width, GLsizei height) {
        bind(m_words);
        std::vector<std::uint32_t> all(std::size_t(width) * std::size_t(height));
        gl.ReadPixels(x, y, width, height, GL_RED_INTEGER, GL_UNSIGNED_INT, all.data());
        return all;
    }

    void set(bool& known, bool wanted, GLenum what) {
        if (known == wanted) return;
        wanted ? gl.Enable(what) : gl.Disable(what);
        known = wanted;
    }

    void mask(const std::array<bool, 4>& write) {
        if (m_driverState.write == write) return;
        gl.ColorMask(write[0], write[1], write[2], write[3]);
        m_driverState.write = write;
    }

    /// A program with its uniforms; -1: it has no such one.
    struct Linked {
        GLuint program = 0;
        GLint source = -1, blendColour = -1, reference = -1;
    };

    const BufferFormat m_format;
    const ChipArithmetic m_chip;
    const int m_width, m_height;
    DriverState m_driverState{};
    GLuint m_bytes = 0;  ///< frame buffer of RGBA8, or of depth and stencil alone where pixels aren't that
    GLuint m_words = 0;  ///< the same with pixels as words
    std::map<EmulatedDraw, Linked> m_programs{};
};

}  // namespace

bool needsEmulation(const BufferFormat& format, const ChipArithmetic& chip) {
    const bool has565 = format.red == 5 && format.green == 6 && format.blue == 5 && format.alpha == 0;
    const bool has8888 = format.red == 8 && format.green == 8 && format.blue == 8 && format.alpha == 8;
    return chip.fidelity == Fidelity::Chip || chip.wraps || !(has565 || has8888) ||
           storesOtherDepth(format, chip) || (format.stencil != 0 && format.stencil != 8);
}

GlTable emulate(const BufferFormat& format, const ChipArithmetic& chip, int width, int height,
                GlTable driver) {
    const auto e = std::make_shared<Emulation>(format, chip, width, height, std::move(driver));
    GlTable gl = e->gl;

    // Frame buffer
    gl.Clear = [e](GLbitfield bits) { e->clear(bits); };
    gl.ClearColor = [e](GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
        e->s.clearColour = {r, g, b, a};
        e->gl.ClearColor(r, g, b, a);
    };
    gl.ColorMask = [e](GLboolean r, GLboolean g, GLboolean b, GLboolean a) {
        e->s.write = {r != 0, g != 0, b != 0, a != 0};
    };
    gl.Viewport = [e](GLint x, GLint y, GLsizei width_, GLsizei height_) {
        e->s.viewport = {x, y, width_, height_};
        e->gl.Viewport(x, y, width_, height_);
    };
    gl.ReadPixels = [e](GLint x, GLint y, GLsizei w, GLsizei h, GLenum format_, GLenum type, void* out) {
        e->readPixels(x, y, w, h, format_, type, out);
    };

    // State
    const auto toggle = [e](GLenum what, bool on) {
        CallerState& s = e->s;
        switch (what) {
            case GL_BLEND:
                s.blend = on;
                return;
            case GL_COLOR_LOGIC_OP:
                s.logicOps = on;
                return;
            case GL_ALPHA_TEST:
                s.alphaTest = on;
                return;
            case GL_DITHER:
                s.dither = on;
                return;
            case GL_DEPTH_TEST:
                s.depthTest = on;
                break;
            case GL_STENCIL_TEST:
                s.stencilTest = on;
                break;
            case GL_CULL_FACE:
                s.cull = on;
                break;
            case GL_TEXTURE_2D:
                s.texture = on;
                break;
            default:
                break;
        }
        on ? e->gl.Enable(what) : e->gl.Disable(what);
    };
    gl.Enable = [toggle](GLenum what) { toggle(what, true); };
    gl.Disable = [toggle](GLenum what) { toggle(what, false); };
    gl.DepthMask = [e](GLboolean write) {
        e->s.depthWrite = write != 0;
        e->gl.DepthMask(write);
    };
    gl.AlphaFunc = [e](GLenum function, GLfloat reference) {
        e->s.alphaFunction = compareOf(function).value_or(Compare::Always);
        e->s.alphaReference = reference;
        e->gl.AlphaFunc(function, reference);
    };
    gl.LogicOp = [e](GLenum operation) {
        e->s.logicOp = operation;
        e->gl.LogicOp(operation);
    };
    gl.BlendFunc = [e](GLenum source, GLenum destination) {
        e->s.source.fill(blendFactorOf(source).value_or(BlendFactor::One));
        e->s.destination.fill(blendFactorOf(destination).value_or(BlendFactor::Zero));
        e->gl.BlendFunc(source, destination);
    };
    gl.BlendFuncSeparate = [e](GLenum source, GLenum destination, GLenum alphaSource,
                               GLenum alphaDestination) {
        e->s.source = {blendFactorOf(source).value_or(BlendFactor::One),
                       blendFactorOf(alphaSource).value_or(BlendFactor::One)};
        e->s.destination = {blendFactorOf(destination).value_or(BlendFactor::Zero),
                            blendFactorOf(alphaDestination).value_or(BlendFactor::Zero)};
        e->gl.BlendFuncSeparate(source, destination, alphaSource, alphaDestination);
    };
    gl.BlendEquation = [e](GLenum equation) {
        e->s.equation.fill(blendEquationOf(equation).value_or(BlendEquation::Add));
        if (equationIsOpenGls(equation)) e->gl.BlendEquation(equation);
    };
    gl.BlendEquationSeparate = [e](GLenum colour, GLenum alpha) {
        e->s.equation = {blendEquationOf(colour).value_or(BlendEquation::Add),
                         blendEquationOf(alpha).value_or(BlendEquation::Add)};
        if (equationIsOpenGls(colour) && equationIsOpenGls(alpha)) e->gl.BlendEquationSeparate(colour, alpha);
    };
    gl.BlendColor = [e](GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
        e->s.blendColour = {r, g, b, a};
        e->gl.BlendColor(r, g, b, a);
    };
    gl.Color4f = [e](GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
        e->s.colour = {r, g, b, a};
        e->gl.Color4f(r, g, b, a);
    };
    gl.EnableClientState = [e](GLenum array) {
        if (array == GL_COLOR_ARRAY) e->s.colourArray = true;
        e->gl.EnableClientState(array);
    };
    gl.DisableClientState = [e](GLenum array) {
        if (array == GL_COLOR_ARRAY) e->s.colourArray = false;
        e->gl.DisableClientState(array);
    };

    // Draws
    gl.DrawArrays = [e](GLenum mode, GLint first, GLsizei count) {
        e->prepare();
        e->gl.DrawArrays(mode, first, count);
    };
    gl.DrawElements = [e](GLenum mode, GLsizei count, GLenum type, const void* indices) {
        e->prepare();
        e->gl.DrawElements(mode, count, type, indices);
    };
    gl.Rectf = [e](GLfloat x, GLfloat y, GLfloat x2, GLfloat y2) {
        e->prepare();
        e->gl.Rectf(x, y, x2, y2);
    };

    // Textures
    gl.BindTexture = [e](GLenum target, GLuint texture) {
        e->s.boundTexture = texture;
        e->gl.BindTexture(target, texture);
    };
    gl.TexImage2D = [e](GLenum target, GLint level, GLint format_, GLsizei w, GLsizei h, GLint border,
                        GLenum pixels, GLenum type, const void* data) {
        e->s.textureFormats[e->s.boundTexture] = GLenum(format_);
        e->gl.TexImage2D(target, level, format_, w, h, border, pixels, type, data);
    };
    gl.CopyTexImage2D = [e](GLenum target, GLint level, GLenum format_, GLint x, GLint y, GLsizei w,
                            GLsizei h,
                            GLint border) { e->copyTexImage(target, level, format_, x, y, w, h, border); };
    gl.CopyTexSubImage2D = [e](GLenum target, GLint level, GLint left, GLint bottom, GLint x, GLint y,
                               GLsizei w,
                               GLsizei h) { e->copyTexSubImage(target, level, left, bottom, x, y, w, h); };

    // What the caller binds
    gl.UseProgram = [e](GLuint program) {
        e->s.program = program;
        e->useProgram(program);
    };
    gl.BindFramebuffer = [e](GLenum, GLuint framebuffer) {
        e->s.framebuffer = framebuffer;
        if (framebuffer != 0) e->bind(framebuffer);
    };
    return gl;
}

}  // namespace gnomon
