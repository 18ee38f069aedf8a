#pragma once

#include <map>
#include <string>

#include "gl/table.h"

namespace gnomon {

/// Textures, frame buffers and vertex buffers that stay in a context from frame to frame, by names that their
/// users choose. What no frame has asked for in a while is deleted.
///
/// @pre the context is current in each call, and @p gl leads to it
class KeptObjects {
  public:
    struct Object {
        GLuint name = 0;
        bool isNew = false;  ///< made by this call: nothing but a name yet
    };
    Object texture(const GlTable& gl, const std::string& name) {
        return get(m_textures, gl.GenTextures, name);
    }
    Object framebuffer(const GlTable& gl, const std::string& name) {
        return get(m_framebuffers, gl.GenFramebuffers, name);
    }
    Object buffer(const GlTable& gl, const std::string& name) { return get(m_buffers, gl.GenBuffers, name); }

    /// A frame is drawn: what the last kFrames of them have not asked for goes.
    void endFrame(const GlTable& gl);
    /// All go: the next frame is drawn as the context's first.
    void clear(const GlTable& gl);

    /// Longer than the rounds of a comparison, so that several plans that take turns keep theirs.
    static constexpr long kFrames = 32;

  private:
    struct Kept {
        GLuint name = 0;
        long frame = 0;  ///< in which it was asked for last
    };
    using Names = std::map<std::string, Kept>;

    Object get(Names& names, const GlTable::Call<GLsizei, GLuint*>& make, const std::string& name);
    /// Deletes what no frame since @p frame has asked for.
    void drop(const GlTable& gl, long frame);

    Names m_textures{}, m_framebuffers{}, m_buffers{};
    long m_frame = 0;
};

}  // namespace gnomon
