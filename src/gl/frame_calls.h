#pragma once

#include <optional>

#include "gl/capability.h"
#include "gl/chip_arithmetic.h"
#include "gl/counter.h"

namespace gnomon {

/// The entry points through which a surface's frames are drawn: held to a chip, and counted. Put up once: a
/// small frame would take a twentieth longer if it made its own.
class FrameCalls {
  public:
    /// @param driver    the surface's
    /// @param fidelity  of what is drawn through it
    FrameCalls(const BufferFormat& buffers, const GlTable& driver, Fidelity fidelity);

    Fidelity fidelity() const { return m_fidelity; }

    /// For the next frame, with nothing counted yet.
    /// @pre OpenGL's state is resetState()'s; @p profile outlives the frame
    const GlTable& begin(const Profile& profile);
    const GlTable& begin(const Profile&& profile) = delete;

    /// Of the frame so far.
    const CallCounts& counts() const { return m_counter.counts(); }

  private:
    Fidelity m_fidelity;
    CapabilityLayer m_layer;
    Counter m_counter{};
    std::optional<GlTable> m_gl{};  ///< none before the first frame
};

}  // namespace gnomon
