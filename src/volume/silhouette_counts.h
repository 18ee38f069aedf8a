#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"
#include "volume/caster_mesh.h"
#include "volume/volume.h"

namespace gnomon {

/// What the volumes of one light are made of.
struct VolumeCount {
    std::size_t caps = 0;   ///< triangles that cap at the casters
    std::size_t edges = 0;  ///< from which sides hang
    std::size_t sides = 0;  ///< each edge as often as its weight
    bool isPoint = true;    ///< a directional light's sides close in a point, and there is no far cap

    /// Sides, light cap and far cap: quads and triangles.
    std::size_t polygons() const { return sides + (isPoint ? 2 : 1) * caps; }
    std::size_t triangles() const { return (isPoint ? 2 : 1) * (sides + caps); }
};

/// One for each Silhouette.
using VolumeCounts = std::array<VolumeCount, kSilhouettes>;

/// Counts what litCasters() with CapFaces::Lit would be made of, for all silhouettes at once and without
/// building anything: for many lights.
class SilhouetteCounter {
  public:
    /// @pre @p scene outlives this
    explicit SilhouetteCounter(const Scene& scene);

    /// The count for Manifold is right only where it has no refusal().
    VolumeCounts count(const glm::vec4& light);

  private:
    /// One casting object.
    struct Part {
        CasterMesh mesh;
        bool twoSided = false;
    };
    void add(const Part& part, const glm::vec4& light, VolumeCounts& counts);

    std::vector<Part> m_parts{};
    Facing m_facing{};  ///< kept for its memory, as the walks are
    std::vector<std::uint32_t> m_lit{}, m_away{};
};

}  // namespace gnomon
