#pragma once

#include <optional>
#include <string>

#include "gl/free_channels.h"
#include "gl/light_frame.h"
#include "gl/pass_state.h"
#include "gl/programs.h"
#include "gl/surface.h"
#include "gl/vertex_arrays.h"
#include "plan/plan.h"

namespace gnomon {

/// A texture that the frame or a mask was copied to.
struct CopiedTexture {
    GLuint name = 0;
    float u = 1, v = 1;  ///< the part of it that was copied to
};

/// Draws the window-filling rectangle with @p texture under the current state.
void fillWith(const GlTable& gl, const CopiedTexture& texture);

/// Executes the passes of one frame, in their order; each sets all the state that it depends on. Textures and
/// buffers are the surface's, which keeps them for the next frame.
class PassRunner {
  public:
    /// @param table    leads to the surface's driver
    /// @param profile  of the chip: its id is in the names of what is kept, as what one chip may make another
    ///                 may not; and what it has is cleared together
    /// @pre the driver's state is resetState()'s
    PassRunner(const GlTable& table, Surface& surface, const Profile& profile, const Plan& plan,
               const FrameSurfaces& surfaces, const LightFrames& lights, VertexSource source);
    PassRunner(const PassRunner&) = delete;
    PassRunner& operator=(const PassRunner&) = delete;

    void run(const Pass& pass);

    /// From now on a rectangle that multiplies the scene by the mask's texture is drawn only where that is
    /// not one (darkened.h). What is left out changes nothing, to the bit.
    /// @pre a value times one is the value, in the surface's arithmetic
    void leaveOutLit() { m_leavesOutLit = true; }

    /// What a stencil value is compared with.
    int reference(const Stencil& stencil) const {
        return (stencil.reference - (stencil.minusBlockers ? m_blockers : 0)) & 0xff;
    }

    const CopiedTexture& mask() const { return m_mask; }

    /// Sets the state that is kept between passes to OpenGL's defaults, so that decorators know of it.
    void defaultState() { m_state.setDefaults(); }

  private:
    void clear(const Pass& pass);
    void scene(const Pass& pass);
    void backdrop(const glm::vec3& background);
    void volume(const Pass& pass);
    void eachInItsWindow(const Pass& pass, const FrameVolumes& volumes);
    void rectangle(const Pass& pass);
    void copy(const Pass& pass);
    void bindMap(const Pass& pass);
    GLuint mapOf(int light, int face);
    void depthMapMask(const Pass& pass);

    /// The colours of a scene pass, one per position.
    void colours(const Pass& pass);
    void drawSurfaces();
    /// A list that no other draw of the frame shares.
    void draw(const std::string& name, int light, std::span<const glm::vec4> triangles);
    /// Names the runs of @p part for drawRange().
    void volumeRuns(const FrameVolumes& volumes, int light, int part);
    /// An empty range is drawn too: the pass is made all the same.
    void drawRange(std::size_t begin, std::size_t end);

    const GlTable& gl;
    KeptObjects& m_kept;
    const std::string m_chip;
    const FreeChannels m_free;
    const Plan& m_plan;
    const FrameSurfaces& m_surfaces;
    const LightFrames& m_lights;
    Programs m_programs;
    PassState m_state;
    VertexArrays m_arrays;
    int m_blockers = 0;  ///< what hides the eye, as the light counted last
    CopiedTexture m_mask{}, m_frame{};
    bool m_leavesOutLit = false;
    std::optional<WindowRect> m_darkened{};  ///< by the mask as it was copied last; nothing: all
};

}  // namespace gnomon
