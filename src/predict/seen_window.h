#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "predict/seen_surfaces.h"

namespace gnomon {

/// What every pixel of a frame may see: SeenSurfaces of the whole window, kept.
class SeenWindow {
  public:
    /// @param scene  must outlive it
    SeenWindow(const Scene& scene, const View& view, const DepthTies& ties);
    SeenWindow(const SeenWindow&) = delete;
    SeenWindow& operator=(const SeenWindow&) = delete;

    const Scene& scene() const { return m_scene; }
    const View& view() const { return m_surfaces.view(); }
    /// What depths near 1 / @p inverse may be off by, in window depth.
    double bandOf(double inverse) const { return m_surfaces.bandOf(inverse); }

    /// By pixel, rows from the top; the surface that is seen in exact arithmetic first.
    std::span<const Seen> at(std::size_t pixel) const {
        return std::span(m_seen).subspan(m_first[pixel], m_first[pixel + 1] - m_first[pixel]);
    }

  private:
    const Scene& m_scene;
    SeenSurfaces m_surfaces;
    std::vector<std::size_t> m_first{};
    std::vector<Seen> m_seen{};
};

}  // namespace gnomon
