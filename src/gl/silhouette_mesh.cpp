#include "gl/silhouette_mesh.h"

#include <algorithm>
#include <tuple>

namespace gnomon {
namespace {

/// One edge as one triangle walks it.
struct Walk {
    std::uint32_t low = 0, high = 0, triangle = 0;
    std::uint8_t edge = 0;  ///< of the triangle: 0 to 2
    bool forward = false;   ///< from low to high
    std::tuple<std::uint32_t, std::uint32_t, bool, std::uint32_t> key() const {
        return {low, high, !forward, triangle};
    }
};

std::vector<Walk> walksOf(const Mesh& mesh) {
    std::vector<Walk> walks;
    walks.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint8_t k = 0; k < 3; ++k) {
            const std::uint32_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
            walks.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
        }
    }
    std::sort(walks.begin(), walks.end(), [](const Walk& a, const Walk& b) { return a.key() < b.key(); });
    return walks;
}

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
        const auto begin = m_out.indices.size();
        for (const glm::uvec3& t : mesh.triangles) {
            for (int k = 0; k < 3; ++k) {
                m_out.indices.push_back(base + t[k]);
                m_out.indices.push_back(kNone);
            }
        }
        const auto neighbour = [&](const Walk& w) -> std::uint32_t& {
            return m_out.indices[begin + 6 * std::size_t(w.triangle) + 2 * w.edge + 1];
        };
        const std::vector<Walk> walks = walksOf(mesh);
        for (auto first = walks.begin(); first != walks.end();) {
            const auto isOther = [&](const Walk& w) { return w.low != first->low || w.high != first->high; };
            const auto last = std::find_if(first, walks.end(), isOther);
            const auto back = std::find_if(first, last, [](const Walk& w) { return !w.forward; });
            for (auto f = first, b = back; f != back && b != last; ++f, ++b) {
                neighbour(*f) = base + mesh.triangles[b->triangle][(b->edge + 2) % 3];
                neighbour(*b) = kHeld;
            }
            first = last;
        }
    }

  private:
    static constexpr std::uint32_t kNone = 0, kHeld = 1;
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
