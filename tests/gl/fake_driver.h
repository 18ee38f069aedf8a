#pragma once

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "gl/capability.h"
#include "gl/table.h"

namespace gnomon {

/// A driver that draws nothing and writes down which entry points were reached, in order.
class FakeDriver {
  public:
    GlTable table() const {
        GlTable gl;
        record(gl.Clear, "glClear");
        record(gl.ClearColor, "glClearColor");
        record(gl.ClearStencil, "glClearStencil");
        record(gl.ColorMask, "glColorMask");
        record(gl.Viewport, "glViewport");
        record(gl.ReadPixels, "glReadPixels");
        record(gl.PixelStorei, "glPixelStorei");
        record(gl.Enable, "glEnable");
        record(gl.Disable, "glDisable");
        record(gl.Scissor, "glScissor");
        record(gl.DepthFunc, "glDepthFunc");
        record(gl.DepthMask, "glDepthMask");
        record(gl.AlphaFunc, "glAlphaFunc");
        record(gl.StencilFunc, "glStencilFunc");
        record(gl.StencilOp, "glStencilOp");
        record(gl.StencilMask, "glStencilMask");
        record(gl.StencilFuncSeparate, "glStencilFuncSeparate");
        record(gl.StencilOpSeparate, "glStencilOpSeparate");
        record(gl.StencilMaskSeparate, "glStencilMaskSeparate");
        record(gl.BlendFunc, "glBlendFunc");
        record(gl.BlendFuncSeparate, "glBlendFuncSeparate");
        record(gl.BlendEquation, "glBlendEquation");
        record(gl.BlendEquationSeparate, "glBlendEquationSeparate");
        record(gl.BlendColor, "glBlendColor");
        record(gl.LogicOp, "glLogicOp");
        record(gl.CullFace, "glCullFace");
        record(gl.PolygonOffset, "glPolygonOffset");
        record(gl.ClipPlane, "glClipPlane");
        record(gl.Color4f, "glColor4f");
        record(gl.EnableClientState, "glEnableClientState");
        record(gl.DisableClientState, "glDisableClientState");
        record(gl.VertexPointer, "glVertexPointer");
        record(gl.ColorPointer, "glColorPointer");
        record(gl.TexCoordPointer, "glTexCoordPointer");
        record(gl.DrawArrays, "glDrawArrays");
        record(gl.GenTextures, "glGenTextures");
        record(gl.DeleteTextures, "glDeleteTextures");
        record(gl.BindTexture, "glBindTexture");
        record(gl.TexImage2D, "glTexImage2D");
        record(gl.TexParameteri, "glTexParameteri");
        record(gl.TexEnvi, "glTexEnvi");
        record(gl.CopyTexImage2D, "glCopyTexImage2D");
        record(gl.CopyTexSubImage2D, "glCopyTexSubImage2D");
        record(gl.ActiveTexture, "glActiveTexture");
        record(gl.CreateShader, "glCreateShader");
        record(gl.CreateProgram, "glCreateProgram");
        record(gl.ShaderSource, "glShaderSource");
        record(gl.UseProgram, "glUseProgram");
        record(gl.BindBuffer, "glBindBuffer");
        record(gl.BindBufferBase, "glBindBufferBase");
        record(gl.BindFramebuffer, "glBindFramebuffer");
        record(gl.DrawElements, "glDrawElements");
        record(gl.Finish, "glFinish");
        record(gl.GetError, "glGetError");
        return gl;
    }

    const std::vector<std::string>& calls() const { return *m_calls; }

  private:
    template <class Result, class... Args>
    void record(std::function<Result(Args...)>& entry, const char* name) const {
        entry = [calls = m_calls, name](Args...) {
            calls->push_back(name);
            if constexpr (!std::is_void_v<Result>) return Result{};
        };
    }

    std::shared_ptr<std::vector<std::string>> m_calls = std::make_shared<std::vector<std::string>>();
};

/// Calls of a test.
using Calls = std::function<void(const GlTable&)>;

/// What @p calls threw.
inline std::optional<CapabilityViolation> violationOf(const std::function<void()>& calls) {
    try {
        calls();
    } catch (const CapabilityViolation& violation) {
        return violation;
    }
    return std::nullopt;
}

}  // namespace gnomon
