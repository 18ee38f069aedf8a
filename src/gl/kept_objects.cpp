#include "gl/kept_objects.h"

namespace gnomon {

KeptObjects::Object KeptObjects::get(Names& names, const GlTable::Call<GLsizei, GLuint*>& make,
                                     const std::string& name) {
    Kept& kept = names[name];
    const bool isNew = kept.name == 0;
    if (isNew) make(1, &kept.name);
    kept.frame = m_frame;
    return {kept.name, isNew};
}

void KeptObjects::drop(const GlTable& gl, long frame) {
    const auto from = [frame](Names& names, const GlTable::Call<GLsizei, const GLuint*>& destroy) {
        std::erase_if(names, [&](const auto& entry) {
            const Kept& kept = entry.second;
            if (kept.frame >= frame) return false;
            destroy(1, &kept.name);
            return true;
        });
    };
    from(m_textures, gl.DeleteTextures);
    from(m_framebuffers, gl.DeleteFramebuffers);
    from(m_buffers, gl.DeleteBuffers);
}

void KeptObjects::endFrame(const GlTable& gl) {
    ++m_frame;
    drop(gl, m_frame - kFrames);
}

void KeptObjects::clear(const GlTable& gl) {
    ++m_frame;
    drop(gl, m_frame);
}

}  // namespace gnomon
