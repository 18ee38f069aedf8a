#include "truth/light_grid.h"

#include <algorithm>
#include <array>

namespace gnomon {
namespace {

constexpr double kNearLight = 1e-6;   ///< of its size: a triangle as near as that is looked for everywhere
constexpr double kMargin = 1e-6;      ///< of a cell, by which all are larger than they are
constexpr int kMostAlongAxis = 8192;  ///< cells
constexpr double kCellsPerTriangle = 2, kEntriesPerTriangle = 12;
constexpr std::uint32_t kMostInCell = 128;   ///< beyond that a tree is faster
constexpr std::size_t kMostEverywhere = 16;  ///< that each query looks at

/// A corner on one side of the cube: along it, and towards it.
struct Corner {
    double u = 0, v = 0, z = 0;
};

/// A convex polygon: a triangle cut by four planes.
struct Polygon {
    std::array<Corner, 7> corners{};
    int count = 0;
};

/// The part with a >= 0, where @p a is linear.
template <class Linear>
Polygon cut(const Polygon& polygon, Linear&& a) {
    Polygon out;
    for (int k = 0; k < polygon.count; ++k) {
        const Corner &p = polygon.corners[k], &q = polygon.corners[(k + 1) % polygon.count];
        const double atP = a(p), atQ = a(q);
        if (atP >= 0) out.corners[out.count++] = p;
        if ((atP >= 0) == (atQ >= 0)) continue;
        const double s = atP / (atP - atQ);
        out.corners[out.count++] = {p.u + s * (q.u - p.u), p.v + s * (q.v - p.v), p.z + s * (q.z - p.z)};
    }
    return out;
}

float above(double value) {
    return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

PrismFrame frameOf(std::span<const LitTriangle> triangles, std::span<const std::uint32_t> casters,
                   const glm::dvec4& light) {
    PrismFrame frame{.base = light.w == 0 ? glm::dvec3(triangles[casters[0]].corners[0]) : glm::dvec3(light)};
    for (const std::uint32_t index : casters) {
        const glm::dvec3 off = glm::abs(glm::dvec3(triangles[index].corners[0]) - frame.base);
        frame.distance += (off.x + off.y + off.z) / double(casters.size());
    }
    frame.distance = std::max(frame.distance, std::numeric_limits<double>::min());
    return frame;
}

}  // namespace

/// What triangles look like on the faces, before there are cells.
struct LightGrid::Builder {
    /// A triangle, or its part on one side of the cube, in the face's units.
    struct Shape {
        std::uint32_t prism = 0, firstCorner = 0;
        std::uint8_t face = 0, corners = 0;
        float nearness = 0;
        double slack = 0;  ///< that corners may be wrong by
    };
    struct Sums {
        double count = 0, lengths = 0, areas = 0;
    };

    explicit Builder(LightGrid& of) : grid(of) {}

    void add(std::uint32_t index, const LitTriangle& triangle) {
        grid.m_light.w == 0 ? addParallel(index, triangle) : addCentral(index, triangle);
    }

