#include "gl/silhouette_mesh.h"

#include <span>

#include "volume/adjacency.h"

namespace gnomon {
namespace {

class MeshWriter {
  public:
    explicit MeshWriter(SilhouetteMesh& out) : m_out(out) {
        out.vertices.push_back({0, 0, 0, 0});
        out.vertices.push_back({0, 0, 0, -1});
    }

    void add(const Object& object) {
        const Mesh& mesh = object.mesh;
        const auto base = std::uint32_t(m_out.vertices.size());
        for (const glm::vec3& p : mesh.positions)
            m_out.vertices.push_back(glm::vec4(p, object.twoSided ? 2.0f : 1.0f));
        const Adjacency edges = adjacency(mesh.triangles);
        const auto begin = m_out.indices.size();
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                m_out.indices.push_back(base + mesh.triangles[t][int(k)]);
                m_out.indices.push_back(acrossSimple(mesh, edges, t, k, base));
            }
        }
        pairCrowded(mesh, edges, base, std::span(m_out.indices).subspan(begin));
    }

  private:
    static constexpr std::uint32_t kNone = 0, kHeld = 1;

    /// The corner of @p triangle that is at neither end of the edge.
    static std::uint32_t corner(const glm::uvec3& triangle, std::uint32_t from, std::uint32_t to) {
        return triangle.x ^ triangle.y ^ triangle.z ^ from ^ to;
    }

    /// What edge @p k of triangle @p t sees across it. Of two triangles the one that walks it upwards holds
    /// it; a crowded edge is held by none yet.
    static std::uint32_t acrossSimple(const Mesh& mesh, const Adjacency& edges, std::uint32_t t,
                                      std::uint32_t k, std::uint32_t base) {
        const std::uint32_t other = edges.across[3 * t + k];
        if (other == edges.triangles) return kNone;
        const std::uint32_t from = mesh.triangles[t][int(k)], to = mesh.triangles[t][int(nextCorner(k))];
        return other == t || from > to ? kHeld : base + corner(mesh.triangles[other], from, to);
    }

    /// Pairs the triangles at each crowded edge that walk it in opposite directions.
    static void pairCrowded(const Mesh& mesh, const Adjacency& edges, std::uint32_t base,
                            std::span<std::uint32_t> indices) {
        const std::uint32_t* at = edges.crowds.data();
        std::vector<std::uint32_t> forward, backward;
        for (const Adjacency::Crowded& edge : edges.crowded) {
            forward.clear(), backward.clear();
            for (bool last = false; !last; ++at) {
                (*at & Adjacency::kBackward ? backward : forward).push_back(*at / 4);
                last = (*at & Adjacency::kLast) != 0;
            }
            const auto across = [&](std::uint32_t triangle, std::uint32_t from) -> std::uint32_t& {
                std::uint32_t k = 0;
                while (mesh.triangles[triangle][int(k)] != from) ++k;
                return indices[6 * std::size_t(triangle) + 2 * k + 1];
            };
            for (std::size_t i = 0; i < forward.size(); ++i)
                across(forward[i], edge.low) =
                    i < backward.size() ? base + corner(mesh.triangles[backward[i]], edge.low, edge.high)
                                        : kNone;
            for (std::size_t i = forward.size(); i < backward.size(); ++i)
                across(backward[i], edge.high) = kNone;
        }
    }

    SilhouetteMesh& m_out;
};

}  // namespace

SilhouetteMesh silhouetteMesh(const Scene& scene, const glm::vec4& light, const View& view) {
    SilhouetteMesh out;
    MeshWriter writer(out);
    for (const Object& object : scene.objects)
        if (object.casts) writer.add(object);
    out.light = light;
    out.clipFromWorld = clipFromEye(view) * eyeFromWorld(view);
    out.eye = view.eye;
    out.nearPlane = view.nearPlane;
    out.window = {1 - 0.5 / view.width, 1 - 0.5 / view.height};
    return out;
}

}  // namespace gnomon
