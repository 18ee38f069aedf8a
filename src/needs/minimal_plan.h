#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "method/method.h"
#include "needs/effects.h"
#include "predict/mask_channel.h"
#include "volume/nesting.h"

namespace gnomon {

/// What is known of one light's volumes in one frame; all tests behind it are conservative. Volumes are
/// numbered as FrameVolumes::ordinals says.
struct LightNeeds {
    int brightest = 255;                  ///< the most that it gives to any surface that is seen, 0 to 255
    std::vector<WindowRect> windows{};    ///< Reach; mask pixels
    std::vector<double> nearDistances{};  ///< Reach; world units
    std::vector<bool> isDrawn{};          ///< by the full plan: some face is in the window
    bool isClosed = true;                 ///< the faces of each volume close it
    bool eyeIsOnFace = false;             ///< of a volume
    bool seesBackground = true;           ///< some pixel does
    bool seesBackgroundInWindows = true;  ///< some pixel in a volume's window does
    /// What is left out changes no mask, though counts may come to their limits or leave a residue: known in
    /// another way. Else the bounds below and the chip's arithmetic tell.
    bool losesNothing = false;
    Nesting full{};     ///< of all volumes, from the end from which the full plan counts
    Nesting fromEye{};  ///< of those with a window
};

/// What is known of one frame.
struct FrameNeeds {
    std::vector<LightNeeds> lights{};
    int brightestAmbient = 255;  ///< of any surface that is seen, 0 to 255
    double nearestSurface = 0;   ///< surfaceDistance(), world units
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
    Axes axes{};         ///< those that it is made by: another count, fewer levels
    bool isFull = true;  ///< no mask pass differs from the full plan's, and it draws the same volumes
    /// By light: the volumes that it draws, in its order, as LightNeeds numbers them. Only if it isn't full.
    std::vector<std::vector<std::uint32_t>> volumes{};
    std::vector<EffectNote> notes{};
};

/// Whether the full plan's masks may lose entries or exits, or keep a residue of them, so that leaving out
/// volumes could be seen: then LightNeeds::losesNothing decides.
bool mayLoseCounts(const Axes& axes, const FrameShape& frame, const Profile& profile, const FrameNeeds& needs,
                   const MaskChannel& channel);

/// The plan for @p axes with what the frame calls for and @p wanted: its mask and image are those of
/// planFrame() to the bit.
///
/// @param frame    of the full plan
/// @param channel  the chip's arithmetic of the mask's channel: an omission that would change a value is not
///                 made
MinimalPlan minimalPlan(const Axes& axes, const FrameShape& frame, const Profile& profile,
                        const FrameNeeds& needs, const MaskChannel& channel, const Effects& wanted);

}  // namespace gnomon