    void addParallel(std::uint32_t index, const LitTriangle& triangle) {
        const int k = grid.m_axis, i = (k + 1) % 3, j = (k + 2) % 3;
        double size = 0, nearest = std::numeric_limits<double>::infinity();
        glm::dvec2 at[3];
        for (int c = 0; c < 3; ++c) {
            const glm::dvec3 p = triangle.corners[c];
            const double z = -p[k] / grid.m_light[k];
            at[c] = {p[i] + z * grid.m_light[i], p[j] + z * grid.m_light[j]};
            nearest = std::min(nearest, z);
            size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z), std::abs(z)});
        }
        addShape(
            {.prism = index, .nearness = above(-nearest + kRounding * size), .slack = 4 * kRounding * size},
            at);
    }

    void addCentral(std::uint32_t index, const LitTriangle& triangle) {
        glm::dvec3 p[3];
        double size = 0;
        for (int c = 0; c < 3; ++c) {
            p[c] = glm::dvec3(triangle.corners[c]) - glm::dvec3(grid.m_light);
            size = std::max({size, std::abs(p[c].x), std::abs(p[c].y), std::abs(p[c].z)});
        }
        // Mostly all of it is on one side of the cube, and no part on another.
        for (std::uint8_t face = 0; face < 6; ++face) {
            Polygon polygon = seenOn(face, p);
            const bool isInside =
                std::all_of(polygon.corners.begin(), polygon.corners.begin() + 3, [](const Corner& corner) {
                    return std::max(std::abs(corner.u), std::abs(corner.v)) < (1 - kGuard) * corner.z;
                });
            if (isInside) return addPolygon(index, face, polygon, size);
        }
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double height = std::abs(glm::dot(normal, p[0])), length = glm::length(normal);
        const double longest =
            std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
        if (!(height > kNearLight * size * length || glm::length(p[0]) - longest > kNearLight * size))
            return grid.m_everywhere.push_back(grid.m_triangles[index]);
        for (std::uint8_t face = 0; face < 6; ++face) {
            Polygon polygon = seenOn(face, p);
            for (const double side : {1.0, -1.0}) {
                polygon = cut(polygon, [&](const Corner& c) { return (1 + kGuard) * c.z - side * c.u; });
                polygon = cut(polygon, [&](const Corner& c) { return (1 + kGuard) * c.z - side * c.v; });
            }
            if (polygon.count > 0) addPolygon(index, face, polygon, size);
        }
    }

    static Polygon seenOn(std::uint8_t face, const glm::dvec3 (&p)[3]) {
        const int k = face / 2, i = (k + 1) % 3, j = (k + 2) % 3;
        const double side = face % 2 == 0 ? 1 : -1;
        Polygon polygon{.count = 3};
        for (int c = 0; c < 3; ++c) polygon.corners[c] = {p[c][i], p[c][j], side * p[c][k]};
        return polygon;
    }

    void addPolygon(std::uint32_t index, std::uint8_t face, const Polygon& polygon, double size) {
        double nearest = std::numeric_limits<double>::infinity();
        glm::dvec2 at[7];
        for (int c = 0; c < polygon.count; ++c) {
            const Corner& corner = polygon.corners[c];
            nearest = std::min(nearest, corner.z);
            at[c] = glm::dvec2(corner.u, corner.v) / corner.z;
        }
        if (!(nearest > kNearLight / 10 * size)) return grid.m_everywhere.push_back(grid.m_triangles[index]);
        const double slack = kRounding * size / nearest;
        addShape({.prism = index, .face = face, .nearness = above((1 + slack) / nearest), .slack = slack},
                 std::span(at, std::size_t(polygon.count)));
    }

    void addShape(Shape shape, std::span<const glm::dvec2> at) {
        shape.firstCorner = std::uint32_t(corners.size());
        shape.corners = std::uint8_t(at.size());
        corners.insert(corners.end(), at.begin(), at.end());
        shapes.push_back(shape);

        const auto [low, high] = boundsOf(shape);
        Face& face = grid.m_faces[shape.face];
        if (face.low.x > face.high.x) face.low = low, face.high = high;
        face.low = glm::min(face.low, low), face.high = glm::max(face.high, high);
        const glm::dvec2 extent = high - low;
        Sums& sum = sums[shape.face];
        sum.count += 1, sum.lengths += extent.x + extent.y, sum.areas += extent.x * extent.y;
    }

    std::span<const glm::dvec2> cornersOf(const Shape& shape) const {
        return {&corners[shape.firstCorner], shape.corners};
    }

    std::pair<glm::dvec2, glm::dvec2> boundsOf(const Shape& shape) const {
        glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
        for (const glm::dvec2& corner : cornersOf(shape))
            low = glm::min(low, corner), high = glm::max(high, corner);
        return {low - shape.slack, high + shape.slack};
    }

    /// Cells about as large as triangles; larger ones where triangles overlap much.
    void chooseCells() {
        std::size_t cells = 0;
        for (std::size_t f = 0; f < std::size(grid.m_faces); ++f) {
            Face& face = grid.m_faces[f];
            const Sums& sum = sums[f];
            if (sum.count == 0) continue;
            glm::dvec2 extent = face.high - face.low;
            const double longer =
                std::max({extent.x, extent.y, std::numeric_limits<double>::min() / kMargin});
            face.low -= kMargin * longer, face.high += kMargin * longer;
            extent = face.high - face.low;
            face.scale = std::min(std::sqrt(kCellsPerTriangle * sum.count / (extent.x * extent.y)),
                                  (kMostAlongAxis - 1) / longer);
            const auto entries = [&] {
                return sum.count + face.scale * sum.lengths + face.scale * face.scale * sum.areas;
            };
            while (entries() > kEntriesPerTriangle * sum.count && face.scale * longer > 1) face.scale *= 0.8;
            face.columns = int(extent.x * face.scale) + 1;
            face.rows = int(extent.y * face.scale) + 1;
            face.cells = cells;
            cells += std::size_t(face.columns) * face.rows;
        }
        grid.m_starts.assign(cells + 1, 0);
    }

    /// Calls @p put(cell) for each cell that the shape may touch.
    template <class Put>
    void forCells(const Shape& shape, Put&& put) const {
        const Face& face = grid.m_faces[shape.face];
        const auto [low, high] = boundsOf(shape);
        const Range columns = rangeOf(low.x, high.x, face.low.x, face.scale, face.columns);
        const Range rows = rangeOf(low.y, high.y, face.low.y, face.scale, face.rows);
        const std::span<const glm::dvec2> at = cornersOf(shape);

        // Each edge's function, positive inside, at the corner of a cell where it is largest.
        struct Edge {
            double x = 0, y = 0, constant = 0;
        };
        std::array<Edge, 7> edges;
        double area = 0;
        for (std::size_t k = 0; k < at.size(); ++k) {
            const glm::dvec2 p = at[k] - low, q = at[(k + 1) % at.size()] - low;
            area += p.x * q.y - p.y * q.x;
        }
        const double cell = 1 / face.scale, extent = high.x - low.x + high.y - low.y + 4 * cell;
        const double slack = 8 * (shape.slack + kRounding) * extent;
        // Which way round is not certain of a triangle seen edge-on.
        std::size_t count = 0;
        if (std::abs(area) > 8 * slack && (columns.last > columns.first || rows.last > rows.first)) {
            const double side = area > 0 ? 1 : -1;
            for (std::size_t k = 0; k < at.size(); ++k) {
                const glm::dvec2 way = side * (at[(k + 1) % at.size()] - at[k]);
                Edge& edge = edges[count++];
                edge = {-way.y, way.x, 0};
                const glm::dvec2 from = at[k] - face.low;
                edge.constant = slack - edge.x * from.x - edge.y * from.y +
                                (std::max(edge.x, 0.0) + std::max(edge.y, 0.0)) * cell +
                                (std::abs(edge.x) + std::abs(edge.y)) * kMargin * cell;
            }
        }
        for (int row = rows.first; row <= rows.last; ++row) {
            for (int column = columns.first; column <= columns.last; ++column) {
                const double x = column * cell, y = row * cell;
                bool isBeside = false;
                for (std::size_t k = 0; k < count && !isBeside; ++k)
                    isBeside = edges[k].x * x + edges[k].y * y + edges[k].constant < 0;
                if (!isBeside) put(face.cellAt(row, column));
            }
        }
    }

    static Range rangeOf(double low, double high, double start, double scale, int cells) {
        const double first = (low - start) * scale - kMargin, last = (high - start) * scale + kMargin;
        return {std::clamp(int(std::max(first, 0.0)), 0, cells - 1),
                std::clamp(int(std::max(last, 0.0)), 0, cells - 1)};
    }

    void fillCells() {
        std::vector<std::uint32_t>& starts = grid.m_starts;
        for (const Shape& shape : shapes) forCells(shape, [&](std::size_t cell) { ++starts[cell]; });
        // A cell with too many keeps one entry that says so.
        std::vector<bool> isFull(starts.size());
        std::uint32_t sum = 0;
        for (std::size_t cell = 0; cell < starts.size(); ++cell) {
            isFull[cell] = starts[cell] > kMostInCell;
            sum += isFull[cell] ? 1 : starts[cell];
            starts[cell] = sum;
        }
        grid.m_entries.resize(sum);
        // From the ends, so that starts end up as starts.
        for (const Shape& shape : shapes)
            forCells(shape, [&](std::size_t cell) {
                if (!isFull[cell]) grid.m_entries[--starts[cell]] = {shape.prism, shape.nearness};
            });
        for (std::size_t cell = 0; cell + 1 < starts.size(); ++cell) {
            if (isFull[cell])
                grid.m_entries[--starts[cell]] = {kTooMany, std::numeric_limits<float>::infinity()};
        }
        for (std::size_t cell = 0; cell + 1 < starts.size(); ++cell)
            std::sort(grid.m_entries.begin() + starts[cell], grid.m_entries.begin() + starts[cell + 1],
                      [](const Entry& a, const Entry& b) { return a.nearness > b.nearness; });
    }

    LightGrid& grid;
    std::vector<Shape> shapes{};
    std::vector<glm::dvec2> corners{};
    Sums sums[6]{};
};

LightGrid::LightGrid(std::span<const LitTriangle> triangles, const glm::dvec4& light) : m_light(light) {
    const glm::dvec3 size = glm::abs(glm::dvec3(light));
    m_axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if (triangles[i].casts) m_triangles.push_back(std::uint32_t(i));
    if (m_triangles.empty()) return;
    m_frame = frameOf(triangles, m_triangles, light);
    Builder builder(*this);
    m_prisms.reserve(m_triangles.size());
    for (std::size_t i = 0; i < m_triangles.size(); ++i) {
        const LitTriangle& triangle = triangles[m_triangles[i]];
        builder.add(std::uint32_t(i), triangle);
        m_prisms.emplace_back(triangle, light, m_frame);
    }
    m_isUsable = m_everywhere.size() <= kMostEverywhere && (light.w != 0 || size[m_axis] > 0);
    if (!m_isUsable) return;
    builder.chooseCells();
    builder.fillCells();
}

}  // namespace gnomon
