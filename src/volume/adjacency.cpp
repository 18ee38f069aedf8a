#include "volume/adjacency.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace gnomon {
namespace {

constexpr std::uint32_t kCrowded = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMaxTriangles = std::size_t(1) << 30;
constexpr std::uint32_t kLongBucket = 64;  ///< above it searching a bucket from end to end doesn't pay

constexpr std::size_t kAhead = 16;  ///< walks between fetching something and asking for it

bool repeatsVertex(const glm::uvec3& t) {
    return t.x == t.y || t.y == t.z || t.z == t.x;
}

/// Vertex numbers without the gaps, so that a table of all of them has the size of the mesh.
class DenseNumbers {
  public:
    explicit DenseNumbers(std::span<const glm::uvec3> triangles) : m_triangles(triangles) {
        std::uint32_t low = std::numeric_limits<std::uint32_t>::max(), high = 0;
        for (const glm::uvec3& t : triangles) {
            low = std::min({low, t.x, t.y, t.z});
            high = std::max({high, t.x, t.y, t.z});
        }
        if (triangles.empty()) return;
        m_first = low;
        m_count = std::size_t(high) - low + 1;
        if (m_count > 8 * triangles.size()) renumber();
    }

    std::span<const glm::uvec3> triangles() const { return m_triangles; }
    std::uint32_t first() const { return m_first; }  ///< the lowest number in triangles()
    std::size_t count() const { return m_count; }
    std::uint32_t original(std::uint32_t dense) const {
        return m_originals.empty() ? dense : m_originals[dense];
    }

  private:
    /// In the order of the numbers, so that what is low stays low.
    void renumber() {
        for (const glm::uvec3& t : m_triangles) m_originals.insert(m_originals.end(), {t.x, t.y, t.z});
        std::sort(m_originals.begin(), m_originals.end());
        m_originals.erase(std::unique(m_originals.begin(), m_originals.end()), m_originals.end());
        m_dense.assign(m_triangles.begin(), m_triangles.end());
        for (glm::uvec3& t : m_dense) {
            for (int k = 0; k < 3; ++k) {
                const auto at = std::lower_bound(m_originals.begin(), m_originals.end(), t[k]);
                t[k] = static_cast<std::uint32_t>(at - m_originals.begin());
            }
        }
        m_triangles = m_dense;
        m_first = 0;
        m_count = m_originals.size();
    }

    std::span<const glm::uvec3> m_triangles;
    std::vector<glm::uvec3> m_dense{};
    std::vector<std::uint32_t> m_originals{};
    std::uint32_t m_first = 0;
    std::size_t m_count = 0;
};

/// Memory for @p count values, whatever they are now.
template <class T>
T* atLeast(std::vector<T>& values, std::size_t count) {
    if (values.size() < count) values.resize(count);
    return values.data();
}

class Builder {
  public:
    Builder(std::span<const glm::uvec3> triangles, AdjacencyScratch& scratch, Adjacency& result)
        : m_numbers(triangles),
          m_triangles(m_numbers.triangles()),
          m_none(std::uint32_t(triangles.size())),
          m_scratch(scratch),
          m_result(result) {}

    void build() {
        m_result.triangles = m_none;
        m_result.across.assign((std::size_t(m_none) / 64 + 1) * 192, m_none);
        m_result.crowded.clear();
        m_result.crowds.clear();
        if (m_none == 0) return;
        sortForwardWalks();
        pairBackwardWalks();
        if (m_pairs != m_forwards || !m_left.empty()) {
            leaveUnpairedForwards();
            groupLeftWalks();
        }
    }

  private:
    using Forward = AdjacencyScratch::Forward;
    using Backward = AdjacencyScratch::Backward;
    /// A walk that has no partner yet.
    struct Left {
        std::uint64_t edge;       ///< low vertex above, high vertex below
        std::uint32_t triangle4;  ///< as in Adjacency::crowds, without kLast
        std::uint32_t walk;
        auto key() const { return std::pair(edge, triangle4); }
    };

    /// Counting sort: bucket v is m_buckets[m_scratch.ends[v - 1] .. m_scratch.ends[v]]. Without branches on
    /// the direction of a walk: it is random where vertices are numbered at random.
    void sortForwardWalks() {
        const std::uint32_t first = m_numbers.first();
        m_scratch.ends.assign(m_numbers.count() + 1, 0);
        std::uint32_t* ends = m_scratch.ends.data() + 1;
        for (const glm::uvec3& t : m_triangles) {
            if (repeatsVertex(t)) continue;
            ends[t.x - first] += (t.x < t.y) + 0u;
            ends[t.y - first] += (t.y < t.z) + 0u;
            ends[t.z - first] += (t.z < t.x) + 0u;
        }
        for (std::size_t v = 0; v < m_numbers.count(); ++v) {
            const std::uint32_t size = ends[v];
            ends[v] = m_forwards;
            m_forwards += size;
        }

        m_buckets = atLeast(m_scratch.forward, std::size_t(m_forwards) + 1);
        Backward* backward = atLeast(m_scratch.backward, 3 * m_triangles.size() - m_forwards + 1);
        for (std::uint32_t i = 0; i < m_none; ++i) {
            const glm::uvec3 t = m_triangles[i];
            if (repeatsVertex(t)) {
                std::fill_n(m_result.across.begin() + 3 * std::size_t(i), 3, i);
                continue;
            }
            const auto put = [&](std::uint32_t from, std::uint32_t to, std::uint32_t walk) {
                const bool forward = from < to;
                const std::uint32_t end = ends[from - first];
                ends[from - first] = end + forward;
                m_buckets[forward ? end : m_forwards] = {to, walk};  // the last place takes the others
                backward[m_backwardCount] = {from, to - first, walk};
                m_backwardCount += !forward;
            };
            put(t.x, t.y, 3 * i);
            put(t.y, t.z, 3 * i + 1);
            put(t.z, t.x, 3 * i + 2);
        }
    }

