#include "matrix/cell.h"

#include <fmt/format.h>

#include <array>

namespace gnomon {

std::string Cell::id() const {
    return fmt::format("{}/{}/{}/{}x{}/{}", profile, method, scene, width, height, frame);
}

std::string Cell::question() const {
    std::string text = fmt::format("{} {} {}", id(), name(axes.shade), fidelity);
    if (dithers) text += " dither";
    if (!blendUnit.empty()) text += " " + blendUnit;
    if (effects != Effects::all() && drawnBy.empty()) text += " effects " + toString(effects);
    for (const auto& [flag, value] : view) text += fmt::format(" {} {}", flag, value);
    return text;
}

const std::string& name(Verdict verdict) {
    static const std::array<std::string, kVerdicts> names{"exact", "edge", "wrong", "refused", "failed"};
    return names[std::size_t(verdict)];
}

const std::string& name(Proof proof) {
    static const std::array<std::string, kProofs> names{"predicted", "drawn", "none", "refused"};
    return names[std::size_t(proof)];
}

}  // namespace gnomon
