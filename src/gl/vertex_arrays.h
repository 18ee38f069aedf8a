#pragma once

#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>

#include "gl/frame.h"
#include "gl/kept_objects.h"
#include "gl/table.h"

namespace gnomon {

/// Where the driver reads the vertices of surfaces and volumes from.
enum class VertexSource {
    HostMemory,  ///< arrays of the caller's: best where the processor draws, since nothing is copied
    Buffers,     ///< buffer objects, each sent once a frame: best where a GPU draws
};

/// The arrays that the passes of one frame draw from. Rectangles over the window are four corners, and stay
/// in the host's memory; so do the edges that a geometry shader takes.
class VertexArrays {
  public:
    /// @param kept  the context's
    VertexArrays(const GlTable& table, KeptObjects& kept, VertexSource source)
        : gl(table), m_kept(kept), m_source(source) {}

    /// Names an array for the draws to come. The same name with the same contents is sent once.
    /// @param light  whose it is; that of another light is another array. kNoLight: it lasts for the frame
    void positions(const std::string& name, int light, std::span<const glm::vec4> array);
    void colours(const std::string& name, int light, std::span<const VertexColour> array);
    void coordinates(const std::string& name, int light, std::span<const glm::vec3> array);
    static constexpr int kNoLight = -1;

    /// The next use of @p name has other contents.
    void changed(const std::string& name) { m_sent.erase(name); }

  private:
    /// What is to be given as an array's pointer: binds its buffer, after sending what it does not hold yet.
    template <class Vertex>
    const void* pointerTo(const std::string& name, int light, std::span<const Vertex> array);
    void unbind();

    struct Sent {
        const void* data = nullptr;
        std::size_t bytes = 0;
        int light = kNoLight;
        bool operator==(const Sent&) const = default;
    };

    const GlTable& gl;
    KeptObjects& m_kept;
    const VertexSource m_source;
    std::map<std::string, Sent> m_sent{};  ///< in this frame
};

}  // namespace gnomon
