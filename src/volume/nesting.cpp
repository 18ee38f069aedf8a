// Faces are counted by their outlines: a count over the window is the sum of its steps across edges, and at
// an edge that two entries share there is none. So only outlines are walked, row by row, and moving each step
// out by the margin gives the largest count near each pixel centre, without counting neighbours twice.

#include "volume/nesting.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <vector>

#include "volume/volume_cut.h"
#include "volume/window_clip.h"

namespace gnomon {
namespace {

/// Pixels: a corner is rounded by 1/512 along either axis; the rest is for what rounding to float does.
constexpr double kMargin = 1.0 / 256;
/// Of depth in -1..1, whose floats have 24 bits.
constexpr double kDepthMargin = 1e-6;
/// Pixels by which a corner may be off before it is snapped, in 512 and more.
constexpr double kCornerError = 1e-4;
/// Of one row of a face; and crossings of single rays. Some tenths of a second.
constexpr std::size_t kMostRows = 4'000'000, kMostCrossings = 10'000'000;

/// A corner of a face in the window: pixels, y up, and depth in -1..1.
using Point = glm::dvec3;

/// How the counts of entries and exits step across an edge, from left to right or at a level one from below.
struct Edge {
    glm::dvec2 low{}, high{};  ///< by y, then by x
    int entries = 0, exits = 0;
    auto ends() const { return std::tuple(low.y, low.x, high.y, high.x); }
};

/// A count over all pixels, as differences along the rows.
class CountImage {
  public:
    CountImage(int width, int height)
        : m_width(width),
          m_height(height),
          m_steps(std::size_t(width + 1) * std::size_t(height)),
          m_firstRow(height) {}

    /// Adds what lies to the right of the edge, moved out by the margin.
    void step(const Edge& edge, int by) {
        const double left = std::min(edge.low.x, edge.high.x) - kMargin;
        const double right = std::max(edge.low.x, edge.high.x) + kMargin;
        const double rise = edge.high.y - edge.low.y;
        const double slope = rise > 0 ? (edge.high.x - edge.low.x) / rise : 0;
        const double beside = kMargin * std::sqrt(1 + slope * slope);
        const int first = rowFrom(edge.low.y), last = rowFrom(edge.high.y);
        const double move = by > 0 ? -beside : beside;
        touch(first, last);
        for (int row = first; row < last; ++row) {
            const double x = std::clamp(edge.low.x + (row + 0.5 - edge.low.y) * slope + move, left, right);
            add(row, by > 0 ? columnFrom(x) : columnAfter(x), by);
        }
        // Rows whose centres lie just beyond the ends: whatever is there may be seen across the edge.
        const auto atEnd = [&](const glm::dvec2& end, double onward, int row) {
            const double reach = rise > kMargin ? onward * slope * kMargin : onward * (right - left);
            const double a = std::clamp(std::min(end.x, end.x + reach) - kMargin, left, right);
            const double b = std::clamp(std::max(end.x, end.x + reach) + kMargin, left, right);
            touch(row, row + 1);
            add(row, columnFrom(a), std::abs(by));
            add(row, columnAfter(b), -std::abs(by));
        };
        for (int row = rowFrom(edge.low.y - kMargin); row < first; ++row) atEnd(edge.low, 1, row);
        const int end = rowAfter(edge.high.y + kMargin);
        for (int row = last; row < end; ++row) atEnd(edge.high, -1, row);
    }

    /// Empties it, having called @p visit(pixel, count) for all pixels of the rows that were touched.
    template <class Visit>
    void take(const Visit& visit) {
        for (int row = m_firstRow; row < m_endRow; ++row) {
            int* steps = &m_steps[std::size_t(row) * std::size_t(m_width + 1)];
            int count = 0;
            for (int x = 0; x < m_width; ++x) {
                count += steps[x];
                visit(std::size_t(row) * std::size_t(m_width) + std::size_t(x), count);
            }
            std::fill(steps, steps + m_width + 1, 0);
        }
        m_firstRow = m_height, m_endRow = 0;
    }

