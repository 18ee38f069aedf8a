#include "cost/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

constexpr std::int64_t kSubpixels = 256;  ///< per side of a pixel

std::int64_t floorDivided(std::int64_t a, std::int64_t b) {
    const std::int64_t quotient = a / b;
    return quotient - (a % b < 0);
}

/// The first pixel whose centre is at @p at or beyond, by subpixels.
int firstCentre(std::int64_t at) {
    return int((at + kSubpixels / 2 - 1) >> 8);
}

/// A corner in the window, subpixels.
struct Corner2 {
    std::int64_t x = 0, y = 0;
};

/// Walks up an edge, row by row: the first pixel of each row whose centre is at the edge or right of it.
class EdgeWalk {
  public:
    /// @pre from.y < to.y
    EdgeWalk(const Corner2& from, const Corner2& to, int row) {
        const std::int64_t dx = to.x - from.x, dy = to.y - from.y;
        // The edge is at from.x + (y - from.y) dx / dy; its first centre is that less half a pixel, rounded
        // up to whole pixels.
        m_whole = kSubpixels * dy;
        const std::int64_t y = row * kSubpixels + kSubpixels / 2;
        const std::int64_t at = (from.x - kSubpixels / 2) * dy + (y - from.y) * dx + m_whole - 1;
        m_column = floorDivided(at, m_whole);
        m_rest = at - m_column * m_whole;
        const std::int64_t step = kSubpixels * dx;
        m_columnStep = floorDivided(step, m_whole);
        m_restStep = step - m_columnStep * m_whole;
    }

    std::int64_t column() const { return m_column; }

    void up() {
        m_column += m_columnStep;
        m_rest += m_restStep;
        if (m_rest < m_whole) return;
        m_rest -= m_whole;
        ++m_column;
    }

  private:
    std::int64_t m_whole = 1;               ///< parts of a column
    std::int64_t m_column = 0, m_rest = 0;  ///< the rest in parts
    std::int64_t m_columnStep = 0, m_restStep = 0;
};

class Coverage {
  public:
    Coverage(int width, int height, const WindowRect& scissor, bool depthClamp)
        : m_half{width / 2.0, height / 2.0},
          m_left(std::max(scissor.x, 0)),
          m_right(std::min(scissor.x + scissor.width, width)),
          m_bottom(std::max(scissor.y, 0)),
          m_top(std::min(scissor.y + scissor.height, height)),
          m_depthClamp(depthClamp) {}

    bool empty() const { return m_left >= m_right || m_bottom >= m_top; }

    void add(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c) {
        if (isInside(a) && isInside(b) && isInside(c)) return fill(toWindow(a), toWindow(b), toWindow(c));
        cut({a, b, c});
    }

    const SidesCovered& counts() const { return m_counts; }

  private:
    bool isInside(const glm::vec4& p) const {
        return p.w > 0 && std::abs(p.x) <= p.w && std::abs(p.y) <= p.w && p.z <= p.w &&
               (m_depthClamp || p.z >= -p.w);
    }

    template <class Vec>
    Corner2 toWindow(const Vec& p) const {
        const auto at = [&](double clip, double half) {
            return std::int64_t(std::floor((clip / p.w + 1) * half * kSubpixels + 0.5));
        };
        return {at(p.x, m_half[0]), at(p.y, m_half[1])};
    }

    /// Draws what the view holds of a triangle. Edges that two triangles share are cut in the same points.
    void cut(const std::array<glm::dvec4, 3>& triangle) {
        m_polygon.assign(triangle.begin(), triangle.end());
        const std::array<glm::dvec4, 6> planes{glm::dvec4{1, 0, 0, 1},  {-1, 0, 0, 1}, {0, 1, 0, 1},
                                               glm::dvec4{0, -1, 0, 1}, {0, 0, 1, 1},  {0, 0, -1, 1}};
        for (std::size_t i = 0; i < (m_depthClamp ? 4u : 6u); ++i) {
            m_kept.clear();
            for (std::size_t k = 0; k < m_polygon.size(); ++k) {
                const glm::dvec4 &a = m_polygon[k], &b = m_polygon[(k + 1) % m_polygon.size()];
                const double ha = glm::dot(planes[i], a), hb = glm::dot(planes[i], b);
                if (ha >= 0) m_kept.push_back(a);
                if ((ha >= 0) == (hb >= 0)) continue;
                const bool swaps = std::tie(b.x, b.y, b.z, b.w) < std::tie(a.x, a.y, a.z, a.w);
                const glm::dvec4 &p = swaps ? b : a, &q = swaps ? a : b;
                const double hp = std::abs(swaps ? hb : ha), hq = std::abs(swaps ? ha : hb);
                m_kept.push_back((hq * p + hp * q) / (hp + hq));
            }
            m_polygon.swap(m_kept);
        }
        // Where all planes meet, at the eye, there is nothing to see.
        std::erase_if(m_polygon, [](const glm::dvec4& p) { return !(p.w > 0); });
        for (std::size_t k = 2; k < m_polygon.size(); ++k)
            fill(toWindow(m_polygon[0]), toWindow(m_polygon[k - 1]), toWindow(m_polygon[k]));
    }

    void fill(Corner2 a, Corner2 b, Corner2 c) {
        const std::int64_t area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        if (area == 0) return;
        if (b.y < a.y) std::swap(a, b);
        if (c.y < a.y) std::swap(a, c);
        if (c.y < b.y) std::swap(b, c);
        const int first = std::max(firstCentre(a.y), m_bottom), last = std::min(firstCentre(c.y), m_top);
        if (first >= last) return;
        const int middle = std::clamp(firstCentre(b.y), first, last);
        EdgeWalk whole(a, c, first);
        std::int64_t pixels = 0;
        if (first < middle) pixels += fillRows(whole, EdgeWalk(a, b, first), middle - first);
        if (middle < last) pixels += fillRows(whole, EdgeWalk(b, c, middle), last - middle);
        (area > 0 ? m_counts.front : m_counts.back) += pixels;
    }

    std::int64_t fillRows(EdgeWalk& one, EdgeWalk other, int rows) const {
        std::int64_t pixels = 0;
        for (int i = 0; i < rows; ++i, one.up(), other.up()) {
            const auto [left, right] = std::minmax({one.column(), other.column()});
            pixels += std::max<std::int64_t>(0, std::min(right, m_right) - std::max(left, m_left));
        }
        return pixels;
    }

    std::array<double, 2> m_half;
    std::int64_t m_left, m_right;
    int m_bottom, m_top;
    bool m_depthClamp;
    SidesCovered m_counts{};
    std::vector<glm::dvec4> m_polygon{}, m_kept{};
};

}  // namespace

SidesCovered& operator+=(SidesCovered& a, const SidesCovered& b) {
    a.front += b.front, a.back += b.back;
    return a;
}

SidesCovered covered(std::span<const glm::vec4> triangles, int width, int height, const WindowRect& scissor,
                     bool depthClamp) {
    Coverage coverage(width, height, scissor, depthClamp);
    if (coverage.empty()) return {};
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
        coverage.add(triangles[i], triangles[i + 1], triangles[i + 2]);
    return coverage.counts();
}

}  // namespace gnomon
