#include "gl/vertex_arrays.h"

namespace gnomon {

template <class Vertex>
const void* VertexArrays::pointerTo(const std::string& name, int light, std::span<const Vertex> array) {
    if (m_source == VertexSource::HostMemory) return array.data();
    gl.BindBuffer(GL_ARRAY_BUFFER, m_kept.buffer(gl, name).name);
    const Sent now{array.data(), array.size_bytes(), light};
    const auto [sent, isFirst] = m_sent.try_emplace(name, now);
    if (isFirst || sent->second != now) {
        gl.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(now.bytes), now.data, GL_STREAM_DRAW);
        sent->second = now;
    }
    return nullptr;  // its beginning
}

void VertexArrays::unbind() {
    if (m_source == VertexSource::Buffers) gl.BindBuffer(GL_ARRAY_BUFFER, 0);
}

void VertexArrays::positions(const std::string& name, int light, std::span<const glm::vec4> array) {
    gl.VertexPointer(4, GL_FLOAT, 0, pointerTo(name, light, array));
    unbind();
}

void VertexArrays::colours(const std::string& name, int light, std::span<const VertexColour> array) {
    gl.ColorPointer(4, GL_UNSIGNED_BYTE, 0, pointerTo(name, light, array));
    unbind();
}

void VertexArrays::coordinates(const std::string& name, int light, std::span<const glm::vec3> array) {
    gl.TexCoordPointer(3, GL_FLOAT, 0, pointerTo(name, light, array));
    unbind();
}

}  // namespace gnomon
