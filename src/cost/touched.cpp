#include "cost/touched.h"

#include <array>
#include <cassert>
#include <map>
#include <optional>
#include <tuple>

#include "cost/coverage.h"

namespace gnomon {
namespace {

/// Measures passes; what several of them draw into the same rectangle is measured once.
class Measure {
  public:
    Measure(const Plan& plan, const FrameSurfaces& surfaces, const LightFrames& lights)
        : m_plan(plan), m_surfaces(surfaces), m_lights(lights) {}

    DrawnAmount of(const Pass& pass) {
        DrawnAmount out;
        switch (pass.kind) {
            case PassKind::Clear:
                if (pass.write.any() || pass.clearsDepth || pass.clearsStencil)
                    out.pixels.clear = areaOf(rectOf(pass));
                break;
            case PassKind::Scene:
                scene(pass, out);
                break;
            case PassKind::Volume:
                volume(pass, out);
                break;
            case PassKind::Rectangle:
                out.pixels.rectangle = areaOf(rectOf(pass));
                out.vertices = 4;
                break;
            case PassKind::Copy:
                out.pixels.copy = texelsOf(pass);
                break;
        }
        return out;
    }

  private:
    struct Viewport {
        int width = 0, height = 0;
    };

    Viewport viewportOf(const Pass& pass) const {
        switch (pass.target) {
            case Target::Window:
                break;
            case Target::Mask:
                return {m_plan.maskWidth, m_plan.maskHeight};
            case Target::DepthMap:
                return {m_plan.mapSize, m_plan.mapSize};
            case Target::OnePixel:
                return {1, 1};
        }
        return {m_plan.width, m_plan.height};
    }

    /// The mask window of the pass's light; none where the pass isn't bounded.
    const MaskWindow* windowOf(const Pass& pass) const {
        if (pass.extent == Extent::Whole) return nullptr;
        assert(std::size_t(pass.light) < m_plan.windows.size());
        return &m_plan.windows[std::size_t(pass.light)];
    }

    /// What the pass may change; of volumes that have rectangles of their own, what holds them all.
    WindowRect rectOf(const Pass& pass) const {
        if (const MaskWindow* window = windowOf(pass)) return window->all;
        // A clear is bounded by a scissor alone, not by the viewport.
        const Viewport v = pass.kind == PassKind::Clear && pass.target != Target::DepthMap
                               ? Viewport{m_plan.width, m_plan.height}
                               : viewportOf(pass);
        return {0, 0, v.width, v.height};
    }

    static std::int64_t areaOf(const WindowRect& r) {
        return r.empty() ? 0 : std::int64_t(r.width) * r.height;
    }

    /// With the last row and column, which are copied once more where the texture is larger.
    std::int64_t texelsOf(const Pass& pass) const {
        const auto side = [](int pixels, int texels) { return std::int64_t(pixels) + (pixels < texels); };
        if (pass.frameTexture)
            return side(m_plan.width, m_plan.frameTextureWidth) *
                   side(m_plan.height, m_plan.frameTextureHeight);
        return side(m_plan.maskWidth, m_plan.textureWidth) * side(m_plan.maskHeight, m_plan.textureHeight);
    }

    void scene(const Pass& pass, DrawnAmount& out) {
        const bool isMap = pass.target == Target::DepthMap;
        const auto triangles = [&]() -> std::span<const glm::vec4> {
            if (!isMap) return m_surfaces.positions;
            return m_lights(pass.light).depthMap.faces[std::size_t(pass.mapFace)];
        };
        const int light = isMap ? pass.light : kSurfaces, face = isMap ? pass.mapFace : 0;
        add(pass, {light, face, kAllVolumes}, triangles, rectOf(pass), out.pixels.scene, out.vertices);
        if (!drawsBackdrop(pass)) return;
        out.pixels.scene += areaOf(rectOf(pass));
        out.vertices += 6;
    }

