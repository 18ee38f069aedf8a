#include "gl/window_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include "gl/extensions.h"

namespace gnomon {
namespace {

GLenum colourFormat(const BufferFormat& f) {
    if (f.red == 5 && f.green == 6 && f.blue == 5 && f.alpha == 0) return GL_RGB565;
    if (f.red == 8 && f.green == 8 && f.blue == 8 && f.alpha == 8) return GL_RGBA8;
    throw std::runtime_error(
        fmt::format("no renderbuffer of {}, {}, {} and {} bits", f.red, f.green, f.blue, f.alpha));
}

struct Attached {
    GLenum attachment = 0, format = 0;
};

/// What holds depth and stencil.
Attached depthFormat(const BufferFormat& f) {
    if (f.depth == 24 && f.stencil == 8) return {GL_DEPTH_STENCIL_ATTACHMENT, GL_DEPTH24_STENCIL8};
    if (f.depth == 0 && f.stencil == 8) return {GL_STENCIL_ATTACHMENT, GL_STENCIL_INDEX8};
    if (f.stencil == 0 && f.depth == 16) return {GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT16};
    if (f.stencil == 0 && f.depth == 24) return {GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24};
    if (f.stencil == 0 && f.depth == 32) return {GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32};
    throw std::runtime_error(
        fmt::format("no renderbuffer of {} bits of depth and {} of stencil", f.depth, f.stencil));
}

GLuint makeWindow(const BufferFormat& format, int width, int height, const GlTable& gl) {
    std::vector<Attached> buffers{{GL_COLOR_ATTACHMENT0, colourFormat(format)}};
    if (format.depth > 0 || format.stencil > 0) buffers.push_back(depthFormat(format));
    GLuint window = 0;
    gl.GenFramebuffers(1, &window);
    gl.BindFramebuffer(GL_FRAMEBUFFER, window);
    for (const Attached& what : buffers) {
        GLuint buffer = 0;
        gl.GenRenderbuffers(1, &buffer);
        gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
        gl.RenderbufferStorage(GL_RENDERBUFFER, what.format, width, height);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, what.attachment, GL_RENDERBUFFER, buffer);
    }
    if (hasExtension(gl, "GL_MESA_framebuffer_flip_y"))
        gl.FramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_FLIP_Y_MESA, GL_TRUE);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error(fmt::format("the driver can't draw to {}x{} in this format", width, height));
    gl.Viewport(0, 0, width, height);
    gl.Scissor(0, 0, width, height);
    return window;
}

}  // namespace

GlTable withWindowObject(const BufferFormat& format, int width, int height, GlTable driver) {
    const auto next = std::make_shared<const GlTable>(std::move(driver));
    const GLuint window = makeWindow(format, width, height, *next);
    const auto bound = std::make_shared<GLuint>(window);
    GlTable gl = *next;
    gl.BindFramebuffer = [next, window, bound](GLenum target, GLuint framebuffer) {
        *bound = framebuffer == 0 ? window : framebuffer;
        next->BindFramebuffer(target, *bound);
    };
    // OpenGL binds 0 where what is bound is deleted.
    gl.DeleteFramebuffers = [next, window, bound](GLsizei count, const GLuint* names) {
        next->DeleteFramebuffers(count, names);
        if (std::find(names, names + count, *bound) != names + count)
            next->BindFramebuffer(GL_FRAMEBUFFER, *bound = window);
    };
    return gl;
}

}  // namespace gnomon