  private:
    /// The first of @p all pixels whose centre is at @p position or beyond; and the first beyond.
    static int from(double position, int all) {
        const double shifted = std::clamp(position - 0.5, 0.0, double(all));
        const int below = int(shifted);
        return below + (below < shifted);
    }
    static int after(double position, int all) { return int(std::clamp(position + 0.5, 0.0, double(all))); }
    int rowFrom(double y) const { return from(y, m_height); }
    int rowAfter(double y) const { return after(y, m_height); }
    int columnFrom(double x) const { return from(x, m_width); }
    int columnAfter(double x) const { return after(x, m_width); }

    void touch(int first, int end) {
        if (first < end) m_firstRow = std::min(m_firstRow, first), m_endRow = std::max(m_endRow, end);
    }
    void add(int row, int column, int by) {
        m_steps[std::size_t(row) * std::size_t(m_width + 1) + std::size_t(column)] += by;
    }

    int m_width, m_height;
    std::vector<int> m_steps;
    int m_firstRow, m_endRow = 0;
};

/// One polygon of a volume.
struct WindowFace {
    std::size_t firstPoint = 0;
    int points = 0;
    int volume = 0;
    bool enters = false;
};

/// Depth over one face, as seen from where the count starts: a plane, and how far off it may be.
struct DepthPlane {
    Point at{};
    glm::dvec2 gradient{};
    double slack = 0, nearest = 0, farthest = 0;

    explicit DepthPlane(std::span<const Point> points) : at(points[0]), nearest(at.z), farthest(at.z) {
        glm::dvec3 normal(0);
        double length = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Point &a = points[i], &b = points[(i + 1) % points.size()];
            normal += glm::cross(a - at, b - at);
            length = std::max(length, glm::distance(glm::dvec2(a), glm::dvec2(b)));
            nearest = std::min(nearest, a.z), farthest = std::max(farthest, a.z);
        }
        slack = farthest - nearest;
        if (normal.z == 0) return;
        gradient = -glm::dvec2(normal) / normal.z;
        const double corners = kCornerError * length / std::abs(normal.z);  // over the width of the face
        slack = kMargin * (std::abs(gradient.x) + std::abs(gradient.y)) + corners * slack;
    }

    double before(const glm::dvec2& p) const {
        return std::clamp(on(p) - slack, nearest, farthest) - kDepthMargin;
    }
    double behind(const glm::dvec2& p) const {
        return std::clamp(on(p) + slack, nearest, farthest) + kDepthMargin;
    }