    void volume(const Pass& pass, DrawnAmount& out) {
        if (pass.drawn == Drawn::Blockers) {
            const auto blockers = [&]() -> std::span<const glm::vec4> {
                return m_lights(pass.light).blockers;
            };
            return add(pass, {pass.light, kBlockers, kAllVolumes}, blockers, rectOf(pass), out.pixels.volume,
                       out.vertices);
        }
        const bool byShader = pass.drawn == Drawn::Silhouettes;
        const LightFrame& light = m_lights(pass.light);
        const auto casters = std::int64_t(light.silhouettes.indices.size());
        if (!byShader || light.volumes) {
            const Parts parts = byShader ? Part::Sides | Part::FarCap : pass.parts;
            for (int part = 0; part < kParts; ++part)
                if (parts.has(Part(part))) volumePart(pass, Part(part), out);
        }
        if (byShader) out.vertices = casters;
    }

    void volumePart(const Pass& pass, Part part, DrawnAmount& out) {
        const auto one = [&](int index, const WindowRect& rect) {
            const auto triangles = [&]() -> std::span<const glm::vec4> {
                const FrameVolumes& volumes = *m_lights(pass.light).volumes;
                return index == kAllVolumes ? volumes.all(part) : volumes.of(part, std::size_t(index));
            };
            add(pass, {pass.light, int(part), index}, triangles, rect, out.pixels.volume, out.vertices);
        };
        const MaskWindow* window = windowOf(pass);
        if (pass.extent != Extent::Volumes) {
            one(pass.volume, rectOf(pass));
        } else if (pass.volume != kAllVolumes) {
            one(pass.volume, window->volumes[std::size_t(pass.volume)]);
        } else {
            for (std::size_t i = 0; i < window->volumes.size(); ++i) one(int(i), window->volumes[i]);
        }
    }

    /// Which triangles: of a light or the surfaces, a part or map face or the blockers, of one volume or all.
    using Source = std::tuple<int, int, int>;
    static constexpr int kSurfaces = -1, kBlockers = kParts;

    struct Measured {
        SidesCovered sides{};
        std::int64_t vertices = 0;
    };

    template <class Triangles>
    void add(const Pass& pass, const Source& source, const Triangles& triangles, const WindowRect& rect,
             std::int64_t& pixels, std::int64_t& vertices) {
        if (rect.empty()) return;
        const Viewport view = viewportOf(pass);
        const Key key{pass.target, source, rect.x, rect.y, rect.width, rect.height, pass.depthClamp};
        auto known = m_known.find(key);
        if (known == m_known.end()) {
            const std::span<const glm::vec4> all = triangles();
            const Measured measured{covered(all, view.width, view.height, rect, pass.depthClamp),
                                    std::int64_t(all.size())};
            known = m_known.emplace(key, measured).first;
        }
        const auto& [sides, count] = known->second;
        if (pass.kind == PassKind::Scene || pass.faces != Faces::Back) pixels += sides.front;
        if (pass.kind == PassKind::Scene || pass.faces != Faces::Front) pixels += sides.back;
        vertices += count;
    }

    using Key = std::tuple<Target, Source, int, int, int, int, bool>;
    const Plan& m_plan;
    const FrameSurfaces& m_surfaces;
    const LightFrames& m_lights;
    std::map<Key, Measured> m_known{};
};

}  // namespace

TouchedPixels& operator+=(TouchedPixels& a, const TouchedPixels& b) {
    a.clear += b.clear, a.scene += b.scene, a.volume += b.volume, a.rectangle += b.rectangle,
        a.copy += b.copy;
    return a;
}

std::vector<DrawnAmount> drawnAmounts(const Plan& plan, const FrameSurfaces& surfaces,
                                      const LightFrames& lights) {
    Measure measure(plan, surfaces, lights);
    std::vector<DrawnAmount> amounts;
    for (const Pass& pass : plan.passes) amounts.push_back(measure.of(pass));
    return amounts;
}

DrawnAmount sumOf(const std::vector<DrawnAmount>& passes) {
    DrawnAmount sum;
    for (const DrawnAmount& one : passes) sum.pixels += one.pixels, sum.vertices += one.vertices;
    return sum;
}

DrawnAmount drawnAmount(const Plan& plan, const FrameSurfaces& surfaces, const LightFrames& lights) {
    return sumOf(drawnAmounts(plan, surfaces, lights));
}

TouchedPixels touchedPixels(const Plan& plan, const FrameSurfaces& surfaces, const LightFrames& lights) {
    return drawnAmount(plan, surfaces, lights).pixels;
}

}  // namespace gnomon
