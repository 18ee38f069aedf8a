#include "gl/chip_arithmetic.h"

#include <algorithm>

namespace gnomon {

const char* name(Fidelity fidelity) {
    return fidelity == Fidelity::Chip ? "chip" : "gl";
}

ChipArithmetic arithmeticOf(const Profile& profile, Fidelity fidelity) {
    if (fidelity == Fidelity::Gl) return {};
    ChipArithmetic chip{.fidelity = fidelity, .unit = profile.blendUnit()};
    const std::vector<DitherMode>& modes = profile.ditherModes;
    if (!modes.empty()) {
        chip.dither = modes.front();
        const bool canDoWithout = std::find(modes.begin(), modes.end(), DitherMode::Off) != modes.end();
        chip.undithered = canDoWithout ? DitherMode::Off : modes.front();
    }
    if (!profile.depthEncodings.empty()) chip.depth = profile.depthEncodings.front();
    return chip;
}

}  // namespace gnomon
