#pragma once

#include "gl/buffer_format.h"
#include "plan/plan.h"

namespace gnomon {

/// Channels of a surface that no pass of a plan reads, and no mask of it stands in: a clear may write them
/// too. Drivers clear whole words faster than parts of them: alpha lies beside colour, stencil beside depth.
struct FreeChannels {
    bool alpha = false, stencil = false;
    bool operator==(const FreeChannels&) const = default;
};

/// @return only channels that @p profile's chip has and that were chosen for its @p buffers
FreeChannels freeChannels(const Plan& plan, const Profile& profile, const BufferFormat& buffers);

}  // namespace gnomon
