#include "scene/hard_case.h"

#include <fmt/format.h>

#include <array>

namespace gnomon {

std::span<const std::string_view> hardOptions() {
    static constexpr std::array<std::string_view, 14> kFlags{
        "store", "arithmetic", "levels", "count", "silhouette", "mask-scale", "apply",
        "start", "overflow",   "caps",   "clip",  "offset",     "map-size",   "map-bias",
    };
    return kFlags;
}

std::string argumentsOf(const HardCell& cell) {
    std::string text = fmt::format("--method {} --profile {}", cell.method, cell.profile);
    for (const auto& [flag, value] : cell.options) text += fmt::format(" --{} {}", flag, value);
    if (cell.fidelity != "gl") text += fmt::format(" --fidelity {}", cell.fidelity);
    if (cell.dithers) text += " --dither on";
    if (cell.frame != 0) text += fmt::format(" --frame {}", cell.frame);
    if (cell.width != 320 || cell.height != 240)
        text += fmt::format(" --size {}x{}", cell.width, cell.height);
    return text;
}

}  // namespace gnomon
