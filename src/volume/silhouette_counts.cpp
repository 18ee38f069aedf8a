#include "volume/silhouette_counts.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <span>

namespace gnomon {
namespace {

VolumeCount& of(VolumeCounts& counts, Silhouette silhouette) {
    return counts[std::size_t(silhouette)];
}

std::size_t sizeOf(std::span<const std::uint64_t> set) {
    std::size_t sum = 0;
    for (const std::uint64_t word : set) sum += std::size_t(std::popcount(word));
    return sum;
}

}  // namespace

SilhouetteCounter::SilhouetteCounter(const Scene& scene) {
    for (const Object& object : scene.objects)
        if (object.casts)
            m_parts.push_back({CasterMesh(object.mesh.positions, object.mesh.triangles), object.twoSided});
}

VolumeCounts SilhouetteCounter::count(const glm::vec4& light) {
    VolumeCounts counts{};
    for (const Part& part : m_parts) add(part, light, counts);
    for (VolumeCount& c : counts) {
        c.caps = of(counts, Silhouette::PerTriangle).caps;
        c.isPoint = light.w != 0;
    }
    VolumeCount& each = of(counts, Silhouette::PerTriangle);
    each.edges = each.sides = 3 * each.caps;
    return counts;
}

void SilhouetteCounter::add(const Part& part, const glm::vec4& light, VolumeCounts& counts) {
    part.mesh.face(light, m_facing);
    const std::span<const std::uint64_t> lit = m_facing.lit;
    const std::span<const std::uint64_t> away =
        part.twoSided ? std::span<const std::uint64_t>(m_facing.away) : std::span<const std::uint64_t>();
    of(counts, Silhouette::PerTriangle).caps += sizeOf(lit) + sizeOf(away);

    // Edges at which one cap ends, and those at which two end that walk them the same way: one faces the
    // light, the other faces away and is turned round.
    m_lit.clear();
    m_away.clear();
    part.mesh.outline(lit, m_lit);
    if (part.twoSided) part.mesh.outline(away, m_away);
    const std::vector<std::uint32_t>& across = part.mesh.edges().across;
    const auto both = std::size_t(std::count_if(
        m_lit.begin(), m_lit.end(), [&](std::uint32_t walk) { return holds(away, across[walk]); }));
    const std::size_t one = m_lit.size() + m_away.size() - 2 * both;
    std::size_t odd = one, single = one, wound = one + both, weights = one + 2 * both;

    // Edges of three triangles or more, or of two of different winding.
    part.mesh.count(lit, away, [&](const Adjacency::Crowded&, const CasterMesh::Count& count) {
        const int walks = count.forward + count.backward, balance = count.forward - count.backward;
        odd += walks % 2 != 0;
        single += walks == 1;
        wound += balance != 0;
        weights += std::size_t(std::abs(balance));
    });

    const auto grow = [&](Silhouette silhouette, std::size_t edges, std::size_t sides) {
        of(counts, silhouette).edges += edges;
        of(counts, silhouette).sides += sides;
    };
    grow(Silhouette::Triangular, odd, odd);
    grow(Silhouette::Visible, single, single);
    grow(Silhouette::Manifold, wound, weights);  // no crowded edges: it is refused there
    grow(Silhouette::Winding, wound, weights);
}

}  // namespace gnomon
