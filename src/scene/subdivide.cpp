#include "scene/subdivide.h"

#include "scene/weld.h"

namespace gnomon {
namespace {

Mesh once(const Mesh& mesh) {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    positions.reserve(6 * mesh.triangles.size());
    triangles.reserve(4 * mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
        const auto first = std::uint32_t(positions.size());
        for (int k = 0; k < 3; ++k) positions.push_back(mesh.positions[t[k]]);
        // Exact in double before it is rounded, whichever end comes first.
        for (int k = 0; k < 3; ++k)
            positions.push_back(glm::vec3(
                (glm::dvec3(mesh.positions[t[k]]) + glm::dvec3(mesh.positions[t[(k + 1) % 3]])) / 2.0));
        for (const glm::uvec3& part : {glm::uvec3(0, 3, 5), {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
            triangles.push_back(first + part);
    }
    Dropped dropped;
    return weld(positions, triangles, dropped);
}

}  // namespace

Mesh subdivided(const Mesh& mesh, int times) {
    Mesh fine = mesh;
    for (int i = 0; i < times; ++i) fine = once(fine);
    return fine;
}

}  // namespace gnomon
