#include "image/distance.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace gnomon {
namespace {

/// Beyond every distance in a column, and its square is no overflow.
constexpr std::int64_t kFar = std::int64_t(1) << 28;

/// By pixel: how far the nearest pixel of its column that is in is above or below it; kFar if none is.
std::vector<std::int64_t> columnDistances(const std::vector<bool>& isIn, int width, int height) {
    std::vector<std::int64_t> distances(isIn.size(), kFar);
    const auto sweep = [&](int first, int end, int step) {
        for (int x = 0; x < width; ++x) {
            std::int64_t nearest = kFar;
            for (int y = first; y != end; y += step) {
                const std::size_t i = std::size_t(y) * width + x;
                nearest = isIn[i] ? 0 : std::min(kFar, nearest + 1);
                distances[i] = std::min(distances[i], nearest);
            }
        }
    };
    sweep(0, height, 1);
    sweep(height - 1, -1, -1);
    return distances;
}

/// The lower envelope of the parabolas (x - column)^2 + high^2.
class Envelope {
  public:
    /// @p columns  distances within the columns of one row
    explicit Envelope(const std::int64_t* columns, int width) : m_high(columns) {
        for (int column = 0; column < width; ++column) {
            if (columns[column] >= kFar) continue;
            // Who is beaten where it begins is beaten from there on.
            while (!m_parts.empty() &&
                   at(m_parts.back().column, m_parts.back().from) > at(column, m_parts.back().from))
                m_parts.pop_back();
            if (m_parts.empty()) {
                m_parts.push_back({column, 0});
                continue;
            }
            const std::int64_t from = firstBelow(m_parts.back().column, column);
            if (from < width) m_parts.push_back({column, from});
        }
    }

    /// Calls @p use with x and the least value there.
    template <class Use>
    void each(int width, const Use& use) const {
        for (std::size_t i = 0; i < m_parts.size(); ++i) {
            const std::int64_t end = i + 1 < m_parts.size() ? m_parts[i + 1].from : width;
            for (std::int64_t x = m_parts[i].from; x < end; ++x) use(x, at(m_parts[i].column, x));
        }
    }

  private:
    struct Part {
        std::int64_t column = 0, from = 0;  ///< whose parabola is the least from where on
    };

    std::int64_t at(std::int64_t column, std::int64_t x) const {
        return (x - column) * (x - column) + m_high[column] * m_high[column];
    }

    /// The least x from which on the parabola of @p right is below that of @p left.
    std::int64_t firstBelow(std::int64_t left, std::int64_t right) const {
        const std::int64_t above =
            right * right - left * left + m_high[right] * m_high[right] - m_high[left] * m_high[left];
        const std::int64_t twice = 2 * (right - left);
        // Rounded down; where the two are equal, the left one holds.
        const std::int64_t crossing = above >= 0 ? above / twice : -((-above + twice - 1) / twice);
        return std::max<std::int64_t>(0, crossing + 1);
    }

    const std::int64_t* m_high;
    std::vector<Part> m_parts{};
};

}  // namespace

std::vector<std::int64_t> squaredDistances(const std::vector<bool>& isIn, int width, int height) {
    assert(isIn.size() == std::size_t(width) * std::size_t(height));
    const std::vector<std::int64_t> columns = columnDistances(isIn, width, height);
    std::vector<std::int64_t> squares(isIn.size(), kNoDistance);
    for (int y = 0; y < height; ++y) {
        const std::size_t row = std::size_t(y) * width;
        const Envelope envelope(columns.data() + row, width);
        envelope.each(width,
                      [&](std::int64_t x, std::int64_t square) { squares[row + std::size_t(x)] = square; });
    }
    return squares;
}

}  // namespace gnomon
