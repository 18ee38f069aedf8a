#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "plan/plan.h"
#include "predict/seen_window.h"

namespace gnomon {

/// What the pixels of a view see of surfaces, block by block: for each block of pixels a box in world space
/// that holds all points that any of its pixels may see, however a rasteriser rounds corners (to 1/256 pixel)
/// and depths. Shadows can matter only there: the background is never in shadow.
///
/// Within a block the surfaces are kept as a few patches, which are tighter than the box: what lies in one
/// plane is a patch of its own, the small rest is put together by distance.
class Receivers {
  public:
    static constexpr int kBlock = 8;  ///< width and height of a block, pixels
    /// Pixels around a centre that are taken to be seen with it: more than a rasteriser moves corners by.
    static constexpr double kBeside = 1.0 / 64;

    struct Block {
        WindowRect pixels{};       ///< from the lower left corner; cut at the window's borders
        glm::dvec3 low{}, high{};  ///< the box, world space; rounded outwards
        bool seesSurface = false;  ///< else there is no box
        bool seesBackground = false;
    };

    /// A convex piece of space that holds surfaces seen by the pixels of one block: a convex part of the
    /// window between two distances. Both are moved apart by what depths may be off by, so that a face of a
    /// volume which depth comparisons may put on either side of a seen point meets the piece.
    struct Patch {
        WindowRect pixels{};  ///< around the pixels that see it
        std::uint32_t first = 0, corners = 0;
    };

    /// A corner of a patch: a ray and the two distances on it.
    struct Corner {
        glm::dvec3 direction{};  ///< rayDirection(), from the eye
        /// 1 / distance along forward. No surface of the patch lies before the nearer one. Its points over
        /// all corners lie in one plane, and not before the near plane.
        double nearer = 0;
        double farther = 0;  ///< 0: infinite
    };

    explicit Receivers(const SeenWindow& window);

    const std::vector<Block>& blocks() const { return m_blocks; }  ///< rows from the bottom
    int columns() const { return m_columns; }
    int rows() const { return m_rows; }

    const std::vector<Patch>& patches() const { return m_patches; }
    /// In their order around the patch.
    std::span<const Corner> corners(const Patch& patch) const {
        return std::span(m_corners).subspan(patch.first, patch.corners);
    }

  private:
    class Builder;

    int m_columns = 0, m_rows = 0;
    std::vector<Block> m_blocks{};
    std::vector<Patch> m_patches{};
    std::vector<Corner> m_corners{};
};

}  // namespace gnomon
