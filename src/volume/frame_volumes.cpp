#include "volume/frame_volumes.h"

#include <algorithm>

#include "volume/clip_space.h"
#include "volume/near_cap.h"
#include "volume/window_clip.h"

namespace gnomon {

FrameVolumes frameVolumes(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                          const View& view, Parts parts, const CutStyle& style) {
    FrameVolumes volumes;
    WindowClip<glm::vec4> window(view);
    const PolygonSink sink = [&](Part part, std::span<const glm::vec4> polygon, bool reversed) {
        const bool isSurface = part == Part::NearCap || part == Part::LightCap;
        const bool uncut = style.clip != Clip::Frustum && !isSurface;
        appendFan(uncut ? polygon : window.cut(polygon), reversed, volumes.parts[std::size_t(part)].vertices);
    };
    const auto isOpen = [](const FrameVolumes::Runs& runs) {
        return runs.vertices.size() > runs.begins.back();
    };
    std::uint32_t ordinal = 0;
    const auto append = [&](const LitCaster& one) {
        ++ordinal;
        cutVolume(scene, one, light, view, parts, style, sink);
        auto& caps = volumes.parts[std::size_t(Part::NearCap)];
        if (isOpen(caps) && !touchesNearRectangle(scene, one, light, view))
            caps.vertices.resize(caps.begins.back());
        if (std::none_of(volumes.parts.begin(), volumes.parts.end(), isOpen)) return;
        for (auto& runs : volumes.parts) runs.begins.push_back(runs.vertices.size());
        volumes.ordinals.push_back(ordinal - 1);
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

FrameVolumes only(const FrameVolumes& volumes, std::span<const std::uint32_t> ordinals) {
    FrameVolumes kept;
    kept.ordinals.assign(ordinals.begin(), ordinals.end());
    for (const std::uint32_t ordinal : ordinals) {
        const auto at = std::lower_bound(volumes.ordinals.begin(), volumes.ordinals.end(), ordinal);
        const bool isThere = at != volumes.ordinals.end() && *at == ordinal;
        for (int part = 0; part < kParts; ++part) {
            FrameVolumes::Runs& runs = kept.parts[std::size_t(part)];
            if (isThere) {
                const auto faces = volumes.of(Part(part), std::size_t(at - volumes.ordinals.begin()));
                runs.vertices.insert(runs.vertices.end(), faces.begin(), faces.end());
            }
            runs.begins.push_back(runs.vertices.size());
        }
    }
    return kept;
}

bool eyeInVolume(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                 const View& view) {
    return std::any_of(lit.begin(), lit.end(),
                       [&](const LitCaster& c) { return touchesNearRectangle(scene, c, light, view); });
}

}  // namespace gnomon