  private:
    double on(const glm::dvec2& p) const { return at.z + glm::dot(gradient, p - glm::dvec2(at)); }
};

/// Columns of a row: [from, to).
struct Span {
    double from = std::numeric_limits<double>::infinity(), to = -from;
    void include(double x) { from = std::min(from, x), to = std::max(to, x); }
};

/// Where the convex polygon meets the line at @p y.
Span spanAt(std::span<const Point> points, double y) {
    Span span;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point &a = points[i], &b = points[(i + 1) % points.size()];
        if (a.y == y) span.include(a.x);
        if ((a.y < y) != (b.y < y)) span.include(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    return span;
}

/// An eye ray's crossing of a face, in the order in which the count meets them.
struct Crossing {
    double depth = 0;
    int volume = 0;
    bool enters = false;
    bool operator<(const Crossing& other) const {
        return depth != other.depth ? depth < other.depth : enters > other.enters;
    }
};

/// Overlap and levels along single rays.
class Rays {
  public:
    Rays(const std::vector<WindowFace>& faces, const std::vector<Point>& points,
         const std::vector<int>& fronts, int width, int height)
        : m_faces(faces), m_points(points), m_fronts(fronts), m_width(width), m_height(height) {}

    /// Fills in overlap and levels. @pre the rest is there
    void measure(Nesting& nesting) {
        if (!sortIntoRows()) {
            nesting.overlap = nesting.levels = nesting.fronts;
            return;
        }
        // The most promising rows first; what can't exceed what was found is left out.
        const auto height = static_cast<std::size_t>(m_height);
        std::vector<int> rows(height), most(height);
        std::iota(rows.begin(), rows.end(), 0);
        for (const int row : rows) {
            const auto begin = m_fronts.begin() + std::ptrdiff_t(row) * m_width;
            most[std::size_t(row)] = *std::max_element(begin, begin + m_width);
        }
        std::stable_sort(rows.begin(), rows.end(),
                         [&](int a, int b) { return most[std::size_t(a)] > most[std::size_t(b)]; });
        for (const int row : rows) {
            if (most[std::size_t(row)] <= nesting.overlap) return;
            if (!collect(row, nesting.overlap)) {
                nesting.overlap = nesting.levels = nesting.fronts;
                return;
            }
            for (int x = 0; x < m_width; ++x) {
                auto& crossings = m_crossings[std::size_t(x)];
                if (!crossings.empty()) along(crossings, m_fronts[pixel(row, x)], nesting);
                crossings.clear();
            }
        }
    }

  private:
    std::size_t pixel(int row, int x) const {
        return std::size_t(row) * std::size_t(m_width) + std::size_t(x);
    }
    std::span<const Point> pointsOf(const WindowFace& face) const {
        return std::span(m_points).subspan(face.firstPoint, std::size_t(face.points));
    }

    /// Rows whose centres the face may reach: [first, second).
    std::pair<int, int> rowsOf(const WindowFace& face) const {
        const auto points = pointsOf(face);
        const auto [low, high] = std::minmax_element(
            points.begin(), points.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
        const double last = std::floor(high->y + kMargin - 0.5);
        return {int(std::clamp(std::ceil(low->y - kMargin - 0.5), 0.0, double(m_height))),
                int(std::clamp(last + 1, 0.0, double(m_height)))};
    }

    /// Whether they are few enough.
    bool sortIntoRows() {
        m_begins.assign(std::size_t(m_height) + 1, 0);
        std::size_t all = 0;
        for (const WindowFace& face : m_faces) {
            const auto [first, end] = rowsOf(face);
            for (int row = first; row < end; ++row) ++m_begins[std::size_t(row) + 1];
            all += std::size_t(std::max(0, end - first));
            if (all > kMostRows) return false;
        }
        std::partial_sum(m_begins.begin(), m_begins.end(), m_begins.begin());
        std::vector<std::size_t> at(m_begins.begin(), m_begins.end() - 1);
        m_rows.resize(all);
        for (std::size_t i = 0; i < m_faces.size(); ++i) {
            const auto [first, end] = rowsOf(m_faces[i]);
            for (int row = first; row < end; ++row) m_rows[at[std::size_t(row)]++] = std::uint32_t(i);
        }
        m_crossings.resize(std::size_t(m_width));
        return true;
    }

    /// The crossings of a row's pixels with more fronts than @p enough; false if that is too much.
    bool collect(int row, int enough) {
        const double y = row + 0.5;
        for (std::size_t i = m_begins[std::size_t(row)]; i < m_begins[std::size_t(row) + 1]; ++i) {
            const WindowFace& face = m_faces[m_rows[i]];
            const auto points = pointsOf(face);
            const Span below = spanAt(points, y - kMargin), above = spanAt(points, y + kMargin);
            Span span;
            if (face.enters) {  // wherever it may be
                for (const Span& s : {below, above}) {
                    if (s.from <= s.to) span.include(s.from), span.include(s.to);
                }
                for (const Point& p : points)
                    if (std::abs(p.y - y) <= kMargin) span.include(p.x);
                span.from -= kMargin, span.to += kMargin;
            } else {  // where it is for certain
                span.from = std::max(below.from, above.from) + kMargin;
                span.to = std::min(below.to, above.to) - kMargin;
            }
            if (!(span.from <= span.to)) continue;
            const int first = int(std::clamp(std::ceil(span.from - 0.5), 0.0, double(m_width)));
            const int last = int(std::clamp(std::floor(span.to - 0.5), -1.0, m_width - 1.0));
            const DepthPlane plane(points);
            for (int x = first; x <= last; ++x) {
                if (m_fronts[pixel(row, x)] <= enough) continue;
                const glm::dvec2 p(x + 0.5, y);
                m_crossings[std::size_t(x)].push_back(
                    {face.enters ? plane.before(p) : plane.behind(p), face.volume, face.enters});
                if (++m_all > kMostCrossings) return false;
            }
        }
        return true;
    }

    void along(std::vector<Crossing>& crossings, int fronts, Nesting& nesting) {
        struct Volume {
            int index = 0, entries = 0, exits = 0;
        };
        std::sort(crossings.begin(), crossings.end());
        std::vector<Volume> volumes;
        for (const Crossing& c : crossings) {
            auto at = std::lower_bound(volumes.begin(), volumes.end(), c.volume,
                                       [](const Volume& v, int index) { return v.index < index; });
            if (at == volumes.end() || at->index != c.volume) at = volumes.insert(at, {.index = c.volume});
            ++(c.enters ? at->entries : at->exits);
            if (!c.enters) continue;
            int holding = 0, levels = 0;
            for (const Volume& v : volumes) {
                levels = std::max(levels, holding + v.entries);
                holding += std::max(0, v.entries - v.exits);
            }
            nesting.overlap = std::max(nesting.overlap, std::min(holding, fronts));
            nesting.levels = std::max(nesting.levels, std::min(levels, fronts));
        }
    }

    const std::vector<WindowFace>& m_faces;
    const std::vector<Point>& m_points;
    const std::vector<int>& m_fronts;
    int m_width, m_height;
    std::vector<std::size_t> m_begins{};
    std::vector<std::uint32_t> m_rows{};  ///< faces, row by row
    std::vector<std::vector<Crossing>> m_crossings{};
    std::size_t m_all = 0;
};

/// Collects the faces of all volumes and counts them.
class Counter {
  public:
    Counter(const View& view, CountedFrom from, float offset)
        : m_width(view.width),
          m_height(view.height),
          m_from(from),
          m_offset(offset),
          m_window(view),
          m_own(view.width, view.height),
          m_convex(view.width, view.height),
          m_exits(view.width, view.height),
          m_fronts(std::size_t(view.width) * std::size_t(view.height)) {}

    void add(const Scene& scene, const LitCaster& caster, const glm::vec4& light, const View& view) {
        const Parts open = Part::Sides | Part::FarCap;
        const Parts parts = open | (m_from == CountedFrom::Eye ? Part::NearCap : Part::LightCap);
        m_edges.clear();
        cutVolume(scene, caster, light, view, parts, {.offset = m_offset},
                  [&](Part part, std::span<const glm::vec4> polygon, bool reversed) {
                      addFace(part, m_window.cut(polygon), reversed);
                  });
        if (m_edges.empty()) return;
        ++m_volumes;
        // A volume of one triangle is convex: a ray enters it once.
        const bool isConvex = caster.lit.size() == 1;
        drawEdges(isConvex ? m_convex : m_own);
        if (isConvex)
            m_hasConvex = true;
        else
            m_own.take([&](std::size_t pixel, int count) {
                m_fronts[pixel] += count;
                m_ownFronts = std::max(m_ownFronts, count);
            });
    }

    /// All but overlap and levels. Only once.
    Nesting counts() {
        Nesting nesting;
        m_convex.take([&](std::size_t pixel, int count) { m_fronts[pixel] += count; });
        m_exits.take([&](std::size_t, int count) { nesting.backs = std::max(nesting.backs, count); });
        nesting.fronts = m_fronts.empty() ? 0 : *std::max_element(m_fronts.begin(), m_fronts.end());
        nesting.ownFronts = std::max(m_ownFronts, m_hasConvex ? std::min(nesting.fronts, 1) : 0);
        return nesting;
    }

    Nesting countsAndDepths() {
        Nesting nesting = counts();
        Rays(m_faces, m_points, m_fronts, m_width, m_height).measure(nesting);
        return nesting;
    }

  private:
    void addFace(Part part, std::span<const glm::vec4> polygon, bool reversed) {
        if (polygon.size() < 3) return;
        const std::size_t first = m_points.size();
        const double sign = m_from == CountedFrom::Eye ? 1 : -1;
        for (const glm::vec4& p : polygon) {
            const double w = std::max(double(p.w), std::numeric_limits<double>::min());
            m_points.push_back({(p.x / w + 1) / 2 * m_width, (p.y / w + 1) / 2 * m_height, sign * p.z / w});
        }
        const auto points = std::span(m_points).subspan(first);
        double area = 0;
        for (std::size_t i = 1; i + 1 < points.size(); ++i) {
            const glm::dvec2 a(points[i] - points[0]), b(points[i + 1] - points[0]);
            area += a.x * b.y - a.y * b.x;
        }
        const bool isFront = (area > 0) != reversed;
        const bool enters = isFront == (m_from == CountedFrom::Eye);

        // Counter-clockwise, the face lies to the right of what goes down.
        for (std::size_t i = 0; i < points.size(); ++i) {
            Edge edge{.low = points[i], .high = points[(i + 1) % points.size()]};
            const bool goesUp = std::tuple(edge.low.y, edge.low.x) < std::tuple(edge.high.y, edge.high.x);
            if (!goesUp) std::swap(edge.low, edge.high);
            (enters ? edge.entries : edge.exits) = goesUp == (area > 0) ? -1 : 1;
            m_edges.push_back(edge);
        }
        // Counted from the eye, leaving at infinity ends nothing.
        if (part == Part::FarCap && m_from == CountedFrom::Eye)
            m_points.resize(first);
        else
            m_faces.push_back({first, int(points.size()), m_volumes, enters});
    }

    void drawEdges(CountImage& entries) {
        std::sort(m_edges.begin(), m_edges.end(),
                  [](const Edge& a, const Edge& b) { return a.ends() < b.ends(); });
        for (std::size_t begin = 0, end = 0; begin < m_edges.size(); begin = end) {
            int enter = 0, exit = 0;
            for (; end < m_edges.size() && m_edges[end].ends() == m_edges[begin].ends(); ++end)
                enter += m_edges[end].entries, exit += m_edges[end].exits;
            if (enter != 0) entries.step(m_edges[begin], enter);
            if (exit != 0) m_exits.step(m_edges[begin], exit);
        }
    }

    int m_width, m_height;
    CountedFrom m_from;
    float m_offset;
    WindowClip<glm::vec4> m_window;
    CountImage m_own, m_convex, m_exits;
    std::vector<int> m_fronts;  ///< of all volumes, pixel by pixel
    std::vector<Point> m_points{};
    std::vector<WindowFace> m_faces{};
    std::vector<Edge> m_edges{};  ///< of one volume
    int m_volumes = 0, m_ownFronts = 0;
    bool m_hasConvex = false;
};

/// A caster whose volume holds each point as often as those of the triangles of @p caster do: where two of
/// them meet, their sides cancel.
LitCaster merged(const LitCaster& caster) {
    LitCaster whole{.object = caster.object, .lit = caster.lit};
    std::vector<Side> sides = caster.sides;
    for (Side& side : sides)
        if (side.from > side.to) side = {side.to, side.from, -side.weight};
    const auto edge = [](const Side& side) { return std::pair(side.from, side.to); };
    std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) { return edge(a) < edge(b); });
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        int weight = 0;
        for (; end < sides.size() && edge(sides[end]) == edge(sides[begin]); ++end)
            weight += sides[end].weight;
        const auto [low, high] = edge(sides[begin]);
        if (weight > 0) whole.sides.push_back({low, high, weight});
        if (weight < 0) whole.sides.push_back({high, low, -weight});
    }
    return whole;
}

}  // namespace

