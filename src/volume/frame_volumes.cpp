#include "volume/frame_volumes.h"

#include <algorithm>

#include "volume/near_cap.h"

namespace gnomon {

FrameVolumes frameVolumes(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                          const View& view, bool nearCap) {
    FrameVolumes volumes;
    const auto append = [&](const LitCaster& one) {
        const NearCut cut = cutAtNearPlane(scene, one, light, view);
        auto& v = volumes.vertices;
        v.insert(v.end(), cut.fronts.begin(), cut.fronts.end());
        v.insert(v.end(), cut.backs.begin(), cut.backs.end());
        if (nearCap && !cut.cap.empty() && touchesNearRectangle(scene, one, light, view))
            v.insert(v.end(), cut.cap.begin(), cut.cap.end());
        volumes.begins.push_back(v.size());
    };
    for (const LitCaster& caster : lit) {
        if (caster.lit.empty()) continue;
        if (!caster.perTriangle) {
            append(caster);
            continue;
        }
        for (std::size_t i = 0; i < caster.lit.size(); ++i) {
            const auto sides = caster.sides.begin() + std::ptrdiff_t(3 * i);
            append({.object = caster.object,
                    .lit = {caster.lit[i]},
                    .sides = {sides, sides + 3},
                    .perTriangle = true});
        }
    }
    return volumes;
}

bool eyeInVolume(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                 const View& view) {
    return std::any_of(lit.begin(), lit.end(),
                       [&](const LitCaster& c) { return touchesNearRectangle(scene, c, light, view); });
}

std::vector<LitCaster> litCasters(const Scene& scene, const glm::vec4& light, Silhouette silhouette) {
    std::vector<LitCaster> lit;
    for (const Caster& caster : casters(scene)) lit.push_back(litCaster(scene, caster, light, silhouette));
    return lit;
}

}  // namespace gnomon
