#include "predict/seen_window.h"

namespace gnomon {

SeenWindow::SeenWindow(const Scene& scene, const View& view, const DepthTies& ties)
    : m_scene(scene), m_surfaces(scene, surfaceFaces(scene), view, ties, view.width, 16) {
    m_first.reserve(std::size_t(view.width) * std::size_t(view.height) + 1);
    for (int band = m_surfaces.blockRows() - 1; band >= 0; --band) {
        const PixelBlock block = m_surfaces.block(0, band);
        const auto found = m_surfaces.find(0, band);
        for (int row = block.top - 1; row >= block.bottom; --row) {
            for (int column = 0; column < view.width; ++column) {
                const std::vector<Seen>& seen = found[block.slot(column, row)];
                m_first.push_back(m_seen.size());
                m_seen.insert(m_seen.end(), seen.begin(), seen.end());
            }
        }
    }
    m_first.push_back(m_seen.size());
}

}  // namespace gnomon
