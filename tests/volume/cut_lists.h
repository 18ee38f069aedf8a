#pragma once

#include <array>
#include <vector>

#include "volume/clip_space.h"
#include "volume/volume_cut.h"

namespace gnomon {

constexpr Parts kAllParts = Part::Sides | Part::NearFaces | Part::FarCap | Part::LightCap | Part::NearCap;

/// The parts of one volume as triangle lists, not cut at the window's sides.
struct CutLists {
    std::array<std::vector<glm::vec4>, kParts> lists{};
    std::vector<glm::vec4>& operator[](Part part) { return lists[std::size_t(part)]; }
    const std::vector<glm::vec4>& operator[](Part part) const { return lists[std::size_t(part)]; }
};

inline CutLists listsOf(const Scene& scene, const LitCaster& caster, const glm::vec4& light, const View& view,
                        Parts parts = kAllParts, const CutStyle& style = {}) {
    CutLists lists;
    cutVolume(scene, caster, light, view, parts, style,
              [&](Part part, std::span<const glm::vec4> polygon, bool reversed) {
                  appendFan(polygon, reversed, lists[part]);
              });
    return lists;
}

}  // namespace gnomon
