#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "volume/adjacency.h"
#include "volume/orient.h"
#include "volume/volume.h"

namespace gnomon {
namespace {

/// A triangle at an edge.
struct Walk {
    std::uint32_t low, high;
    std::uint32_t triangle;
    std::uint32_t opposite;  ///< its third vertex
    bool forward;            ///< it walks from low to high
    auto edge() const { return std::pair(low, high); }
    auto all() const { return std::tuple(low, high, !forward, opposite, triangle); }
};

/// The walk 3 t + k of triangle t.
Walk walkOf(const Mesh& mesh, std::uint32_t walk) {
    const glm::uvec3 t = mesh.triangles[walk / 3];
    const std::uint32_t k = walk % 3, next = nextCorner(k);
    const std::uint32_t from = t[int(k)], to = t[int(next)];
    return {std::min(from, to), std::max(from, to), walk / 3, t[int(nextCorner(next))], from < to};
}

/// The walks at all edges but those that two triangles walk in opposite directions, edge by edge, lowest
/// vertices first.
std::vector<Walk> oddWalks(const Mesh& mesh, const Adjacency& edges) {
    std::vector<Walk> walks;
    for (std::uint32_t walk = 0; walk < 3 * edges.triangles; ++walk) {
        const std::uint32_t across = edges.across[walk];
        const glm::uvec3 t = mesh.triangles[walk / 3];
        const bool repeatsVertex = t.x == t.y || t.y == t.z || t.z == t.x;
        if (across == edges.triangles || (across == walk / 3 && !repeatsVertex))
            walks.push_back(walkOf(mesh, walk));
    }
    std::sort(walks.begin(), walks.end(), [](const Walk& a, const Walk& b) { return a.all() < b.all(); });
    return walks;
}

std::string name(const Mesh& mesh, const Walk& edge) {
    const glm::vec3 &a = mesh.positions[edge.low], &b = mesh.positions[edge.high];
    return fmt::format("edge {}-{} from ({}, {}, {}) to ({}, {}, {})", edge.low, edge.high, a.x, a.y, a.z,
                       b.x, b.y, b.z);
}

/// Two triangles of the edge with the same vertices in the same sense, else 0 twice.
std::pair<std::uint32_t, std::uint32_t> duplicates(std::span<const Walk> edge) {
    const auto same = std::adjacent_find(edge.begin(), edge.end(), [](const Walk& a, const Walk& b) {
        return a.forward == b.forward && a.opposite == b.opposite;
    });
    return same == edge.end() ? std::pair(0u, 0u) : std::pair(same[0].triangle, same[1].triangle);
}

using Fault = std::optional<std::string>;

/// Why the edge isn't one of a closed two-manifold of one winding.
Fault notManifold(const Mesh& mesh, std::span<const Walk> edge) {
    const std::string where = name(mesh, edge[0]);
    if (const auto [a, b] = duplicates(edge); a != b)
        return fmt::format("triangles {} and {} are the same, at {}", a, b, where);
    if (edge.size() == 1) return fmt::format("boundary: only triangle {} at {}", edge[0].triangle, where);
    if (edge.size() > 2) return fmt::format("{} triangles at {}", edge.size(), where);
    if (edge[0].forward == edge[1].forward)
        return fmt::format("winding conflict: triangles {} and {} walk the same way along {}",
                           std::min(edge[0].triangle, edge[1].triangle),
                           std::max(edge[0].triangle, edge[1].triangle), where);
    return {};
}

/// Why the mesh isn't closed at the edge.
Fault notClosed(const Mesh& mesh, std::span<const Walk> edge) {
    const auto forward = std::count_if(edge.begin(), edge.end(), [](const Walk& w) { return w.forward; });
    const auto backward = std::ssize(edge) - forward;
    if (forward == backward) return {};
    return fmt::format("not closed: {} triangle{} one way and {} the other along {}",
                       std::max(forward, backward), std::max(forward, backward) == 1 ? "" : "s",
                       std::min(forward, backward), name(mesh, edge[0]));
}

/// Whether each light sees the same side of both: they lie in one plane and face the same way. The sign of
/// orientation() in an axis's direction is that of the normal there.
bool faceAlike(const Mesh& mesh, const Walk& walk, std::uint32_t across) {
    const auto side = [&](std::uint32_t triangle, const glm::vec4& p) {
        const glm::uvec3 t = mesh.triangles[triangle];
        return orientation(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], p);
    };
    for (int k = 0; k < 3; ++k) {
        if (side(walk.triangle, glm::vec4(mesh.positions[mesh.triangles[across][k]], 1)) != 0) return false;
    }
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec4 towards(0);
        towards[axis] = 1;
        if (side(walk.triangle, towards) != side(across, towards)) return false;
    }
    return true;
}

/// Two triangles that can be caps at once and walk the edge alike.
Fault walkedAlike(const Mesh& mesh, std::span<const Walk> edge) {
    const auto alike = std::adjacent_find(
        edge.begin(), edge.end(), [](const Walk& a, const Walk& b) { return a.forward == b.forward; });
    if (alike == edge.end()) return {};
    return fmt::format("triangles {} and {} walk the same way along {}", alike[0].triangle, alike[1].triangle,
                       name(mesh, edge[0]));
}

/// The first bend: there one of two triangles is turned round in some light, and walks the edge as the other.
Fault bend(const Mesh& mesh, const Adjacency& edges) {
    std::optional<std::pair<Walk, std::uint32_t>> first;
    for (std::uint32_t walk = 0; walk < 3 * edges.triangles; ++walk) {
        const std::uint32_t across = edges.across[walk];
        if (across == edges.triangles || across <= walk / 3) continue;  // each pair once
        const Walk here = walkOf(mesh, walk);
        if (first && first->first.edge() < here.edge()) continue;
        if (!faceAlike(mesh, here, across)) first = {here, across};
    }
    if (!first) return {};
    return fmt::format(
        "two-sided: a light in front of triangle {} and behind {} has both walk the same way along {}",
        first->first.triangle, first->second, name(mesh, first->first));
}

/// The first fault that @p check(mesh, walks of one edge) finds.
template <class Check>
Fault firstFault(const Mesh& mesh, const Adjacency& edges, const Check& check) {
    const std::vector<Walk> walks = oddWalks(mesh, edges);
    for (std::size_t begin = 0, end = 0; begin < walks.size(); begin = end) {
        while (end < walks.size() && walks[end].edge() == walks[begin].edge()) ++end;
        if (Fault fault = check(mesh, std::span(walks).subspan(begin, end - begin))) return fault;
    }
    return {};
}

}  // namespace

std::optional<std::string> refusal(const Scene& scene, Silhouette silhouette, CapFaces capFaces) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (!object.casts) continue;
        const Adjacency edges = adjacency(object.mesh.triangles);
        Fault fault;
        if (silhouette == Silhouette::Manifold) fault = firstFault(object.mesh, edges, notManifold);
        if (!fault && capFaces == CapFaces::Away && !object.twoSided)
            fault = firstFault(object.mesh, edges, notClosed);
        if (fault) return fmt::format("object {} ({}): {}", i, object.name, *fault);
    }
    return {};
}

std::optional<std::string> limitation(const Mesh& mesh, Silhouette silhouette, bool twoSided) {
    if (silhouette != Silhouette::Triangular && silhouette != Silhouette::Visible) return {};
    const Adjacency edges = adjacency(mesh.triangles);
    const Fault fault = firstFault(mesh, edges, walkedAlike);
    return fault || !twoSided ? fault : bend(mesh, edges);
}

}  // namespace gnomon
