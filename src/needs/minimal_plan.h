#pragma once

#include <string>
#include <vector>

#include "method/method.h"
#include "needs/effects.h"
#include "predict/mask_channel.h"
#include "volume/nesting.h"

namespace gnomon {

/// What is known of one light's volumes in one frame; all tests behind it are conservative.
struct LightNeeds {
    bool isBlack = false;                 ///< gives nothing to any surface that is seen
    std::vector<WindowRect> windows{};    ///< Reach, of each volume that the full plan draws; mask pixels
    std::vector<double> nearDistances{};  ///< likewise, world units
    bool isClosed = true;                 ///< the faces of each volume close it
    bool isTooDeep = false;               ///< volumes may nest deeper than the full plan's count holds
    bool eyeIsOnFace = false;
    bool backgroundInCaps = true;       ///< the background may be seen where a volume reaches to infinity
    Nesting fromEye{}, fromInfinity{};  ///< of the volumes that matter
};

/// What is known of one frame.
struct FrameNeeds {
    std::vector<LightNeeds> lights{};
    bool ambientIsBlack = false;
    double nearestSurface = 0;  ///< surfaceDistance(), world units
};

/// One effect in one plan: whether it is there, and the fact that calls for it or allows to leave it out,
/// with numbers: "nearest volume is 1.21 units from the near rectangle".
struct EffectNote {
    Effect effect{};
    int light = -1;  ///< -1: of the frame
    bool isDrawn = false;
    bool isAsked = false;  ///< it is there only because the caller wants it
    std::string fact{};
};

/// A plan that simulates what a frame calls for, and why.
struct MinimalPlan {
    Plan plan{};
    Axes axes{};                              ///< those that it is made by: another count, fewer levels
    std::vector<std::vector<int>> volumes{};  ///< by light: which of the full plan's volumes it draws
    std::vector<EffectNote> notes{};
};

/// The plan for @p axes with what the frame calls for and @p wanted: its mask and image are those of
/// planFrame() to the bit.
///
/// @param frame    of the full plan
/// @param channel  the chip's arithmetic of the mask's channel: an omission that would change a value is not
///                 made
MinimalPlan minimalPlan(const Axes& axes, const FrameShape& frame, const Profile& profile,
                        const FrameNeeds& needs, const MaskChannel& channel, const Effects& wanted);

}  // namespace gnomon
