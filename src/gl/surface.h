#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gl/table.h"
#include "profile/profile.h"

namespace gnomon {

/// The buffers of a drawing surface, in bits; a chip's own formats, nothing that it lacks.
struct BufferFormat {
    int red = 8, green = 8, blue = 8, alpha = 8;
    int depth = 24;
    int stencil = 8;
    auto operator<=>(const BufferFormat&) const = default;
};

/// The buffers that @p profile gets: its first colour format and depth; destination alpha only where it does
/// not exclude depth. OSMesa has no stencil beside 16-bit depth: asked for both it would give 24 bits, and
/// this throws.
BufferFormat bufferFormatOf(const Profile& profile);

/// An off-screen OpenGL context (OSMesa, llvmpipe) with its buffers, current on the thread that made it.
/// Owns both; not copyable. The only place that knows of OSMesa.
class Surface {
  public:
    /// @throws std::runtime_error if OSMesa can't give exactly these buffers
    Surface(const BufferFormat& format, int width, int height);
    ~Surface();
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    /// The driver's entry points, unrestricted.
    const GlTable& driver() const;
    const BufferFormat& format() const;
    int width() const;
    int height() const;

    /// The programs that were linked in this context, by a name that their users choose; they live as long as
    /// it does.
    std::map<std::string, unsigned>& programs();

    /// Makes the context current; needed when several surfaces live.
    void makeCurrent();

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace gnomon
