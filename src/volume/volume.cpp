#include "volume/volume.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "volume/orient.h"

namespace gnomon {
namespace {

/// The root of @p v in a forest of vertices; halves the path on the way.
std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

void appendComponents(const Object& object, std::uint32_t index, std::vector<Caster>& casters) {
    const Mesh& mesh = object.mesh;
    std::vector<std::uint32_t> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), 0u);
    for (const glm::uvec3& t : mesh.triangles) {
        const std::uint32_t a = rootOf(parent, t.x);
        parent[rootOf(parent, t.y)] = a;
        parent[rootOf(parent, t.z)] = a;
    }

    constexpr auto kNone = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> casterOf(mesh.positions.size(), kNone);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        std::size_t& caster = casterOf[rootOf(parent, mesh.triangles[t].x)];
        if (caster == kNone) {
            caster = casters.size();
            casters.push_back({.object = index, .twoSided = object.twoSided});
        }
        casters[caster].triangles.push_back(t);
    }
}

/// One edge as one lit triangle walks it.
struct Walk {
    std::uint32_t low, high;
    int direction;  ///< +1 from low to high
    auto key() const { return std::pair(low, high); }
};

/// Sorts by edge: first into one bucket per vertex if the vertices are few enough for that to pay, then each
/// bucket.
void sortByEdge(std::vector<Walk>& walks) {
    const auto byKey = [](const Walk& a, const Walk& b) { return a.key() < b.key(); };
    std::uint32_t first = std::numeric_limits<std::uint32_t>::max(), last = 0;
    for (const Walk& w : walks) {
        first = std::min(first, w.low);
        last = std::max(last, w.low);
    }
    if (walks.empty() || last - first > 4 * walks.size()) return std::sort(walks.begin(), walks.end(), byKey);

    std::vector<std::uint32_t> end(last - first + 2, 0);
    for (const Walk& w : walks) ++end[w.low - first + 1];
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<Walk> sorted(walks.size());
    for (const Walk& w : walks) sorted[end[w.low - first]++] = w;
    auto begin = sorted.begin();
    for (std::size_t v = 0; v + 1 < end.size(); ++v) {
        const auto bucketEnd = sorted.begin() + end[v];
        std::sort(begin, bucketEnd, byKey);
        begin = bucketEnd;
    }
    walks = std::move(sorted);
}

/// How many sides hang from an edge that @p forward cap triangles walk from low to high and @p backward from
/// high to low: more than 0 from low to high, less from high to low.
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

std::vector<Side> sharedSides(const std::vector<glm::uvec3>& lit, Silhouette silhouette) {
    std::vector<Walk> walks;
    walks.reserve(3 * lit.size());
    for (const glm::uvec3& t : lit) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t from = t[k], to = t[(k + 1) % 3];
            walks.push_back(from < to ? Walk{from, to, 1} : Walk{to, from, -1});
        }
    }
    sortByEdge(walks);

    std::vector<Side> sides;
    for (auto walk = walks.begin(); walk != walks.end();) {
        const auto edge = walk->key();
        int forward = 0, backward = 0;
        for (; walk != walks.end() && walk->key() == edge; ++walk)
            ++(walk->direction > 0 ? forward : backward);
        const int count = sidesAt(forward, backward, silhouette);
        if (count > 0) sides.push_back({edge.first, edge.second, count});
        if (count < 0) sides.push_back({edge.second, edge.first, -count});
    }
    return sides;
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

std::vector<Caster> casters(const Scene& scene) {
    std::vector<Caster> result;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (scene.objects[i].casts) appendComponents(scene.objects[i], i, result);
    }
    return result;
}

LitCaster litCaster(const Scene& scene, const Caster& caster, const glm::vec4& light, Silhouette silhouette,
                    CapFaces capFaces) {
    const Mesh& mesh = scene.objects[caster.object].mesh;
    const bool litCaps = caster.twoSided || capFaces == CapFaces::Lit;
    const bool awayCaps = caster.twoSided || capFaces == CapFaces::Away;
    LitCaster result{.object = caster.object, .perTriangle = silhouette == Silhouette::PerTriangle};
    for (const std::uint32_t index : caster.triangles) {
        const glm::uvec3 t = mesh.triangles[index];
        const int side = orientation(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], light);
        if (side > 0 && litCaps) result.lit.push_back(t);
        if (side < 0 && awayCaps) result.lit.push_back({t.y, t.x, t.z});
    }
    result.sides = result.perTriangle ? triangleSides(result.lit) : sharedSides(result.lit, silhouette);
    return result;
}

std::vector<LitCaster> litCasters(const Scene& scene, const glm::vec4& light, Silhouette silhouette,
                                  CapFaces capFaces) {
    std::vector<LitCaster> lit;
    for (const Caster& caster : casters(scene))
        lit.push_back(litCaster(scene, caster, light, silhouette, capFaces));
    return lit;
}

glm::vec4 extruded(const glm::vec3& position, const glm::vec4& light) {
    return light.w == 0 ? glm::vec4(-glm::vec3(light), 0) : glm::vec4(position - glm::vec3(light), 0);
}

}  // namespace gnomon
