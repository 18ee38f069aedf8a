#pragma once

#include <cstdint>

#include "gl/light_frame.h"
#include "plan/plan.h"

namespace gnomon {

/// Pixels that the passes of a frame touch, by what they draw: those that are rasterised within the scissor,
/// whether they then pass their tests or not, once for each face that covers them. A property of plan and
/// frame, not of the machine.
struct TouchedPixels {
    std::int64_t clear = 0, scene = 0, volume = 0, rectangle = 0;
    std::int64_t copy = 0;  ///< texels
    std::int64_t total() const { return clear + scene + volume + rectangle + copy; }
    bool operator==(const TouchedPixels&) const = default;
};

TouchedPixels& operator+=(TouchedPixels& a, const TouchedPixels& b);

/// What passes draw, and what of it they touch.
struct DrawnAmount {
    TouchedPixels pixels{};
    std::int64_t vertices = 0;  ///< sent to the chip; of volumes whose rectangle is empty none are
    bool operator==(const DrawnAmount&) const = default;
};

/// The amount of all passes.
DrawnAmount sumOf(const std::vector<DrawnAmount>& passes);

/// What each pass of @p plan draws, in their order.
///
/// A clear touches its pixels once, however many buffers it clears. A scene that meets a mask in the colour
/// buffer touches the whole window once more, for what lies at infinity.
///
/// Volumes that a geometry shader makes are not known here: they touch what the sides and far caps of
/// LightFrame::volumes do where these are given, else nothing. Their vertices are those sent to the shader.
std::vector<DrawnAmount> drawnAmounts(const Plan& plan, const FrameSurfaces& surfaces,
                                      const LightFrames& lights);

/// What all passes draw.
DrawnAmount drawnAmount(const Plan& plan, const FrameSurfaces& surfaces, const LightFrames& lights);

/// What all passes touch.
TouchedPixels touchedPixels(const Plan& plan, const FrameSurfaces& surfaces, const LightFrames& lights);

}  // namespace gnomon
