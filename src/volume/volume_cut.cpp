#include "volume/volume_cut.h"

#include "volume/clip_space.h"
#include "volume/near_cap.h"

namespace gnomon {
namespace {

std::span<const glm::vec4> pointsOf(const ClipPolygon& polygon) {
    return {polygon.begin(), std::size_t(polygon.size())};
}

}  // namespace

void cutVolume(const Scene& scene, const LitCaster& caster, const glm::vec4& light, const View& view,
               Parts parts, const CutStyle& style, const PolygonSink& sink) {
    const ClipSpace space(scene.objects[caster.object].mesh, light, view, style.offset);
    const auto visible = [&](const Face& face) {
        return style.clip == Clip::Frustum ? space.beyond(face)
               : style.clip == Clip::Eye   ? space.inFront(face)
                                           : space.whole(face);
    };
    const auto add = [&](Part part, const ClipPolygon& polygon, bool reversed, int times = 1) {
        if (polygon.size() < 3) return;
        for (int i = 0; i < times; ++i) sink(part, pointsOf(polygon), reversed);
    };

    if (parts.has(Part::Sides) || parts.has(Part::NearFaces)) {
        const bool near = parts.has(Part::NearFaces) && style.clip == Clip::Frustum;
        for (const Side& side : caster.sides) {
            // Sides that hang from one edge in opposite directions are the same face.
            const bool reversed = side.from < side.to;
            const Face face =
                reversed ? sideFace(space, side.to, side.from) : sideFace(space, side.from, side.to);
            if (parts.has(Part::Sides)) add(Part::Sides, visible(face), reversed, side.weight);
            if (near) add(Part::NearFaces, space.before(face, style.flatten), reversed, side.weight);
        }
    }
    if (parts.has(Part::FarCap) && !space.directional())
        for (const glm::uvec3& t : caster.lit) add(Part::FarCap, visible(farCap(t)), false);
    if (parts.has(Part::LightCap)) {
        for (const glm::uvec3& t : caster.lit) {
            const Canonical c = canonical(t);
            add(Part::LightCap, space.beyond(lightCap(c.triangle)), c.reversed);
        }
    }
    if (parts.has(Part::NearFaces)) {
        for (const glm::uvec3& t : caster.lit) {
            const Canonical c = canonical(t);
            add(Part::NearFaces, space.before(lightCap(c.triangle), style.flatten), c.reversed);
        }
    }
    if (parts.has(Part::NearCap))
        for (const glm::uvec3& t : caster.lit) add(Part::NearCap, nearCap(space, t), false);
}

}  // namespace gnomon
