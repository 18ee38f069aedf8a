#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "gl/counter.h"
#include "gl/light_frame.h"
#include "gl/surface.h"
#include "gl/vertex_arrays.h"
#include "image/image.h"
#include "plan/plan.h"

namespace gnomon {

/// What one frame showed and cost.
struct Rendered {
    Image image{};  ///< RGB, rows from the top
    /// By light; per pixel of the window, rows from the top: the mask calls it a shadow.
    std::vector<std::vector<bool>> masks{};
    /// The same masks as they stand: stencil values, counts of 16 bits, or 8 bits of the mask's channel.
    std::vector<std::vector<std::uint16_t>> values{};
    CallCounts counts{};
    double cpuMs = 0;  ///< time of the frame's OpenGL calls, until they are finished: see Stopwatch
    /// By pass; empty unless RenderOptions asks for it.
    std::vector<double> passMs{};             ///< its part of cpuMs
    std::vector<std::int64_t> passSamples{};  ///< fragments that passed all tests
};

/// Called after each pass, with its index, while the buffers stand as it left them.
using AfterPass = std::function<void(std::size_t pass)>;

/// What render() does besides drawing.
struct RenderOptions {
    std::function<void(std::size_t pass)> beforePass{};  ///< called with the index of each pass as it begins
    AfterPass afterPass{};
    bool timesPasses = false;    ///< waits after each pass; the frame takes a little longer
    bool countsSamples = false;  ///< by occlusion queries
    /// By default the host's memory where the processor draws, which gains nothing by buffers; else buffers.
    std::optional<VertexSource> vertices{};
};

/// Runs the passes of @p plan on @p surface through @p profile's capability layer, and reads the result.
///
/// @pre the surface has plan.width x plan.height pixels and the profile's buffers
/// @throws CapabilityViolation  the plan uses what the chip lacks
/// @throws std::runtime_error   an OpenGL error, naming the pass
Rendered render(Surface& surface, const Profile& profile, const Plan& plan, const FrameSurfaces& surfaces,
                const LightFrames& lights, const RenderOptions& options = {});

/// The colour buffer as it stands: RGB, or RGBA where @p alpha; rows from the top.
Image readColour(Surface& surface, bool alpha = false);

/// The stencil buffer as it stands, one channel, 8 bits, rows from the top.
/// @pre the surface has one
Image readStencil(Surface& surface);

}  // namespace gnomon
