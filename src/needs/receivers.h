#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "plan/plan.h"
#include "predict/seen_window.h"

namespace gnomon {

/// What the pixels of a view see of surfaces, block by block: for each block of pixels a box in world space
/// that holds all points that any of its pixels may see, however a rasteriser rounds corners (to 1/256 pixel)
/// and depths. Shadows can matter only there: the background is never in shadow.
class Receivers {
  public:
    static constexpr int kBlock = 8;  ///< width and height of a block, pixels

    struct Block {
        WindowRect pixels{};       ///< from the lower left corner; cut at the window's borders
        glm::dvec3 low{}, high{};  ///< the box, world space; rounded outwards
        bool seesSurface = false;  ///< else there is no box
        bool seesBackground = false;
    };

    explicit Receivers(const SeenWindow& window);

    const std::vector<Block>& blocks() const { return m_blocks; }  ///< rows from the bottom
    int columns() const { return m_columns; }
    int rows() const { return m_rows; }

  private:
    int m_columns = 0, m_rows = 0;
    std::vector<Block> m_blocks{};
};

}  // namespace gnomon
