#include "gl/surface.h"

#include <GL/osmesa.h>
#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

#include "gl/emulation.h"

namespace gnomon {
namespace {

template <class Result, class... Args>
void load(std::function<Result(Args...)>& entry, const char* name) {
    using Raw = Result (*)(Args...);
    const auto raw = reinterpret_cast<Raw>(OSMesaGetProcAddress(name));
    if (!raw) throw std::runtime_error(fmt::format("OSMesa has no {}", name));
    entry = raw;
}

GlTable loadDriver() {
    GlTable gl;
    load(gl.Clear, "glClear");
    load(gl.ClearColor, "glClearColor");
    load(gl.ClearStencil, "glClearStencil");
    load(gl.ColorMask, "glColorMask");
    load(gl.Viewport, "glViewport");
    load(gl.ReadPixels, "glReadPixels");
    load(gl.PixelStorei, "glPixelStorei");
    load(gl.Enable, "glEnable");
    load(gl.Disable, "glDisable");
    load(gl.Scissor, "glScissor");
    load(gl.DepthFunc, "glDepthFunc");
    load(gl.DepthMask, "glDepthMask");
    load(gl.AlphaFunc, "glAlphaFunc");
    load(gl.StencilFunc, "glStencilFunc");
    load(gl.StencilOp, "glStencilOp");
    load(gl.StencilMask, "glStencilMask");
    load(gl.StencilFuncSeparate, "glStencilFuncSeparate");
    load(gl.StencilOpSeparate, "glStencilOpSeparate");
    load(gl.StencilMaskSeparate, "glStencilMaskSeparate");
    load(gl.BlendFunc, "glBlendFunc");
    load(gl.BlendFuncSeparate, "glBlendFuncSeparate");
    load(gl.BlendEquation, "glBlendEquation");
    load(gl.BlendEquationSeparate, "glBlendEquationSeparate");
    load(gl.BlendColor, "glBlendColor");
    load(gl.LogicOp, "glLogicOp");
    load(gl.CullFace, "glCullFace");
    load(gl.PolygonOffset, "glPolygonOffset");
    load(gl.ClipPlane, "glClipPlane");
    load(gl.Color4f, "glColor4f");
    load(gl.Rectf, "glRectf");
    load(gl.EnableClientState, "glEnableClientState");
    load(gl.DisableClientState, "glDisableClientState");
    load(gl.VertexPointer, "glVertexPointer");
    load(gl.ColorPointer, "glColorPointer");
    load(gl.TexCoordPointer, "glTexCoordPointer");
    load(gl.DrawArrays, "glDrawArrays");
    load(gl.GenTextures, "glGenTextures");
    load(gl.DeleteTextures, "glDeleteTextures");
    load(gl.BindTexture, "glBindTexture");
    load(gl.TexImage2D, "glTexImage2D");
    load(gl.TexParameteri, "glTexParameteri");
    load(gl.TexEnvi, "glTexEnvi");
    load(gl.CopyTexImage2D, "glCopyTexImage2D");
    load(gl.CopyTexSubImage2D, "glCopyTexSubImage2D");
    load(gl.ActiveTexture, "glActiveTexture");
    load(gl.TexSubImage2D, "glTexSubImage2D");
    load(gl.TexStorage2D, "glTexStorage2D");
    load(gl.TextureView, "glTextureView");
    load(gl.GenFramebuffers, "glGenFramebuffers");
    load(gl.DeleteFramebuffers, "glDeleteFramebuffers");
    load(gl.BindFramebuffer, "glBindFramebuffer");
    load(gl.FramebufferTexture2D, "glFramebufferTexture2D");
    load(gl.DrawBuffer, "glDrawBuffer");
    load(gl.RenderbufferStorage, "glRenderbufferStorage");
    load(gl.GenRenderbuffers, "glGenRenderbuffers");
    load(gl.BindRenderbuffer, "glBindRenderbuffer");
    load(gl.FramebufferRenderbuffer, "glFramebufferRenderbuffer");
    load(gl.CheckFramebufferStatus, "glCheckFramebufferStatus");
    load(gl.ClearBufferuiv, "glClearBufferuiv");
    load(gl.CreateShader, "glCreateShader");
    load(gl.ShaderSource, "glShaderSource");
    load(gl.CompileShader, "glCompileShader");
    load(gl.GetShaderiv, "glGetShaderiv");
    load(gl.GetShaderInfoLog, "glGetShaderInfoLog");
    load(gl.DeleteShader, "glDeleteShader");
    load(gl.CreateProgram, "glCreateProgram");
    load(gl.AttachShader, "glAttachShader");
    load(gl.LinkProgram, "glLinkProgram");
    load(gl.GetProgramiv, "glGetProgramiv");
    load(gl.GetProgramInfoLog, "glGetProgramInfoLog");
    load(gl.UseProgram, "glUseProgram");
    load(gl.DeleteProgram, "glDeleteProgram");
    load(gl.GetUniformLocation, "glGetUniformLocation");
    load(gl.Uniform1i, "glUniform1i");
    load(gl.Uniform4i, "glUniform4i");
    load(gl.Uniform1f, "glUniform1f");
    load(gl.Uniform4dv, "glUniform4dv");
    load(gl.UniformMatrix3fv, "glUniformMatrix3fv");
    load(gl.GenBuffers, "glGenBuffers");
    load(gl.DeleteBuffers, "glDeleteBuffers");
    load(gl.BindBuffer, "glBindBuffer");
    load(gl.BindBufferBase, "glBindBufferBase");
    load(gl.BufferData, "glBufferData");
    load(gl.GetBufferSubData, "glGetBufferSubData");
    load(gl.MemoryBarrier, "glMemoryBarrier");
    load(gl.DrawElements, "glDrawElements");
    load(gl.GenQueries, "glGenQueries");
    load(gl.DeleteQueries, "glDeleteQueries");
    load(gl.BeginQuery, "glBeginQuery");
    load(gl.EndQuery, "glEndQuery");
    load(gl.GetQueryObjectui64v, "glGetQueryObjectui64v");
    load(gl.Finish, "glFinish");
    load(gl.GetError, "glGetError");
    return gl;
}

struct PixelFormat {
    GLenum osmesa = 0, type = 0;
    int bytes = 0;
};

PixelFormat pixelFormat(const BufferFormat& f) {
    if (f.red == 5 && f.green == 6 && f.blue == 5 && f.alpha == 0)
        return {OSMESA_RGB_565, GL_UNSIGNED_SHORT_5_6_5, 2};
    if (f.red == 8 && f.green == 8 && f.blue == 8 && f.alpha == 8) return {OSMESA_RGBA, GL_UNSIGNED_BYTE, 4};
    throw std::runtime_error(
        fmt::format("no OSMesa buffer of {}{}{}{} bits", f.red, f.green, f.blue, f.alpha));
}

}  // namespace

struct Surface::Impl {
    BufferFormat format{};
    PixelFormat pixels{};
    int width = 0, height = 0;
    OSMesaContext context = nullptr;
    std::vector<std::uint32_t> buffer{};
    GlTable driver{};
    std::map<std::string, unsigned> programs{};
    KeptObjects objects{};

