#include "predict/map_depths.h"

#include <algorithm>
#include <cmath>

#include "volume/map_casters.h"

namespace gnomon {
namespace {

constexpr int kTile = 16;  ///< texels per side

/// How far a stored depth of 24 bits may be from that of the plane: half a quantum by rounding it, the rest
/// by the interpolation in floats. With 1.5 quanta llvmpipe leaves the first pixels unpredicted (boxes, knot,
/// roettger; maps of 256 and 1024; no bias and 0.001).
const double kMapBand = std::ldexp(4.0, -24);

}  // namespace

struct MapDepths::Tile {
    PixelBlock block{};
    std::array<std::uint32_t, kTile * kTile + 1> first{};
    std::vector<StoredDepth> stored{};
};

MapDepths::MapDepths(const Scene& scene, const glm::vec4& light, int size)
    : m_map(lightMap(scene, light, size)), m_size(size) {
    std::vector<SurfaceFace> casters;
    eachMapCaster(scene, light, [&](std::uint32_t object, const glm::uvec3& triangle) {
        casters.push_back({object, triangle});
    });
    const Rays rays = m_map.parallel ? Rays::Parallel : Rays::FromEye;
    for (const View& face : m_map.faces)
        m_faces.emplace_back(scene, casters, face, DepthTies{.countBand = kMapBand}, kTile, kTile, rays);
    for (const SeenSurfaces& face : m_faces)
        m_tiles.emplace_back(std::size_t(face.blockColumns()) * std::size_t(face.blockRows()));
}

MapDepths::~MapDepths() = default;

std::span<const StoredDepth> MapDepths::at(int face, int x, int y) {
    SeenSurfaces& surfaces = m_faces[std::size_t(face)];
    const int column = x / kTile, row = y / kTile;
    auto& tile = m_tiles[std::size_t(face)]
                        [std::size_t(row) * std::size_t(surfaces.blockColumns()) + std::size_t(column)];
    if (!tile) {
        auto made = std::make_unique<Tile>();
        made->block = surfaces.block(column, row);
        std::size_t slot = 0;
        for (const std::vector<Seen>& texel : surfaces.find(column, row)) {
            for (const Seen& seen : texel)
                made->stored.push_back(
                    seen.face ? StoredDepth{seen.inverse, kMapBand + kCorner * glm::length(seen.slope)}
                              : StoredDepth{});
            made->first[++slot] = std::uint32_t(made->stored.size());
        }
        tile = std::move(made);
    }
    const std::size_t slot = tile->block.slot(x, y);
    return std::span(tile->stored).subspan(tile->first[slot], tile->first[slot + 1] - tile->first[slot]);
}

double MapDepths::along(int face, double x, double y, const SurfaceFace& own, bool uncut) const {
    const SeenSurfaces& surfaces = m_faces[std::size_t(face)];
    const auto tileAt = [&](double at) { return std::clamp(int(at), 0, m_size - 1) / kTile; };
    const View& view = surfaces.view();
    double nearest = 0;
    for (const std::uint32_t index : surfaces.facesIn(tileAt(x), tileAt(y))) {
        const SurfaceFace& caster = surfaces.face(index);
        if (caster.object == own.object && caster.corners == own.corners) continue;
        const Cone cone = surfaces.coneOf(caster);
        if (cone.isEmpty() || !cone.holds({view.eye, rayDirection(view, x, y)}, x, y)) continue;
        const double inverse = cone.inverseDistance().at(x, y);
        if (uncut || view.nearPlane * inverse <= 1) nearest = std::max(nearest, inverse);
    }
    return nearest;
}

}  // namespace gnomon
