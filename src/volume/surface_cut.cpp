#include "volume/surface_cut.h"

namespace gnomon {

SurfaceCut::SurfaceCut(const Mesh& mesh, const View& view)
    : m_space(mesh, {0, 0, 0, 1}, view), m_window(view) {}

std::span<const SurfacePoint> SurfaceCut::triangles(const glm::uvec3& triangle) {
    const Canonical c = canonical(triangle);
    const auto weightsOf = [&](std::uint32_t vertex) {
        return glm::dvec3(triangle.x == vertex, triangle.y == vertex, triangle.z == vertex);
    };
    double heights[3];
    for (int k = 0; k < 3; ++k) heights[k] = m_space.height({c.triangle[k], false});
    m_polygon.clear();
    m_triangles.clear();
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const Corner a{c.triangle[k], false}, b{c.triangle[next], false};
        if (heights[k] >= 0) m_polygon.push_back({m_space.drawn(a), weightsOf(a.vertex)});
        if ((heights[k] >= 0) != (heights[next] >= 0)) {
            const double ha = std::abs(heights[k]), hb = std::abs(heights[next]);
            m_polygon.push_back(
                {m_space.drawnCut(a, b), (hb * weightsOf(a.vertex) + ha * weightsOf(b.vertex)) / (ha + hb)});
        }
    }
    if (!m_polygon.empty()) appendFan(m_window.cut(m_polygon), c.reversed, m_triangles);
    return m_triangles;
}

}  // namespace gnomon
