#pragma once

#include <optional>

#include "gl/chip_arithmetic.h"
#include "method/method.h"
#include "needs/effects.h"
#include "profile/profile.h"

namespace gnomon {

/// One way to draw a frame, to be timed beside others.
/// @pre the chip lacks nothing for it, and the axes are not automatic
struct TimedWay {
    Profile profile{};
    Axes axes{};
    FidelityChoice fidelity{};
    std::optional<Effects> effects{};  ///< as Lab::simulate() takes them
    bool shaderVolumes = false;        ///< withShaderVolumes()
};

/// What drawing a frame once took, milliseconds.
struct FrameTime {
    double buildMs = 0;  ///< on the host: silhouettes found, volumes built and cut, or casters sorted by face
    double drawMs = 0;   ///< OpenGL calls until they are finished: see Stopwatch
    double maskMs = 0;   ///< of drawMs: from the first pass that draws volumes or casters to the last; 0
                         ///< unless times were asked for by pass
    double total() const { return buildMs + drawMs; }
};

}  // namespace gnomon
