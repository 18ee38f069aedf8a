#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace gnomon {

/// Which triangles of any mesh meet at which edges, made for asking once per light where caps end.
///
/// A triangle t walks three edges: walk 3 t + k goes from its vertex k to vertex k + 1. An edge that one
/// triangle walks, or two in opposite directions, is *simple*: there a cap ends where the triangle across is
/// no cap, and all silhouettes agree. All other edges are *crowded*: there the caps have to be counted.
///
/// needs   at most 2^30 triangles; any 32-bit vertex numbers, also sparse
/// cost    linear where few edges are crowded and few vertices have over 64 triangles; else n log n
struct Adjacency {
    /// An edge of three triangles or more, or of two that walk it the same way. Lowest vertices first.
    struct Crowded {
        std::uint32_t low = 0, high = 0;
    };

    std::uint32_t triangles = 0;
    /// For each walk the triangle across the edge; `triangles` if there is none, and the walk's own triangle
    /// at a crowded edge and in triangles with a repeated vertex, so that no cap ever ends there. Padded with
    /// `triangles` to whole words of 64 triangles, one at least more than there are triangles.
    std::vector<std::uint32_t> across{};
    std::vector<Crowded> crowded{};
    /// The triangles at each of crowded, in its order: 4 times the triangle, plus kLast at the last one of an
    /// edge, plus kBackward for those that walk it from its high vertex to its low one.
    std::vector<std::uint32_t> crowds{};

    static constexpr std::uint32_t kBackward = 1, kLast = 2;

    std::size_t bytes() const {
        return across.size() * sizeof(across[0]) + crowded.size() * sizeof(Crowded) +
               crowds.size() * sizeof(crowds[0]);
    }
};

/// Memory that adjacency() works in. Handed in again for the next mesh it saves the system's time to find
/// fresh pages, which is as long as the work itself.
struct AdjacencyScratch {
    /// A walk from a low to a high vertex, in the bucket of the low one.
    struct Forward {
        std::uint32_t to, walk;
    };
    /// A walk from a high vertex to the low one of a bucket.
    struct Backward {
        std::uint32_t from, bucket, walk;
    };
    std::vector<std::uint32_t> ends{};
    std::vector<Forward> forward{};
    std::vector<Backward> backward{};
};

/// @throws std::length_error for more than 2^30 triangles
void findAdjacency(std::span<const glm::uvec3> triangles, AdjacencyScratch& scratch, Adjacency& result);

/// The same with memory of its own.
Adjacency adjacency(std::span<const glm::uvec3> triangles);

/// The edge's end that follows corner @p k of a triangle.
constexpr std::uint32_t nextCorner(std::uint32_t k) {
    return k == 2 ? 0 : k + 1;
}

}  // namespace gnomon
