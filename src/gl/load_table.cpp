#include "gl/load_table.h"

#include <fmt/format.h>

#include <stdexcept>

namespace gnomon {

GlTable loadTable(const DeviceContext& context) {
    GlTable gl;
    const auto load = [&context]<class Result, class... Args>(std::function<Result(Args...)>& entry,
                                                              const char* name) {
        using Raw = Result (*)(Args...);
        const auto raw = reinterpret_cast<Raw>(context.address(name));
        if (!raw) throw std::runtime_error(fmt::format("the driver has no {}", name));
        entry = raw;
    };
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
    load(gl.GetString, "glGetString");
    load(gl.GetIntegerv, "glGetIntegerv");
    load(gl.FramebufferParameteri, "glFramebufferParameteri");
    load(gl.Finish, "glFinish");
    load(gl.GetError, "glGetError");
    return gl;
}

}  // namespace gnomon
