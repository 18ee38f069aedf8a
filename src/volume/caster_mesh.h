#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "volume/adjacency.h"
#include "volume/kernels.h"
#include "volume/volume.h"

namespace gnomon {

/// Which triangles a light sees from the front and which from behind, exactly; the others are edge-on.
/// Triangle t is bit t % 64 of word t / 64; one bit at least after the last triangle is 0.
struct Facing {
    std::vector<std::uint64_t> lit{};
    std::vector<std::uint64_t> away{};
};

/// Triangles made ready to be asked, for many lights, which of them face it and where the caps end. Planes
/// and neighbours are computed once; a light then costs one pass over the planes and one over the neighbours
/// of its caps, both by the fastest kernels that the processor runs.
///
/// Signs are exact. A plane is stored in float, about the mesh's centre and scaled so that its largest
/// coefficient is 1; a height above it is trusted where it exceeds what all roundings together can amount to,
/// and orientation() decides elsewhere. So results don't depend on the instruction set.
///
/// memory  40 bytes per triangle beside the positions if no edge is crowded, at most 64; see bytes()
class CasterMesh {
  public:
    /// @p positions must outlive this.
    CasterMesh(std::span<const glm::vec3> positions, std::vector<glm::uvec3> triangles);

    const std::vector<glm::uvec3>& triangles() const { return m_triangles; }
    const Adjacency& edges() const { return m_edges; }
    std::size_t bytes() const;  ///< triangles, planes and edges

    /// Judges every triangle. @p facing is overwritten; hand in the same again to save its allocation.
    void face(const glm::vec4& light, Facing& facing, const Kernels& with = kernels().front()) const;

    /// Appends the walks (Adjacency) of @p caps at simple edges across which there is no cap: for a mesh
    /// without crowded edges the silhouette, wound as the caps walk it.
    /// @param caps  Facing::lit or Facing::away
    void outline(std::span<const std::uint64_t> caps, std::vector<std::uint32_t>& walks,
                 const Kernels& with = kernels().front()) const;

    /// Appends the numbers of the triangles in @p set, lowest first.
    void list(std::span<const std::uint64_t> set, std::vector<std::uint32_t>& triangles,
              const Kernels& with = kernels().front()) const;

    /// How many caps walk a crowded edge which way.
    struct Count {
        int forward = 0, backward = 0;  ///< from its low vertex to its high one, and back
        std::uint32_t triangle = 0;     ///< one of those at the edge
    };

    /// Calls @p visit(edge, count) for each crowded edge, with @p caps wound as they are and @p turned the
    /// other way round; one of them may be empty. The signed counter of Aldridge and Woods (section 2.4) and
    /// all rules like it; at simple edges no counter ever exceeds 1.
    template <class Visit>
    void count(std::span<const std::uint64_t> caps, std::span<const std::uint64_t> turned,
               const Visit& visit) const;

    std::uint32_t fromOf(std::uint32_t walk) const { return m_triangles[walk / 3][int(walk % 3)]; }
    std::uint32_t toOf(std::uint32_t walk) const { return m_triangles[walk / 3][int(nextCorner(walk % 3))]; }

  private:
    std::size_t words() const { return m_triangles.size() / 64 + 1; }
    template <bool Turned, class Visit>
    void countEach(const std::uint64_t* caps, const std::uint64_t* turned, const Visit& visit) const;
    bool hasArea(const glm::uvec3& triangle) const;
    void setPlane(std::size_t triangle);
    float boundFor(const glm::dvec3& light, double w) const;
    void judgeTheRest(const glm::vec4& light, Facing& facing) const;

    std::span<const glm::vec3> m_positions;
    std::vector<glm::uvec3> m_triangles;
    Adjacency m_edges;
    glm::dvec3 m_centre{0};
    double m_radius = 0;  ///< largest difference of a coordinate from that of the centre
    std::vector<float> m_x{}, m_y{}, m_z{}, m_d{};
};

/// Whether bit @p triangle of @p set is 1; not where the set is empty.
inline bool holds(std::span<const std::uint64_t> set, std::uint32_t triangle) {
    return !set.empty() && (set[triangle / 64] >> (triangle % 64) & 1) != 0;
}

template <class Visit>
void CasterMesh::count(std::span<const std::uint64_t> caps, std::span<const std::uint64_t> turned,
                       const Visit& visit) const {
    if (turned.empty()) return countEach<false>(caps.data(), nullptr, visit);
    if (caps.empty()) {  // those that walk one way when they aren't turned walk the other way when they are
        return countEach<false>(turned.data(), nullptr, [&](const Adjacency::Crowded& edge, Count count) {
            std::swap(count.forward, count.backward);
            visit(edge, count);
        });
    }
    countEach<true>(caps.data(), turned.data(), visit);
}

/// Without a branch on what is a cap: for the light that is random.
template <bool Turned, class Visit>
void CasterMesh::countEach(const std::uint64_t* caps, const std::uint64_t* turned, const Visit& visit) const {
    const std::uint32_t* at = m_edges.crowds.data();
    for (const Adjacency::Crowded& edge : m_edges.crowded) {
        const std::uint32_t first = *at / 4;
        std::uint64_t sums = 0;  // forward below, backward above
        for (bool last = false; !last; ++at) {
            const std::uint32_t triangle = *at / 4, direction = (*at & Adjacency::kBackward) * 32;
            sums += (caps[triangle / 64] >> (triangle % 64) & 1) << direction;
            if constexpr (Turned) sums += (turned[triangle / 64] >> (triangle % 64) & 1) << (32 - direction);
            last = (*at & Adjacency::kLast) != 0;
        }
        visit(edge, Count{.forward = static_cast<int>(sums & 0xffffffff),
                          .backward = static_cast<int>(sums >> 32),
                          .triangle = first});
    }
}

}  // namespace gnomon
