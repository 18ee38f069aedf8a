#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <glm/glm.hpp>
#include <map>
#include <utility>
#include <vector>

namespace gnomon {

using Bits = std::array<std::uint32_t, 4>;

inline Bits bitsOf(const glm::vec4& p) {
    Bits bits;
    for (int k = 0; k < 4; ++k) bits[k] = std::bit_cast<std::uint32_t>(p[k]);
    return bits;
}

/// How often each undirected edge of the triangle lists is walked from its lower to its higher end.
class Balance {
  public:
    void add(const std::vector<glm::vec4>& triangles) {
        for (std::size_t i = 0; i < triangles.size(); ++i)
            add(triangles[i], triangles[i % 3 == 2 ? i - 2 : i + 1]);
    }

    void add(const glm::vec4& a, const glm::vec4& b) {
        const Bits from = bitsOf(a), to = bitsOf(b);
        if (from < to) ++m_sum[{from, to}];
        if (to < from) --m_sum[{to, from}];
    }

    /// Edges that aren't walked as often one way as the other, and for which @p counts holds.
    template <class Predicate>
    int open(Predicate counts) const {
        int open = 0;
        for (const auto& [edge, sum] : m_sum)
            open += counts(pointOf(edge.first)) && counts(pointOf(edge.second)) ? std::abs(sum) : 0;
        return open;
    }

  private:
    static glm::vec4 pointOf(const Bits& bits) {
        glm::vec4 p;
        for (int k = 0; k < 4; ++k) p[k] = std::bit_cast<float>(bits[k]);
        return p;
    }

    std::map<std::pair<Bits, Bits>, int> m_sum;
};

}  // namespace gnomon
