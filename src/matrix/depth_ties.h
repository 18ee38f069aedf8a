#pragma once

#include "profile/profile.h"
#include "truth/truth.h"

namespace gnomon {

/// The ties of a chip's depth format (profile/depth.h).
DepthTies tiesOf(int bits, DepthEncoding encoding);

}  // namespace gnomon
