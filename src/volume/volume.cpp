#include "volume/volume.h"

#include <limits>
#include <numeric>
#include <utility>

#include "volume/silhouette_finder.h"

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
    return std::move(SilhouetteFinder(scene, caster).lit(light, silhouette, capFaces).front());
}

std::vector<LitCaster> litCasters(const Scene& scene, const glm::vec4& light, Silhouette silhouette,
                                  CapFaces capFaces) {
    return SilhouetteFinder(scene).lit(light, silhouette, capFaces);
}

glm::vec4 extruded(const glm::vec3& position, const glm::vec4& light) {
    return light.w == 0 ? glm::vec4(-glm::vec3(light), 0) : glm::vec4(position - glm::vec3(light), 0);
}

}  // namespace gnomon