Nesting deepest(const Nesting& a, const Nesting& b) {
    return {std::max(a.fronts, b.fronts), std::max(a.backs, b.backs), std::max(a.ownFronts, b.ownFronts),
            std::max(a.overlap, b.overlap), std::max(a.levels, b.levels)};
}

Nesting nesting(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light, const View& view,
                CountedFrom from, float offset) {
    Counter counter(view, from, offset);
    std::vector<LitCaster> whole;
    for (const LitCaster& caster : lit) {
        if (!caster.perTriangle) {
            whole.push_back(caster);
            counter.add(scene, caster, light, view);
            continue;
        }
        whole.push_back(merged(caster));
        for (std::size_t i = 0; i < caster.lit.size(); ++i) {
            const auto sides = caster.sides.begin() + std::ptrdiff_t(3 * i);
            counter.add(scene,
                        {.object = caster.object,
                         .lit = {caster.lit[i]},
                         .sides = {sides, sides + 3},
                         .perTriangle = true},
                        light, view);
        }
    }
    if (std::none_of(lit.begin(), lit.end(), [](const LitCaster& c) { return c.perTriangle; }))
        return counter.countsAndDepths();
    Nesting result = counter.counts();
    result.overlap = std::min(result.fronts, nesting(scene, whole, light, view, from, offset).overlap);
    result.levels = std::min(result.fronts, result.overlap + result.ownFronts);
    return result;
}

}  // namespace gnomon
