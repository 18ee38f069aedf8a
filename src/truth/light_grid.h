#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "truth/predicates.h"
#include "truth/prism.h"

namespace gnomon {

/// The casters' triangles as the light sees them: cells of the six sides of a cube around a point light, or
/// of one plane across the rays of a light at infinity, each with the triangles that may be seen in it, the
/// nearest to the light first. All segments to the light are points here, so a query reads one cell, or the
/// few that its neighbourhood touches, and no tree.
///
/// Where a grid is no help it says so: beside the light, in cells with many triangles, for neighbourhoods of
/// many cells. Then the caller must search otherwise.
class LightGrid {
  public:
    /// @param triangles  those that don't cast are left out
    /// @param light      homogeneous, w 0 or 1
    LightGrid(std::span<const LitTriangle> triangles, const glm::dvec4& light);

    /// Calls @p visit(index, crossed) for each triangle that may cross the segment from any point within
    /// @p radius of @p point to the light, until it returns false; for some more than once. Decided in float
    /// with bounds on every rounding: none is left out, and where @p crossed is Yes, all those segments cross
    /// the triangle; else it is Unsure.
    /// @param error   of the point itself, along each axis; world units
    /// @param radius  world units
    /// @return        false if the grid can't say, though it may have visited some
    template <class Visit>
    bool visit(const glm::dvec3& point, double error, double radius, Visit&& visit) const {
        Spot spot;
        if (!findSpot(point, error + radius, spot)) return false;
        for (const std::uint32_t triangle : m_everywhere)
            if (!visit(triangle, Answer::Unsure)) return true;
        const Face& face = m_faces[spot.face];
        const Range columns = rangeOf(spot.u, spot.spread, face.low.x, face.scale, face.columns);
        const Range rows = rangeOf(spot.v, spot.spread, face.low.y, face.scale, face.rows);
        if (columns.last - columns.first >= kMostCells || rows.last - rows.first >= kMostCells) return false;
        const Probe probe(point, 1.8 * error + radius, m_frame);
        for (int row = rows.first; row <= rows.last; ++row) {
            for (int column = columns.first; column <= columns.last; ++column) {
                const std::uint32_t* start = &m_starts[face.cellAt(row, column)];
                for (std::uint32_t i = start[0]; i < start[1]; ++i) {
                    const Entry entry = m_entries[i];
                    if (entry.nearness < spot.nearness) break;
                    if (entry.prism == kTooMany) return false;
                    const Answer crossed = probe.isIn(m_prisms[entry.prism]);
                    if (crossed != Answer::No && !visit(m_triangles[entry.prism], crossed)) return true;
                }
            }
        }
        return true;
    }

    /// What visit() will read for one point waits in memory; these ask for it ahead, each for what the one
    /// before it has brought.
    struct Place {
        std::size_t cell = kNoCell;
        double nearness = 0;
    };
    Place fetchCell(const glm::dvec3& point) const {
        Spot spot;
        if (!findSpot(point, 0, spot)) return {};
        const Face& face = m_faces[spot.face];
        const double column = (spot.u - face.low.x) * face.scale, row = (spot.v - face.low.y) * face.scale;
        if (!(column >= 0 && column < face.columns && row >= 0 && row < face.rows)) return {};
        const Place place{face.cellAt(int(row), int(column)), spot.nearness};
        __builtin_prefetch(&m_starts[place.cell]);
        return place;
    }
    void fetchEntries(const Place& place) const {
        if (place.cell != kNoCell) __builtin_prefetch(m_entries.data() + m_starts[place.cell]);
    }
    void fetchPrisms(const Place& place) const {
        if (place.cell == kNoCell) return;
        const std::uint32_t first = m_starts[place.cell];
        const std::uint32_t last = std::min(m_starts[place.cell + 1], first + kFetched);
        for (std::uint32_t i = first; i < last && m_entries[i].nearness >= place.nearness; ++i)
            __builtin_prefetch(m_prisms.data() + m_entries[i].prism);
    }

  private:
    /// A triangle in a cell. Nearness falls along each ray from the light: 1/distance along the face's axis,
    /// or -distance for a light at infinity.
    struct Entry {
        std::uint32_t prism = 0;
        float nearness = 0;  ///< no point of the triangle is nearer
    };
    /// One side of the cube, or the plane; its cells cover what triangles are seen in.
    struct Face {
        glm::dvec2 low{1, 1}, high{0, 0};
        double scale = 0;  ///< cells per unit
        int columns = 0, rows = 0;
        std::size_t cells = 0;  ///< the index of its first
        std::size_t cellAt(int row, int column) const { return cells + std::size_t(row) * columns + column; }
    };
    /// Where a point and its neighbourhood are seen.
    struct Spot {
        std::size_t face = 0;
        double u = 0, v = 0, spread = 0;
        double nearness = 0;  ///< of its farthest point
    };
    struct Range {
        int first = 0, last = -1;
    };
    struct Builder;

    static constexpr std::uint32_t kTooMany = ~0u;  ///< stands for the triangles of a cell that has too many
    static constexpr std::size_t kNoCell = ~std::size_t(0);
    static constexpr std::uint32_t kFetched = 8;  ///< prisms of a cell
    static constexpr int kMostCells = 4;          ///< of a neighbourhood, along each axis
    static constexpr double kGuard = 0.02;        ///< by which a side of the cube overlaps the next

    bool findSpot(const glm::dvec3& point, double radius, Spot& spot) const {
        if (!m_isUsable) return false;
        if (m_light.w == 0) {
            const int k = m_axis, i = (k + 1) % 3, j = (k + 2) % 3;
            const double z = -point[k] / m_light[k];
            const double size = std::abs(point.x) + std::abs(point.y) + std::abs(point.z);
            spot.u = point[i] + z * m_light[i];
            spot.v = point[j] + z * m_light[j];
            // No component of the direction is larger than that along the axis.
            spot.spread = 2.01 * radius + kRounding * size;
            spot.nearness = -z - 1.01 * radius / std::abs(m_light[k]) - kRounding * std::abs(z);
            return spot.spread < std::numeric_limits<double>::infinity();
        }
        const glm::dvec3 way = point - glm::dvec3(m_light);
        const glm::dvec3 size = glm::abs(way);
        const int k = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double inverse = 1 / size[k];
        const double share = radius * inverse + kRounding;
        spot.face = std::size_t(2 * k + (way[k] < 0));
        spot.u = way[i] * inverse;
        spot.v = way[j] * inverse;
        spot.spread = 2.01 * share;
        spot.nearness = inverse * (1 - share);
        return spot.spread < kGuard / 2;
    }

    static Range rangeOf(double at, double spread, double low, double scale, int cells) {
        const double first = (at - spread - low) * scale, last = (at + spread - low) * scale;
        if (!(last >= 0 && first < cells)) return {};
        return {first > 0 ? int(first) : 0, last < cells ? int(last) : cells - 1};
    }

    static constexpr double kRounding = 1e-14;

    glm::dvec4 m_light;
    int m_axis = 0;  ///< of the plane, for a light at infinity
    bool m_isUsable = true;
    Face m_faces[6]{};                      ///< by axis, the positive side first; or only the first
    std::vector<std::uint32_t> m_starts{};  ///< by cell, and one behind the last: the first of its entries
    std::vector<Entry> m_entries{};         ///< by cell, the nearest first
    PrismFrame m_frame{};
    std::vector<Prism> m_prisms{};
    std::vector<std::uint32_t> m_triangles{};   ///< by prism
    std::vector<std::uint32_t> m_everywhere{};  ///< so near the light that they may be seen anywhere
};

}  // namespace gnomon
