#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "scene/buckets.h"
#include "volume/orient.h"
#include "volume/volume.h"

namespace gnomon {
namespace {

/// A triangle at an edge.
struct Walk {
    std::uint32_t low = 0, high = 0;
    std::uint32_t triangle = 0;
    std::uint32_t opposite = 0;  ///< its third vertex
    bool forward = false;        ///< it walks from low to high
    auto key() const { return std::pair(low, high); }
    auto all() const { return std::tuple(low, high, !forward, opposite, triangle); }
    bool operator<(const Walk& other) const { return all() < other.all(); }
};

/// All walks of @p mesh, edge by edge, lowest vertices first.
std::vector<Walk> walksByEdge(const Mesh& mesh) {
    Buckets<Walk> walks(mesh.positions.size(), [&](const auto& add) {
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            const glm::uvec3 t = mesh.triangles[i];
            if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t from = t[k], to = t[(k + 1) % 3], low = std::min(from, to);
                add(low, Walk{low, std::max(from, to), i, t[(k + 2) % 3], from < to});
            }
        }
    });
    return walks.take();
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
    if (edge.size() == 2 && edge[0].forward != edge[1].forward) return {};
    const std::string where = name(mesh, edge[0]);
    if (const auto [a, b] = duplicates(edge); a != b)
        return fmt::format("triangles {} and {} are the same, at {}", a, b, where);
    if (edge.size() == 1) return fmt::format("boundary: only triangle {} at {}", edge[0].triangle, where);
    if (edge.size() > 2) return fmt::format("{} triangles at {}", edge.size(), where);
    return fmt::format("winding conflict: triangles {} and {} walk the same way along {}",
                       std::min(edge[0].triangle, edge[1].triangle),
                       std::max(edge[0].triangle, edge[1].triangle), where);
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
bool faceAlike(const Mesh& mesh, const Walk& a, const Walk& b) {
    const auto side = [&](std::uint32_t triangle, const glm::vec4& p) {
        const glm::uvec3 t = mesh.triangles[triangle];
        return orientation(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], p);
    };
    if (side(a.triangle, glm::vec4(mesh.positions[b.opposite], 1)) != 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec4 towards(0);
        towards[axis] = 1;
        if (side(a.triangle, towards) != side(b.triangle, towards)) return false;
    }
    return true;
}

/// Two triangles of the edge that can be caps at once and walk it the same way then.
Fault canWalkAlike(const Mesh& mesh, std::span<const Walk> edge, bool twoSided) {
    for (std::size_t i = 1; i < edge.size(); ++i) {
        const Walk &a = edge[i - 1], &b = edge[i];
        if (a.forward == b.forward)
            return fmt::format("triangles {} and {} walk the same way along {}", a.triangle, b.triangle,
                               name(mesh, a));
        if (twoSided && !faceAlike(mesh, a, b))
            return fmt::format(
                "two-sided: a light in front of triangle {} and behind {} has both walk the same "
                "way along {}",
                a.triangle, b.triangle, name(mesh, a));
    }
    return {};
}

/// The first fault that @p check(mesh, walks of one edge) finds.
template <class Check>
Fault firstFault(const Mesh& mesh, const Check& check) {
    const std::vector<Walk> walks = walksByEdge(mesh);
    for (std::size_t begin = 0, end = 0; begin < walks.size(); begin = end) {
        while (end < walks.size() && walks[end].key() == walks[begin].key()) ++end;
        if (Fault fault = check(mesh, std::span(walks).subspan(begin, end - begin))) return fault;
    }
    return {};
}

}  // namespace

std::optional<std::string> refusal(const Scene& scene, Silhouette silhouette, CapFaces capFaces) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (!object.casts) continue;
        Fault fault;
        if (silhouette == Silhouette::Manifold) fault = firstFault(object.mesh, notManifold);
        if (!fault && capFaces == CapFaces::Away && !object.twoSided)
            fault = firstFault(object.mesh, notClosed);
        if (fault) return fmt::format("object {} ({}): {}", i, object.name, *fault);
    }
    return {};
}

std::optional<std::string> limitation(const Mesh& mesh, Silhouette silhouette, bool twoSided) {
    if (silhouette != Silhouette::Triangular && silhouette != Silhouette::Visible) return {};
    return firstFault(
        mesh, [&](const Mesh& m, std::span<const Walk> edge) { return canWalkAlike(m, edge, twoSided); });
}

}  // namespace gnomon