    std::uint32_t fromOf(std::uint32_t walk) const { return m_triangles[walk / 3][int(walk % 3)]; }
    std::uint32_t toOf(std::uint32_t walk) const { return m_triangles[walk / 3][int(nextCorner(walk % 3))]; }

    /// Pairs a backward walk with the forward walk of its edge if each is the only one of its kind there.
    void pairBackwardWalks() {
        std::uint32_t* across = m_result.across.data();
        const std::span<const Backward> walks = std::span(m_scratch.backward).first(m_backwardCount);
        for (std::size_t at = 0; at < walks.size(); ++at) {
            // Vertices in random order miss every cache: first the bucket's place is fetched, then the
            // bucket.
            if (at + 2 * kAhead < walks.size()) {
                __builtin_prefetch(&m_scratch.ends[walks[at + 2 * kAhead].bucket]);
                __builtin_prefetch(&m_buckets[m_scratch.ends[walks[at + kAhead].bucket]]);
            }
            const auto& [from, low, walk] = walks[at];
            const std::uint32_t begin = m_scratch.ends[low], end = m_scratch.ends[low + 1];
            if (end - begin > kLongBucket) {
                leave(walk);
                continue;
            }
            std::uint32_t found = m_forwards, count = 0;
            for (std::uint32_t i = begin; i < end; ++i) {
                const bool same = m_buckets[i].to == from;
                found = same ? i : found;
                count += same;
            }
            const std::uint32_t forward = m_buckets[found].walk;
            if (count == 1 && across[forward] == m_none) {
                across[forward] = walk / 3;
                across[walk] = forward / 3;
                ++m_pairs;
            } else {
                if (count > 0) crowd(from, begin, end);
                leave(walk);
            }
        }
    }

    /// Takes apart what is paired so far at the edge from a bucket to @p high.
    void crowd(std::uint32_t high, std::uint32_t begin, std::uint32_t end) {
        std::uint32_t* across = m_result.across.data();
        for (std::uint32_t i = begin; i < end; ++i) {
            if (m_buckets[i].to != high) continue;
            const std::uint32_t forward = m_buckets[i].walk, other = across[forward];
            across[forward] = kCrowded;
            if (other >= m_none) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                if (fromOf(3 * other + k) == high && toOf(3 * other + k) == fromOf(forward)) {
                    across[3 * other + k] = m_none;
                    leave(3 * other + k);
                }
            }
            --m_pairs;
        }
    }

    void leave(std::uint32_t walk) {
        const std::uint32_t from = fromOf(walk), to = toOf(walk);
        const std::uint64_t low = std::min(from, to), high = std::max(from, to);
        const std::uint32_t backward = from > to ? Adjacency::kBackward : 0;
        m_left.push_back({low << 32 | high, 4 * (walk / 3) + backward, walk});
    }

    void leaveUnpairedForwards() {
        for (std::uint32_t i = 0; i < m_forwards; ++i) {
            const std::uint32_t walk = m_buckets[i].walk;
            if (m_result.across[walk] >= m_none) leave(walk);
        }
    }

    /// Settles the edges whose walks were all left: alone, a pair, or a crowd.
    void groupLeftWalks() {
        std::sort(m_left.begin(), m_left.end(),
                  [](const Left& a, const Left& b) { return a.key() < b.key(); });
        for (auto begin = m_left.begin(), end = begin; begin != m_left.end(); begin = end) {
            while (end != m_left.end() && end->edge == begin->edge) ++end;
            settle(std::span<const Left>(begin, end));
        }
    }

    void settle(std::span<const Left> edge) {
        std::vector<std::uint32_t>& across = m_result.across;
        const auto direction = [](const Left& left) { return left.triangle4 & Adjacency::kBackward; };
        if (edge.size() == 1) {
            across[edge[0].walk] = m_none;
        } else if (edge.size() == 2 && direction(edge[0]) != direction(edge[1])) {
            across[edge[0].walk] = edge[1].walk / 3;
            across[edge[1].walk] = edge[0].walk / 3;
        } else {
            m_result.crowded.push_back({m_numbers.original(std::uint32_t(edge[0].edge >> 32)),
                                        m_numbers.original(std::uint32_t(edge[0].edge))});
            for (const Left& left : edge) {
                across[left.walk] = left.walk / 3;
                m_result.crowds.push_back(left.triangle4);
            }
            m_result.crowds.back() += Adjacency::kLast;
        }
    }

    DenseNumbers m_numbers;
    std::span<const glm::uvec3> m_triangles;
    std::uint32_t m_none;  ///< number of triangles
    Forward* m_buckets = nullptr;
    AdjacencyScratch& m_scratch;
    Adjacency& m_result;
    std::uint32_t m_forwards = 0, m_backwardCount = 0, m_pairs = 0;
    std::vector<Left> m_left{};
};

}  // namespace

void findAdjacency(std::span<const glm::uvec3> triangles, AdjacencyScratch& scratch, Adjacency& result) {
    if (triangles.size() > kMaxTriangles) throw std::length_error("a mesh of more than 2^30 triangles");
    Builder(triangles, scratch, result).build();
}

Adjacency adjacency(std::span<const glm::uvec3> triangles) {
    AdjacencyScratch scratch;
    Adjacency result;
    findAdjacency(triangles, scratch, result);
    return result;
}

}  // namespace gnomon
