#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "matrix/lab.h"
#include "scenes.h"

// What a way of drawing shows of a scene, and how two of these differ.

namespace gnomon {

/// A chip and a method.
struct Way {
    Profile profile{};
    Axes axes{};

    std::string name() const { return profile.id + "/" + methodId(axes); }
    /// Whether volumes that are not convex may come out otherwise in another order: a mask that doubles or
    /// halves clamps, and then has lost what a later volume would take back.
    bool dependsOnOrder() const {
        const bool clamps = axes.arithmetic == Arithmetic::Double || axes.arithmetic == Arithmetic::Halve;
        return clamps && axes.silhouette != Silhouette::PerTriangle;
    }
};

struct Shown {
    Cell cell{};
    Pictures pictures{};
};

constexpr int kShownWidth = 48, kShownHeight = 36;

inline Shown shown(Lab& lab, const Way& way, int frame = 0) {
    Shown out;
    out.cell = lab.run(way.profile, way.axes, kShownWidth, kShownHeight, frame, &out.pictures);
    return out;
}

/// What is not the same in both: the verdict, or the shadow in the mask or in truth of a pixel that is tied
/// in neither. Empty if nothing.
inline std::string difference(const Shown& a, const Shown& b) {
    std::string text;
    if (a.cell.verdict != b.cell.verdict) text += resultOf(a.cell) + " becomes " + resultOf(b.cell) + "; ";
    if (a.pictures.mask.data.size() != b.pictures.mask.data.size()) return text + "other pictures";
    int masks = 0, truths = 0;
    for (std::size_t i = 0; i < a.pictures.mask.data.size(); ++i) {
        const auto tied = [&](const Shown& d) {
            return d.pictures.judgement.pixels[i] == PixelVerdict::Tied;
        };
        if (tied(a) || tied(b)) continue;
        const bool mask = a.pictures.mask.data[i] != b.pictures.mask.data[i];
        const bool truth = a.pictures.truth.data[i] != b.pictures.truth.data[i];
        if (mask || truth)
            text += fmt::format("({}, {}) ", i % std::size_t(a.cell.width), i / std::size_t(a.cell.width));
        masks += mask, truths += truth;
    }
    if (masks) text += fmt::format("{} pixels of the mask ", masks);
    if (truths) text += fmt::format("{} pixels of truth ", truths);
    return text;
}

}  // namespace gnomon
