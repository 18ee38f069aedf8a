#pragma once

#include <string>
#include <vector>

#include "gl/buffer_format.h"
#include "gl/chip_arithmetic.h"
#include "method/method.h"
#include "volume/volume_cut.h"

namespace gnomon {

/// What the frame's volumes are cut from and how; everything about them but the light.
struct VolumeKey {
    Silhouette silhouette = Silhouette::Winding;
    CapFaces capFaces = CapFaces::Lit;
    Parts parts{};
    CutStyle style{};
    friend auto operator<=>(const VolumeKey&, const VolumeKey&) = default;
};

/// All that a result depends on besides the frame: the buffers, the passes with their states, and how volumes
/// are built.
/// @param kept  by light: the volumes that a minimal plan draws
std::string resultKey(const BufferFormat& format, const ChipArithmetic& chip, const Plan& plan,
                      const Axes& axes, const std::vector<VolumeKey>& volumes,
                      const std::vector<std::vector<std::uint32_t>>& kept = {});

}  // namespace gnomon
