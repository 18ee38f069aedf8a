#pragma once

#include <optional>

#include "method/method.h"
#include "predict/mask_channel.h"

namespace gnomon {

/// What the finished mask of a lit pixel holds.
struct FinishedMask {
    float value = 1;         ///< 0..1: a clear to it makes the same codes in all channels and pixels
    bool isNeutral = false;  ///< the scene comes out under it as without a mask
};

/// @param one      a frame of one light
/// @param channel  the chip's arithmetic; of its channels those of the store are looked at
/// @return nothing if no clear makes the codes that a lit pixel ends with
std::optional<FinishedMask> finishedMask(const Axes& axes, const FrameShape& one, const Profile& profile,
                                         const MaskChannel& channel);

/// The least number of volumes around a point, up to @p most, with which the mask's finished value is another
/// by @p a than by @p b, in any channel or pixel; entries and exits that cancel are not looked at. Nothing if
/// there is none.
std::optional<int> firstDifference(const Axes& a, const Axes& b, const FrameShape& one,
                                   const Profile& profile, const MaskChannel& channel, int most);

/// How much one ray may cross.
struct MostCrossed {
    int around = 0;   ///< volumes around the point
    int crossed = 0;  ///< volumes that it enters and leaves again
    int levels = 0;   ///< volumes around the point, and entries into one that is folded
};

/// Whether volumes that a ray enters and leaves again leave the mask as it would be without them. Else the
/// arithmetic leaves a residue.
bool facesCancel(const Axes& axes, const FrameShape& one, const Profile& profile, const MaskChannel& channel,
                 const MostCrossed& most);

}  // namespace gnomon
