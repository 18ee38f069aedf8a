#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <functional>

namespace gnomon {

/// The OpenGL entry points that gnomon's renderer and its capability layer know, as a value. A decorator
/// takes such a table and gives one back; nobody above calls OpenGL by its global names. Members are named as
/// the entry points without their "gl".
struct GlTable {
    template <class... Args>
    using Call = std::function<void(Args...)>;

    // Frame buffer
    Call<GLbitfield> Clear{};
    Call<GLfloat, GLfloat, GLfloat, GLfloat> ClearColor{};
    Call<GLint> ClearStencil{};
    Call<GLboolean, GLboolean, GLboolean, GLboolean> ColorMask{};
    Call<GLint, GLint, GLsizei, GLsizei> Viewport{};
    Call<GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*> ReadPixels{};
    Call<GLenum, GLint> PixelStorei{};

    // Tests
    Call<GLenum> Enable{}, Disable{};
    Call<GLint, GLint, GLsizei, GLsizei> Scissor{};
    Call<GLenum> DepthFunc{};
    Call<GLboolean> DepthMask{};
    Call<GLenum, GLfloat> AlphaFunc{};
    Call<GLenum, GLint, GLuint> StencilFunc{};
    Call<GLenum, GLenum, GLenum> StencilOp{};
    Call<GLuint> StencilMask{};
    Call<GLenum, GLenum, GLint, GLuint> StencilFuncSeparate{};
    Call<GLenum, GLenum, GLenum, GLenum> StencilOpSeparate{};
    Call<GLenum, GLuint> StencilMaskSeparate{};

    // Blending
    Call<GLenum, GLenum> BlendFunc{};
    Call<GLenum, GLenum, GLenum, GLenum> BlendFuncSeparate{};
    Call<GLenum> BlendEquation{};
    Call<GLenum, GLenum> BlendEquationSeparate{};
    Call<GLfloat, GLfloat, GLfloat, GLfloat> BlendColor{};
    Call<GLenum> LogicOp{};

    // Geometry
    Call<GLenum> CullFace{};
    Call<GLfloat, GLfloat> PolygonOffset{};
    Call<GLenum, const GLdouble*> ClipPlane{};
    Call<GLfloat, GLfloat, GLfloat, GLfloat> Color4f{};
    Call<GLfloat, GLfloat, GLfloat, GLfloat> Rectf{};
    Call<GLenum> EnableClientState{}, DisableClientState{};
    Call<GLint, GLenum, GLsizei, const void*> VertexPointer{}, ColorPointer{}, TexCoordPointer{};
    Call<GLenum, GLint, GLsizei> DrawArrays{};

    // Textures
    Call<GLsizei, GLuint*> GenTextures{};
    Call<GLsizei, const GLuint*> DeleteTextures{};
    Call<GLenum, GLuint> BindTexture{};
    Call<GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*> TexImage2D{};
    Call<GLenum, GLenum, GLint> TexParameteri{};
    Call<GLenum, GLenum, GLint> TexEnvi{};
    Call<GLenum, GLint, GLenum, GLint, GLint, GLsizei, GLsizei, GLint> CopyTexImage2D{};
    Call<GLenum, GLint, GLint, GLint, GLint, GLint, GLsizei, GLsizei> CopyTexSubImage2D{};
    Call<GLenum> ActiveTexture{};
    Call<GLenum, GLint, GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, const void*> TexSubImage2D{};
    Call<GLenum, GLsizei, GLenum, GLsizei, GLsizei> TexStorage2D{};
    Call<GLuint, GLenum, GLuint, GLenum, GLuint, GLuint, GLuint, GLuint> TextureView{};

    // Frame buffers of textures
    Call<GLsizei, GLuint*> GenFramebuffers{};
    Call<GLsizei, const GLuint*> DeleteFramebuffers{};
    Call<GLenum, GLuint> BindFramebuffer{};
    Call<GLenum, GLenum, GLenum, GLuint, GLint> FramebufferTexture2D{};
    Call<GLenum> DrawBuffer{};
    Call<GLenum, GLenum, GLsizei, GLsizei> RenderbufferStorage{};
    Call<GLsizei, GLuint*> GenRenderbuffers{};
    Call<GLenum, GLuint> BindRenderbuffer{};
    Call<GLenum, GLenum, GLenum, GLuint> FramebufferRenderbuffer{};
    std::function<GLenum(GLenum)> CheckFramebufferStatus{};
    Call<GLenum, GLint, const GLuint*> ClearBufferuiv{};
    Call<GLenum, GLenum, GLint> FramebufferParameteri{};

    // Programs
    std::function<GLuint(GLenum)> CreateShader{};
    Call<GLuint, GLsizei, const GLchar* const*, const GLint*> ShaderSource{};
    Call<GLuint> CompileShader{};
    Call<GLuint, GLenum, GLint*> GetShaderiv{};
    Call<GLuint, GLsizei, GLsizei*, GLchar*> GetShaderInfoLog{};
    Call<GLuint> DeleteShader{};
    std::function<GLuint()> CreateProgram{};
    Call<GLuint, GLuint> AttachShader{};
    Call<GLuint> LinkProgram{};
    Call<GLuint, GLenum, GLint*> GetProgramiv{};
    Call<GLuint, GLsizei, GLsizei*, GLchar*> GetProgramInfoLog{};
    Call<GLuint> UseProgram{}, DeleteProgram{};
    std::function<GLint(GLuint, const GLchar*)> GetUniformLocation{};
    Call<GLint, GLint> Uniform1i{};
    Call<GLint, GLint, GLint, GLint, GLint> Uniform4i{};
    Call<GLint, GLfloat> Uniform1f{};
    Call<GLint, GLsizei, const GLdouble*> Uniform4dv{};
    Call<GLint, GLsizei, GLboolean, const GLfloat*> UniformMatrix3fv{};

    // Buffers
    Call<GLsizei, GLuint*> GenBuffers{};
    Call<GLsizei, const GLuint*> DeleteBuffers{};
    Call<GLenum, GLuint> BindBuffer{};
    Call<GLenum, GLuint, GLuint> BindBufferBase{};
    Call<GLenum, GLsizeiptr, const void*, GLenum> BufferData{};
    Call<GLenum, GLintptr, GLsizeiptr, void*> GetBufferSubData{};
    Call<GLbitfield> MemoryBarrier{};
    Call<GLenum, GLsizei, GLenum, const void*> DrawElements{};

    // Queries
    Call<GLsizei, GLuint*> GenQueries{};
    Call<GLsizei, const GLuint*> DeleteQueries{};
    Call<GLenum, GLuint> BeginQuery{};
    Call<GLenum> EndQuery{};
    Call<GLuint, GLenum, GLuint64*> GetQueryObjectui64v{};

    // What the driver is
    std::function<const GLubyte*(GLenum)> GetString{};
    Call<GLenum, GLint*> GetIntegerv{};

    Call<> Finish{};
    std::function<GLenum()> GetError{};
};

}  // namespace gnomon
