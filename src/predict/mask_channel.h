#pragma once

#include <optional>

#include "plan/plan.h"
#include "profile/frame_channel.h"

namespace gnomon {

/// The arithmetic of the buffer that holds a mask.
struct MaskChannel {
    bool openGl =
        true;  ///< OpenGL's blending on 8 bits, of which the nearest code is stored; else the chip's
    BlendUnit unit = BlendUnit::IdealRound;
    DitherMode dither = DitherMode::Off;  ///< while masks are drawn
    ColourFormat format{};
    int channel = 0;  ///< which one the mask is read from: 0 to 2 of colour, 3 for alpha

    int bits() const;

    /// Pixels along each axis after which the dither matrix repeats; 1 without one.
    int period() const { return channel < 3 && dithers(dither, bits()) ? 4 : 1; }
};

/// The code to which a clear to @p value (0..1) sets the channel at pixel (x, y) of the window, rows from the
/// top.
int clearedTo(const MaskChannel& mask, int x, int y, float value);

/// What one fragment of @p pass, a volume's or a rectangle's, makes of a code there; none if the blend unit
/// has no such operation.
std::optional<int> blendedCode(const MaskChannel& mask, int x, int y, const Pass& pass, int code);

/// What a stencil test of @p test, for a front or back face, makes of a value.
int stencilled(const Stencil& test, bool front, bool depthPasses, int value);

/// Whether a fragment @p where with regard to what the depth buffer holds passes the depth test of @p pass.
bool passesDepth(const Pass& pass, bool nearer, bool equal);

}  // namespace gnomon