    ~Impl() {
        if (context) OSMesaDestroyContext(context);
    }
};

Surface::Surface(const BufferFormat& format, int width, int height, const ChipArithmetic& chip)
    : m_impl(std::make_unique<Impl>()) {
    // One thread per process: the matrix runs processes side by side, and thread CPU time then times a frame.
    // Whoever asks for threads gets them, and times that mean nothing.
    setenv("LP_NUM_THREADS", "0", 0);
    setenv("GALLIUM_DRIVER", "llvmpipe", 0);
    Impl& m = *m_impl;
    m.format = format;
    m.width = width;
    m.height = height;
    // An emulated frame lives in buffers of its own; the context's are not drawn to.
    const bool emulated = needsEmulation(format, chip);
    const BufferFormat own = emulated ? BufferFormat{.depth = 0, .stencil = 0} : format;
    m.pixels = pixelFormat(own);
    const int attributes[] = {OSMESA_FORMAT,
                              int(m.pixels.osmesa),
                              OSMESA_DEPTH_BITS,
                              own.depth,
                              OSMESA_STENCIL_BITS,
                              own.stencil,
                              OSMESA_ACCUM_BITS,
                              0,
                              OSMESA_PROFILE,
                              OSMESA_COMPAT_PROFILE,
                              0};
    m.context = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!m.context) throw std::runtime_error("OSMesa gives no context");
    m.buffer.resize((std::size_t(width) * height * m.pixels.bytes + 3) / 4);
    makeCurrent();
    m.driver = loadDriver();

    // What was asked for and nothing else.
    GLint depth = 0, stencil = 0;
    using GetInteger = void (*)(GLenum, GLint*);
    const auto getInteger = reinterpret_cast<GetInteger>(OSMesaGetProcAddress("glGetIntegerv"));
    getInteger(GL_DEPTH_BITS, &depth);
    getInteger(GL_STENCIL_BITS, &stencil);
    if (depth != own.depth || stencil != own.stencil)
        throw std::runtime_error(fmt::format("OSMesa gives {} bits of depth and {} of stencil for {} and {}",
                                             depth, stencil, own.depth, own.stencil));
    m.driver.PixelStorei(GL_PACK_ALIGNMENT, 1);
    m.driver.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    // Dithering is on by default in OpenGL; llvmpipe has none, and a mask must not depend on it.
    m.driver.Disable(GL_DITHER);
    if (emulated) m.driver = emulate(format, chip, width, height, std::move(m.driver));
}

Surface::~Surface() = default;

const GlTable& Surface::driver() const {
    return m_impl->driver;
}
void Surface::decorate(const std::function<GlTable(GlTable)>& decorator) {
    m_impl->driver = decorator(std::move(m_impl->driver));
}
const BufferFormat& Surface::format() const {
    return m_impl->format;
}
int Surface::width() const {
    return m_impl->width;
}
int Surface::height() const {
    return m_impl->height;
}

std::map<std::string, unsigned>& Surface::programs() {
    return m_impl->programs;
}
KeptObjects& Surface::objects() {
    return m_impl->objects;
}

void Surface::makeCurrent() {
    Impl& m = *m_impl;
    if (!OSMesaMakeCurrent(m.context, m.buffer.data(), m.pixels.type, m.width, m.height))
        throw std::runtime_error(fmt::format("OSMesa can't draw {}x{} in this format", m.width, m.height));
}

}  // namespace gnomon
