#include "gl/chip_arithmetic.h"

#include <algorithm>

namespace gnomon {

const char* name(Fidelity fidelity) {
    return fidelity == Fidelity::Chip ? "chip" : "gl";
}

ChipArithmetic arithmeticOf(const Profile& profile, const FidelityChoice& choice) {
    if (choice.fidelity == Fidelity::Gl)
        return {.wraps = profile.blendEquations.contains(BlendEquation::AddWrap)};
    const auto lists = [](const auto& list, const auto& value) {
        return std::find(list.begin(), list.end(), value) != list.end();
    };
    ChipArithmetic chip{.fidelity = choice.fidelity, .unit = profile.blendUnit()};
    if (choice.unit && lists(profile.blendUnits, *choice.unit)) chip.unit = *choice.unit;
    const std::vector<DitherMode>& modes = profile.ditherModes;
    if (!modes.empty()) chip.dither = modes.front();
    const bool canDoWithout = modes.empty() || lists(modes, DitherMode::Off);
    if (choice.dithers || !canDoWithout) chip.undithered = chip.dither;
    if (!profile.depthEncodings.empty()) chip.depth = profile.depthEncodings.front();
    return chip;
}

}  // namespace gnomon
