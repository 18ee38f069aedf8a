#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "cost/touched.h"
#include "gl/light_frame.h"
#include "matrix/frame_scene.h"
#include "method/method.h"
#include "needs/minimal_plan.h"
#include "plan/plan.h"
#include "profile/profile.h"

namespace gnomon {

/// How a cell is drawn.
struct Drawing {
    Axes axes{};  ///< by which its passes are made
    Plan plan{};
    bool isFull = true;                                 ///< all volumes in the window are drawn
    std::vector<std::vector<std::uint32_t>> volumes{};  ///< else these, by light
    std::vector<EffectNote> notes{};
};

Drawing drawingOf(MinimalPlan plan);

/// The volumes of light @p index that are drawn.
std::shared_ptr<const FrameVolumes> drawnVolumes(FrameScene& frame, const Profile& profile,
                                                 const Drawing& drawing, int index);

/// What each light adds to the frame; the one that was asked for last is kept. All three arguments must
/// outlive it.
LightFrames lightFrames(FrameScene& frame, const Profile& profile, const Drawing& drawing);

/// What each pass draws. What a geometry shader makes is about what the host would.
std::vector<DrawnAmount> amountsOf(FrameScene& frame, const Profile& profile, const Drawing& drawing);

}  // namespace gnomon
