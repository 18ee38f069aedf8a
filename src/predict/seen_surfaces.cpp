#include "predict/seen_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gnomon {

std::vector<SurfaceFace> surfaceFaces(const Scene& scene) {
    std::vector<SurfaceFace> faces;
    for (std::uint32_t o = 0; o < scene.objects.size(); ++o)
        for (const glm::uvec3& t : scene.objects[o].mesh.triangles) faces.push_back({o, t});
    return faces;
}

SeenSurfaces::SeenSurfaces(const Scene& scene, std::vector<SurfaceFace> faces, const View& view,
                           const DepthTies& ties, int blockWidth, int blockHeight, Rays rays)
    : m_scene(&scene),
      m_faces(std::move(faces)),
      m_view(view),
      m_ties(ties),
      m_blockWidth(blockWidth),
      m_blockHeight(blockHeight),
      m_blockColumns((view.width + blockWidth - 1) / blockWidth),
      m_blockRows((view.height + blockHeight - 1) / blockHeight),
      m_rays(rays) {
    m_blocks.resize(std::size_t(m_blockColumns) * std::size_t(m_blockRows));
    for (std::uint32_t i = 0; i < m_faces.size(); ++i) {
        const PixelBlock block = reach(m_faces[i]);
        if (block.isEmpty()) continue;
        for (int row = block.bottom / blockHeight; row * blockHeight < block.top; ++row)
            for (int column = block.left / blockWidth; column * blockWidth < block.right; ++column)
                m_blocks[std::size_t(row) * std::size_t(m_blockColumns) + std::size_t(column)].push_back(i);
    }
    m_hits.resize(std::size_t(blockWidth) * std::size_t(blockHeight));
}

PixelBlock SeenSurfaces::block(int column, int row) const {
    return {column * m_blockWidth, row * m_blockHeight, std::min((column + 1) * m_blockWidth, m_view.width),
            std::min((row + 1) * m_blockHeight, m_view.height)};
}

Cone SeenSurfaces::coneOf(const SurfaceFace& face) const {
    const glm::dvec3 a = at(face, 0), b = at(face, 1), c = at(face, 2);
    return m_rays == Rays::Parallel ? Cone::parallel(m_view, a, b, c) : Cone::triangle(m_view, a, b, c);
}

PixelBlock SeenSurfaces::reach(const SurfaceFace& face) const {
    std::array<glm::dvec3, 3> corners;
    for (int k = 0; k < 3; ++k) corners[std::size_t(k)] = at(face, k) - m_view.eye;
    if (m_rays == Rays::Parallel) {
        glm::dvec2 least(m_view.width, m_view.height), most(0);
        for (const glm::dvec3& corner : corners) {
            const glm::dvec2 p = parallelPosition(m_view, corner);
            least = glm::min(least, p), most = glm::max(most, p);
        }
        return blockAround(m_view, least, most);
    }
    if (const auto block = blockOf(m_view, corners)) return *block;
    if (coneOf(face).missesWindow(m_view.width, m_view.height, kCorner)) return {};
    return {0, 0, m_view.width, m_view.height};
}

std::span<const std::vector<Seen>> SeenSurfaces::find(int column, int row) {
    const PixelBlock pixels = block(column, row);
    for (std::size_t slot = 0; slot < pixels.pixels(); ++slot) m_hits[slot].clear();
    for (const std::uint32_t i : facesIn(column, row)) findFace(m_faces[i], pixels);
    for (std::size_t slot = 0; slot < pixels.pixels(); ++slot) keepVisible(m_hits[slot]);
    return {m_hits.data(), pixels.pixels()};
}

void SeenSurfaces::findFace(const SurfaceFace& face, const PixelBlock& block) {
    const Cone cone = coneOf(face);
    const glm::dvec2 slope = depthSlope(cone.inverseDistance(), m_view.nearPlane);
    const double nearSlack = kCorner * glm::length(slope) + kNearRounding;
    eachPixel(cone, m_view, block, [&](std::size_t slot, double x, double y, bool isSure, bool holds) {
        const double inverse = cone.inverseDistance().at(x, y);
        const double depth = 1 - m_view.nearPlane * inverse;
        if (depth < -nearSlack) return;
        m_hits[slot].push_back({&face, inverse, slope, isSure && depth > nearSlack, holds && depth >= 0});
    });
}

/// Leaves the surfaces that may be seen, the one that is seen in exact arithmetic first; the background where
/// there may be none.
void SeenSurfaces::keepVisible(std::vector<Seen>& hits) const {
    if (hits.size() == 1 && hits.front().isSure) return;
    std::optional<Seen> sure;
    std::size_t nearest = hits.size();
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits[i].isSure && (!sure || hits[i].inverse > sure->inverse)) sure = hits[i];
        // Of surfaces at one depth any is as good.
        if (hits[i].holds && (nearest == hits.size() || hits[i].inverse > hits[nearest].inverse)) nearest = i;
    }
    const bool holdsAny = nearest < hits.size();
    if (holdsAny)
        std::rotate(hits.begin(), hits.begin() + std::ptrdiff_t(nearest),
                    hits.begin() + std::ptrdiff_t(nearest) + 1);
    else
        hits.insert(hits.begin(), Seen{});
    if (sure) {
        const double band = bandOf(sure->inverse);
        const auto isBehind = [&](const Seen& seen) {
            const double behind = m_view.nearPlane * (sure->inverse - seen.inverse);
            return behind > band + kCorner * glm::length(sure->slope - seen.slope);
        };
        hits.erase(std::remove_if(hits.begin() + 1, hits.end(), isBehind), hits.end());
    } else if (holdsAny) {
        hits.push_back({});
    }
}

}  // namespace gnomon
