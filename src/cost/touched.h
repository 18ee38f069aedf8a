#pragma once

#include <cstdint>

#include "gl/light_frame.h"
#include "plan/plan.h"

namespace gnomon {

/// Pixels that the passes of a frame touch, by what they draw: those that are rasterised within the scissor,
/// whether they then pass their tests or not. A property of plan and frame, not of the machine.
struct TouchedPixels {
    std::int64_t clear = 0, scene = 0, volume = 0, rectangle = 0;
    std::int64_t copy = 0;  ///< texels
    std::int64_t total() const { return clear + scene + volume + rectangle + copy; }
    bool operator==(const TouchedPixels&) const = default;
};

TouchedPixels& operator+=(TouchedPixels& a, const TouchedPixels& b);

/// What pass @p index of @p plan touches.
TouchedPixels touchedPixels(const Plan& plan, std::size_t index, const FrameSurfaces& surfaces,
                            const LightFrames& lights);

/// What all passes touch.
TouchedPixels touchedPixels(const Plan& plan, const FrameSurfaces& surfaces, const LightFrames& lights);

}  // namespace gnomon
