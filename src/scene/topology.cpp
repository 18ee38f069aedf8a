#include "scene/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "scene/buckets.h"
#include "scene/t_junctions.h"

namespace gnomon {
namespace {

/// Sets of numbers 0 to size - 1 that can only grow together.
class Sets {
  public:
    explicit Sets(std::size_t size) : m_parent(size) { std::iota(m_parent.begin(), m_parent.end(), 0u); }

    std::uint32_t rootOf(std::uint32_t i) {
        while (m_parent[i] != i) i = m_parent[i] = m_parent[m_parent[i]];
        return i;
    }
    /// True if the two were apart.
    bool join(std::uint32_t a, std::uint32_t b) {
        a = rootOf(a);
        b = rootOf(b);
        m_parent[std::max(a, b)] = std::min(a, b);
        return a != b;
    }

  private:
    std::vector<std::uint32_t> m_parent;
};

/// An edge as one triangle runs along it, in the bucket of its lower vertex. Corners are numbered through all
/// triangles: the corner where the edge begins, from which the triangle runs.
struct Use {
    std::uint32_t high = 0, corner = 0;
    auto operator<=>(const Use&) const = default;
};

std::uint32_t cornerAfter(std::uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// A triangle without its first corner, the least vertex.
struct Rest {
    std::uint32_t low = 0, high = 0;
    bool turned = false;  ///< high comes before low
    auto operator<=>(const Rest&) const = default;
};

/// The lesser by coordinates.
void keepLeast(std::optional<Edge>& kept, Edge edge) {
    const auto key = [](const glm::vec3& p) { return std::tuple(p.x, p.y, p.z); };
    const auto keyOf = [&](const Edge& e) { return std::pair(key(e[0]), key(e[1])); };
    if (key(edge[1]) < key(edge[0])) std::swap(edge[0], edge[1]);
    if (!kept || keyOf(edge) < keyOf(*kept)) kept = edge;
}

void countEdges(const Mesh& mesh, Topology& result) {
    const auto vertexAt = [&](std::uint32_t corner) { return mesh.triangles[corner / 3][int(corner % 3)]; };
    const Buckets<Use> uses(mesh.positions.size(), [&](const auto& add) {
        for (std::uint32_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
            const auto [low, high] = std::minmax({vertexAt(corner), vertexAt(cornerAfter(corner))});
            add(low, Use{high, corner});
        }
    });

    Sets fans(3 * mesh.triangles.size()), pieces(mesh.positions.size());
    std::size_t fanCount = 3 * mesh.triangles.size(), joined = 0;
    uses.forEachRun([](const Use& use) { return use.high; },
                    [&](std::uint32_t low, std::span<const Use> run) {
                        const Edge edge{mesh.positions[low], mesh.positions[run[0].high]};
                        ++result.edges;
                        ++result.valences[int(run.size())];
                        joined += pieces.join(low, run[0].high);

                        int balance = 0;
                        for (std::size_t i = 0; i < run.size(); ++i) {
                            const auto upwards = [&](const Use& use) { return vertexAt(use.corner) == low; };
                            const auto atLow = [&](const Use& use) {
                                return upwards(use) ? use.corner : cornerAfter(use.corner);
                            };
                            const auto atHigh = [&](const Use& use) {
                                return upwards(use) ? cornerAfter(use.corner) : use.corner;
                            };
                            balance += upwards(run[i]) ? 1 : -1;
                            if (i == 0) continue;
                            fanCount -= fans.join(atLow(run[i - 1]), atLow(run[i]));
                            fanCount -= fans.join(atHigh(run[i - 1]), atHigh(run[i]));
                        }
                        if (run.size() == 1) keepLeast(result.boundaryEdge, edge);
                        if (run.size() > 2) keepLeast(result.nonManifoldEdge, edge);
                        if (balance == 0) return;
                        ++result.unbalancedEdges;
                        keepLeast(result.unbalancedEdge, edge);
                        if (run.size() != 2) return;
                        ++result.windingConflicts;
                        keepLeast(result.conflictEdge, edge);
                    });

    std::vector<bool> used(mesh.positions.size());
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) used[t[k]] = true;
    result.vertices = std::size_t(std::count(used.begin(), used.end(), true));
    result.components = result.vertices - joined;
    result.bowTies = fanCount - result.vertices;
}

void countDuplicates(const Mesh& mesh, Topology& result) {
    const Buckets<Rest> triangles(mesh.positions.size(), [&](const auto& add) {
        for (const glm::uvec3& t : mesh.triangles) {
            const int least = t.x < t.y ? (t.x < t.z ? 0 : 2) : (t.y < t.z ? 1 : 2);
            const std::uint32_t second = t[(least + 1) % 3], third = t[(least + 2) % 3];
            add(t[least], Rest{std::min(second, third), std::max(second, third), third < second});
        }
    });
    triangles.forEachRun([](const Rest& rest) { return std::pair(rest.low, rest.high); },
                         [&](std::uint32_t, std::span<const Rest> run) {
                             const bool bothWays = run.front().turned != run.back().turned;
                             result.duplicates += run.size() - 1;
                             result.duplicatesSameWay += run.size() - (bothWays ? 2 : 1);
                         });
}

}  // namespace

std::size_t Topology::boundaryEdges() const {
    const auto one = valences.find(1);
    return one == valences.end() ? 0 : one->second;
}

std::size_t Topology::nonManifoldEdges() const {
    std::size_t sum = 0;
    for (const auto& [valence, count] : valences)
        if (valence > 2) sum += count;
    return sum;
}

int Topology::maxValence() const {
    return valences.empty() ? 0 : valences.rbegin()->first;
}

long Topology::euler() const {
    return long(vertices) - long(edges) + long(triangles);
}

bool Topology::isClosedManifold() const {
    return triangles > 0 && isBalanced() && maxValence() == 2 && bowTies == 0;
}

std::optional<long> Topology::genus() const {
    if (!isClosedManifold()) return std::nullopt;
    return long(components) - euler() / 2;
}

Topology topologyOf(const Mesh& mesh) {
    Topology result{.triangles = mesh.triangles.size()};
    countEdges(mesh, result);
    countDuplicates(mesh, result);
    if (result.boundaryEdges() > 0) result.tJunctions = tJunctions(mesh);
    return result;
}

std::string describe(const Topology& topology) {
    if (const auto genus = topology.genus()) return fmt::format("closed manifold, genus {}", *genus);
    std::string words = topology.isBalanced()          ? "closed (directions cancel along every edge)"
                        : topology.boundaryEdges() > 0 ? "open"
                                                       : "no boundary, but directions do not cancel";
    if (topology.nonManifoldEdges() > 0) words += ", non-manifold edges";
    if (topology.bowTies > 0) words += ", fans that meet in a vertex only";
    return words;
}

}  // namespace gnomon
