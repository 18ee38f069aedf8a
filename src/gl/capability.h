#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "gl/buffer_format.h"
#include "gl/table.h"
#include "profile/profile.h"

namespace gnomon {

/// A call that the chip can't execute. It has not reached the driver.
struct CapabilityViolation : std::runtime_error {
    CapabilityViolation(std::string call, std::string argument, std::string capability, std::string source);
    std::string call{};        ///< "glEnable"
    std::string argument{};    ///< "GL_STENCIL_TEST"
    std::string capability{};  ///< the profile's key: "stencil_bits"
    std::string source{};      ///< the profile's source for the limit
};

/// The entry points of @p next, held to @p profile. Each forbidden call, and each draw under a forbidden
/// combination of states, throws CapabilityViolation instead of reaching @p next.
///
/// @param buffers  of the surface; tells whether destination alpha or depth was chosen where the chip has
/// either
///
/// What can't be seen at the call is judged at the draw (or clear): a blend pair that needs a constant source
/// colour, alpha factors while alpha is written, alpha writes beside depth. The initial colour mask asks for
/// nothing: only a mask that the caller has set counts as writing alpha. Not restricted: culling, which a
/// driver does on the host where the chip can't (Glide on the signed area, the vector units of a PlayStation
/// 2); read-back; the number of vertices; the scissor, which is as old as OpenGL: what a chip's own rectangle
/// can't bound, a driver clips.
///
/// @pre @p profile outlives the entry points
GlTable restrictTo(const Profile& profile, const BufferFormat& buffers, GlTable next);
GlTable restrictTo(const Profile&& profile, const BufferFormat& buffers, GlTable next) = delete;

/// The same for frame after frame, of one chip or of several in turn: the entry points are put up once.
class CapabilityLayer {
  public:
    CapabilityLayer(const BufferFormat& buffers, GlTable next);

    /// The entry points, held to @p profile; as if the caller had set no state yet.
    /// @pre @p profile outlives all calls until the next holdTo()
    const GlTable& holdTo(const Profile& profile);
    const GlTable& holdTo(const Profile&& profile) = delete;

    struct Layer;

  private:
    BufferFormat m_buffers;
    std::shared_ptr<Layer> m_layer;
    GlTable m_gl;
};

}  // namespace gnomon
