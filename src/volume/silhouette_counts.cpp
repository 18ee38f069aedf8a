#include "volume/silhouette_counts.h"

#include <algorithm>
#include <cstdlib>

#include "scene/buckets.h"
#include "volume/orient.h"

namespace gnomon {
namespace {

/// A triangle at an edge, in the bucket of the edge's lower vertex.
struct Walk {
    std::uint32_t high = 0, use = 0;
    auto operator<=>(const Walk&) const = default;
};

VolumeCount& of(VolumeCounts& counts, Silhouette silhouette) {
    return counts[std::size_t(silhouette)];
}

}  // namespace

SilhouetteCounter::SilhouetteCounter(const Scene& scene) {
    for (const Object& object : scene.objects) {
        if (!object.casts) continue;
        const Mesh& mesh = object.mesh;
        const Buckets<Walk> walks(mesh.positions.size(), [&](const auto& add) {
            for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
                const glm::uvec3& t = mesh.triangles[i];
                for (int k = 0; k < 3; ++k) {
                    const std::uint32_t from = t[k], to = t[(k + 1) % 3];
                    add(std::min(from, to), Walk{std::max(from, to), 2 * i + (from < to ? 0 : 1)});
                }
            }
        });
        Edges edges{.object = &object};
        edges.uses.reserve(3 * mesh.triangles.size());
        walks.forEachRun([](const Walk& walk) { return walk.high; },
                         [&](std::uint32_t, std::span<const Walk> run) {
                             for (const Walk& walk : run) edges.uses.push_back(walk.use);
                             edges.begins.push_back(std::uint32_t(edges.uses.size()));
                         });
        m_objects.push_back(std::move(edges));
    }
}

VolumeCounts SilhouetteCounter::count(const glm::vec4& light) {
    VolumeCounts counts{};
    for (const Edges& edges : m_objects) add(edges, light, counts);
    for (VolumeCount& c : counts) {
        c.caps = of(counts, Silhouette::PerTriangle).caps;
        c.isPoint = light.w != 0;
    }
    VolumeCount& each = of(counts, Silhouette::PerTriangle);
    each.edges = each.sides = 3 * each.caps;
    return counts;
}

void SilhouetteCounter::add(const Edges& edges, const glm::vec4& light, VolumeCounts& counts) {
    const Mesh& mesh = edges.object->mesh;
    m_caps.resize(std::max(m_caps.size(), mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        const int side = orientation(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], light);
        m_caps[i] = std::int8_t(edges.object->twoSided ? side : std::max(side, 0));
        of(counts, Silhouette::PerTriangle).caps += m_caps[i] != 0;
    }

    std::size_t odd = 0, single = 0, wound = 0, weights = 0;
    for (std::size_t e = 0; e + 1 < edges.begins.size(); ++e) {
        int walks = 0, balance = 0;
        for (std::uint32_t i = edges.begins[e]; i < edges.begins[e + 1]; ++i) {
            const int cap = m_caps[edges.uses[i] / 2];
            walks += cap != 0;
            balance += edges.uses[i] % 2 ? -cap : cap;
        }
        odd += walks % 2 != 0;
        single += walks == 1;
        wound += balance != 0;
        weights += std::size_t(std::abs(balance));
    }
    const auto grow = [&](Silhouette silhouette, std::size_t edgeCount, std::size_t sides) {
        of(counts, silhouette).edges += edgeCount;
        of(counts, silhouette).sides += sides;
    };
    grow(Silhouette::Triangular, odd, odd);
    grow(Silhouette::Visible, single, single);
    grow(Silhouette::Manifold, wound, weights);  // no edge has other than two triangles
    grow(Silhouette::Winding, wound, weights);
}

}  // namespace gnomon
