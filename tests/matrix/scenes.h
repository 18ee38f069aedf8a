#pragma once

#include <filesystem>
#include <string>

#include "matrix/run.h"
#include "profile/shipped.h"
#include "scene/load.h"

namespace gnomon {

inline const std::filesystem::path kSource = GNOMON_SOURCE;

inline Scene shippedScene(const std::string& id) {
    return loadScene(kSource / "scenes" / (id + ".toml"));
}

inline Axes method(const std::string& id) {
    return findMethod(id)->axes;
}

/// @p axes with another silhouette.
inline Axes with(Axes axes, Silhouette silhouette) {
    axes.silhouette = silhouette;
    return axes;
}

/// @p axes with another way to count.
inline Axes with(Axes axes, Count count) {
    axes.count = count;
    return axes;
}

/// "exact 0/0", or what is wrong with the cell.
inline std::string resultOf(const Cell& cell) {
    std::string text = name(cell.verdict) + " " + std::to_string(cell.wrongEdge) + "/" +
                       std::to_string(cell.wrongInterior) + cell.error;
    for (const auto& [cause, pixels] : cell.causes) text += ", " + cause + ": " + std::to_string(pixels);
    for (const Missing& m : cell.missing) text += ", lacks " + m.what;
    return text;
}

}  // namespace gnomon
