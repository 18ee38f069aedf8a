#include "gl/counter.h"

#include <algorithm>

namespace gnomon {
namespace {

/// Whether four corners cover the whole viewport: each is a corner of the clip volume, and they all differ.
bool coversViewport(GLint size, const void* positions, GLint first, GLsizei count) {
    if (count != 4 || positions == nullptr) return false;
    const auto* v = static_cast<const float*>(positions) + std::ptrdiff_t(first) * size;
    unsigned corners = 0;
    for (int i = 0; i < 4; ++i, v += size) {
        if ((v[0] != 1 && v[0] != -1) || (v[1] != 1 && v[1] != -1)) return false;
        corners |= 1u << ((v[0] > 0) + 2 * (v[1] > 0));
    }
    return corners == 15;
}

}  // namespace

void Counter::reset() {
    *m_counts = {};
    *m_state = {};
}

GlTable Counter::count(GlTable next) {
    const auto counts = m_counts;
    const auto state = m_state;
    const auto driver = std::make_shared<const GlTable>(std::move(next));
    GlTable gl = *driver;

    const auto add = [counts, state](Kind kind) {
        if (state->run == kind && kind != Kind::Rectangle) return;
        state->run = kind;
        if (kind == Kind::Scene) ++counts->passes.scene;
        if (kind == Kind::Volume) ++counts->passes.volume;
        if (kind == Kind::Rectangle) ++counts->passes.rectangle;
        if (kind == Kind::Copy) ++counts->passes.copy;
    };
    /// A state call ends the run.
    const auto ending = [state]<class... Args>(const std::function<void(Args...)>& entry) {
        return std::function<void(Args...)>([state, entry](Args... args) {
            state->run = Kind::None;
            entry(args...);
        });
    };

    gl.Clear = ending(driver->Clear);
    gl.ColorMask = ending(driver->ColorMask);
    gl.Viewport = ending(driver->Viewport);
    gl.Enable = ending(driver->Enable);
    gl.Disable = ending(driver->Disable);
    gl.DepthFunc = ending(driver->DepthFunc);
    gl.StencilFunc = ending(driver->StencilFunc);
    gl.StencilOp = ending(driver->StencilOp);
    gl.StencilOpSeparate = ending(driver->StencilOpSeparate);
    gl.BlendFunc = ending(driver->BlendFunc);
    gl.BlendFuncSeparate = ending(driver->BlendFuncSeparate);
    gl.BlendEquation = ending(driver->BlendEquation);
    gl.CullFace = ending(driver->CullFace);
    gl.Color4f = ending(driver->Color4f);
    gl.BindFramebuffer = ending(driver->BindFramebuffer);
    gl.UseProgram = ending(driver->UseProgram);
    gl.StencilMask = ending(driver->StencilMask);

    gl.DepthMask = [=](GLboolean write) {
        state->run = Kind::None;
        state->depthWrite = write;
        driver->DepthMask(write);
    };
    const auto turn = [state](GLenum array, bool on) {
        if (array == GL_COLOR_ARRAY) state->colours = on;
        if (array == GL_TEXTURE_COORD_ARRAY) state->coordinates = on;
    };
    const auto faces = [state] {
        const bool varying = state->colours || state->coordinates;
        return !state->depthWrite && !varying ? Kind::Volume : Kind::Scene;
    };
    gl.EnableClientState = [=](GLenum array) {
        turn(array, true);
        driver->EnableClientState(array);
    };
    gl.DisableClientState = [=](GLenum array) {
        turn(array, false);
        driver->DisableClientState(array);
    };
    gl.BindBuffer = [=](GLenum target, GLuint buffer) {
        if (target == GL_ARRAY_BUFFER) state->inBuffer = buffer != 0;
        driver->BindBuffer(target, buffer);
    };
    gl.VertexPointer = [=](GLint size, GLenum type, GLsizei stride, const void* pointer) {
        state->size = size;
        state->positions = type == GL_FLOAT && stride == 0 && !state->inBuffer ? pointer : nullptr;
        driver->VertexPointer(size, type, stride, pointer);
    };
    gl.DrawArrays = [=](GLenum mode, GLint first, GLsizei vertices) {
        ++counts->draws;
        counts->vertices += vertices;
        if (coversViewport(state->size, state->positions, first, vertices))
            add(Kind::Rectangle);
        else
            add(faces());
        driver->DrawArrays(mode, first, vertices);
    };
    gl.DrawElements = [=](GLenum mode, GLsizei vertices, GLenum type, const void* indices) {
        ++counts->draws;
        counts->vertices += vertices;
        add(faces());
        driver->DrawElements(mode, vertices, type, indices);
    };
    gl.CopyTexImage2D = [=](GLenum target, GLint level, GLenum format, GLint x, GLint y, GLsizei width,
                            GLsizei height, GLint border) {
        add(Kind::Copy);
        driver->CopyTexImage2D(target, level, format, x, y, width, height, border);
    };
    gl.CopyTexSubImage2D = [=](GLenum target, GLint level, GLint s, GLint t, GLint x, GLint y, GLsizei width,
                               GLsizei height) {
        add(Kind::Copy);
        driver->CopyTexSubImage2D(target, level, s, t, x, y, width, height);
    };
    return gl;
}

}  // namespace gnomon
