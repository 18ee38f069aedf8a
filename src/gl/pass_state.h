#pragma once

#include <optional>

#include "gl/table.h"
#include "plan/plan.h"

namespace gnomon {

/// Sets the state of passes. Each pass sets all that it depends on, but for what a chip may lack: that is
/// left as it was.
class PassState {
  public:
    explicit PassState(const GlTable& table) : gl(table) {}

    /// The scissor of a pass; none where it has none.
    void bound(const std::optional<WindowRect>& part);
    /// @param part  of the target; an empty one lets nothing through
    void scissor(const WindowRect& part);
    /// All else that a draw depends on.
    /// @param reference  of the stencil test
    void set(const Pass& pass, int reference);
    void colourMask(const ColourWrite& w) { gl.ColorMask(w.red, w.green, w.blue, w.alpha); }
    void stencilMask(unsigned mask) {
        if (mask != m_stencilMask) gl.StencilMask(m_stencilMask = mask);
    }

    /// OpenGL's defaults of what is kept between passes, so that decorators know of it.
    void setDefaults();

  private:
    void turn(GLenum what, bool& is, bool on);

    const GlTable& gl;
    BlendEquation m_equation = BlendEquation::Add;
    unsigned m_stencilMask = ~0u;
    bool m_logicOp = false, m_alphaTest = false, m_scissorTest = false;
    std::optional<WindowRect> m_scissor{};  ///< none before the first
};

/// Back to OpenGL's defaults, past all decorators.
void resetState(const GlTable& driver);

}  // namespace gnomon
