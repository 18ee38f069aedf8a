#include "scene/hard_case.h"

#include <fmt/format.h>

#include <array>

namespace gnomon {

std::span<const std::string_view> causeNames() {
    static constexpr std::array<std::string_view, 23> kNames{
        "mask clamps",
        "mask underflows",
        "mask wraps",
        "stencil saturates",
        "stencil wraps to zero",
        "eye inside a volume",
        "eye on a face of a volume",
        "near plane cuts a volume",
        "far plane",
        "depth precision",
        "low mask resolution",
        "background at infinity inside a volume",
        "own cap and side within a few depth quanta",
        "parity of overlapping volumes",
        "open or inconsistently wound caster",
        "inside of a caster",
        "volume begins behind its caster",
        "rounding residue",
        "dither drift",
        "shadow-map resolution",
        "shadow-map bias",
        "no shadow is drawn",
        "unexplained",
    };
    return kNames;
}

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
