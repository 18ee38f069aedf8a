#pragma once

namespace gnomon {

/// From now on memory that is freed stays with this process, large pieces too. What is measured then does not
/// depend on which pieces the system takes back between frames and must clear anew: that is half of the time
/// of a frame with a depth map of 2048 texels per side, and it comes and goes.
void keepFreedMemory();

}  // namespace gnomon
