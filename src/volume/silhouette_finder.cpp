#include "volume/silhouette_finder.h"

#include <algorithm>

namespace gnomon {
namespace {

/// How many sides hang from an edge that @p forward caps walk from low to high and @p backward from high to
/// low: more than 0 from low to high, less from high to low.
int sidesAt(int forward, int backward, Silhouette silhouette) {
    const int sum = forward - backward, count = forward + backward;
    switch (silhouette) {
        case Silhouette::Triangular:
            return count % 2 == 0 ? 0 : sum > 0 ? 1 : -1;
        case Silhouette::Visible:
            return count == 1 ? sum : 0;
        default:
            return sum;
    }
}

void sortByEdge(std::vector<Side>& sides) {
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::minmax(a.from, a.to) < std::minmax(b.from, b.to);
    });
}

std::vector<Side> triangleSides(const std::vector<glm::uvec3>& lit) {
    std::vector<Side> sides;
    sides.reserve(3 * lit.size());
    for (const glm::uvec3& t : lit) {
        for (int k = 0; k < 3; ++k) sides.push_back({t[k], t[(k + 1) % 3], 1});
    }
    return sides;
}

}  // namespace

/// The caps of one light as sets: those that stay as they are, and those that are turned round.
struct SilhouetteFinder::Caps {
    Facing facing{};
    std::span<const std::uint64_t> kept{}, turned{};  ///< views of facing; empty where there are none
};

SilhouetteFinder::SilhouetteFinder(const Scene& scene) {
    const std::vector<Caster> all = casters(scene);
    for (auto begin = all.begin(), end = begin; begin != all.end(); begin = end) {
        while (end != all.end() && end->object == begin->object) ++end;
        add(scene, std::span<const Caster>(begin, end));
    }
}

SilhouetteFinder::SilhouetteFinder(const Scene& scene, const Caster& caster) {
    add(scene, std::span(&caster, 1));
}

void SilhouetteFinder::add(const Scene& scene, std::span<const Caster> casters) {
    const Mesh& mesh = scene.objects[casters[0].object].mesh;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> begins{0};
    for (const Caster& caster : casters) {
        for (const std::uint32_t t : caster.triangles) triangles.push_back(mesh.triangles[t]);
        begins.push_back(static_cast<std::uint32_t>(triangles.size()));
    }
    m_parts.push_back({.object = casters[0].object,
                       .twoSided = casters[0].twoSided,
                       .begins = std::move(begins),
                       .mesh = CasterMesh(mesh.positions, std::move(triangles))});
}

std::vector<LitCaster> SilhouetteFinder::lit(const glm::vec4& light, Silhouette silhouette,
                                             CapFaces capFaces) const {
    std::vector<LitCaster> result;
    for (const Part& part : m_parts) {
        Caps caps;
        part.mesh.face(light, caps.facing);
        if (part.twoSided || capFaces == CapFaces::Lit) caps.kept = caps.facing.lit;
        if (part.twoSided || capFaces == CapFaces::Away) caps.turned = caps.facing.away;

        const std::size_t first = result.size();
        const bool perTriangle = silhouette == Silhouette::PerTriangle;
        result.resize(first + part.begins.size() - 1,
                      LitCaster{.object = part.object, .perTriangle = perTriangle});
        const auto casters = std::span(result).subspan(first);
        appendCaps(part, caps, casters);
        if (!perTriangle) appendSides(part, caps, silhouette, casters);
        for (LitCaster& caster : casters) {
            if (perTriangle)
                caster.sides = triangleSides(caster.lit);
            else
                sortByEdge(caster.sides);
        }
    }
    return result;
}

void SilhouetteFinder::appendCaps(const Part& part, const Caps& caps, std::span<LitCaster> casters) {
    std::vector<std::uint64_t> both;
    std::span<const std::uint64_t> set = caps.turned.empty() ? caps.kept : caps.turned;
    if (!caps.kept.empty() && !caps.turned.empty()) {
        both.assign(caps.kept.begin(), caps.kept.end());
        for (std::size_t i = 0; i < both.size(); ++i) both[i] |= caps.turned[i];
        set = both;
    }
    std::vector<std::uint32_t> triangles;
    part.mesh.list(set, triangles);
    auto begin = triangles.begin();
    for (std::size_t i = 0; i < casters.size(); ++i) {
        const auto end = std::lower_bound(begin, triangles.end(), part.begins[i + 1]);
        casters[i].lit.reserve(static_cast<std::size_t>(end - begin));
        for (; begin != end; ++begin) {
            const glm::uvec3 t = part.mesh.triangles()[*begin];
            casters[i].lit.push_back(holds(caps.turned, *begin) ? glm::uvec3(t.y, t.x, t.z) : t);
        }
    }
}

void SilhouetteFinder::appendSides(const Part& part, const Caps& caps, Silhouette silhouette,
                                   std::span<LitCaster> casters) {
    const CasterMesh& mesh = part.mesh;
    const auto sidesOf = [&](std::uint32_t triangle) -> std::vector<Side>& {
        const auto next = std::upper_bound(part.begins.begin(), part.begins.end(), triangle);
        return casters[static_cast<std::size_t>(next - part.begins.begin()) - 1].sides;
    };
    std::vector<std::uint32_t> walks;

    // Simple edges: a cap on one side, and on the other none or one that was turned round.
    if (!caps.kept.empty()) mesh.outline(caps.kept, walks);
    for (const std::uint32_t walk : walks) {
        const int alike = 1 + holds(caps.turned, mesh.edges().across[walk]);
        const int weight = sidesAt(alike, 0, silhouette);
        if (weight > 0) sidesOf(walk / 3).push_back({mesh.fromOf(walk), mesh.toOf(walk), weight});
    }
    // The same from turned caps, but for the edges that both have.
    walks.clear();
    if (!caps.turned.empty()) mesh.outline(caps.turned, walks);
    for (const std::uint32_t walk : walks) {
        if (!holds(caps.kept, mesh.edges().across[walk]))
            sidesOf(walk / 3).push_back({mesh.toOf(walk), mesh.fromOf(walk), 1});
    }

    mesh.count(caps.kept, caps.turned, [&](const Adjacency::Crowded& edge, const CasterMesh::Count& count) {
        const int weight = sidesAt(count.forward, count.backward, silhouette);
        if (weight > 0) sidesOf(count.triangle).push_back({edge.low, edge.high, weight});
        if (weight < 0) sidesOf(count.triangle).push_back({edge.high, edge.low, -weight});
    });
}

}  // namespace gnomon
