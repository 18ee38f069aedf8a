#include "gl/frame_calls.h"

namespace gnomon {

FrameCalls::FrameCalls(const BufferFormat& buffers, const GlTable& driver, Fidelity fidelity)
    : m_fidelity(fidelity), m_layer(buffers, driver) {}

const GlTable& FrameCalls::begin(const Profile& profile) {
    const GlTable& held = m_layer.holdTo(profile);
    if (!m_gl) m_gl.emplace(m_counter.count(held));
    m_counter.reset();
    return *m_gl;
}

}  // namespace gnomon
