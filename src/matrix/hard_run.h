#pragma once

#include <filesystem>

#include "gl/chip_arithmetic.h"
#include "matrix/lab.h"
#include "predict/causes.h"
#include "profile/profile.h"
#include "scene/hard_case.h"

namespace gnomon {

/// A hard case's cell with its words resolved.
struct HardRun {
    Profile profile{};
    Axes axes{};
    FidelityChoice fidelity{};
    Cause cause = Cause::None;  ///< why it must be wrong; None where it must be exact
    int width = 0, height = 0, frame = 0;
};

/// @param profiles  the folder of the chips
/// @throws std::runtime_error of one line for words that mean nothing here
HardRun resolve(const HardCell& cell, const std::filesystem::path& profiles);

/// Draws and judges it; @p lab is of the case's scene.
Cell run(Lab& lab, const HardRun& what);

}  // namespace gnomon
