#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "volume/caster_mesh.h"
#include "volume/volume.h"

namespace gnomon {

/// The casters of a scene, made ready to be asked for many lights: what litCasters() is for one.
///
/// Adjacency and planes are found once, object by object; a light then costs well under 10 ns per triangle.
/// Asking changes nothing, so several threads may.
class SilhouetteFinder {
  public:
    /// @p scene's casting meshes must stay as and where they are while this is used.
    explicit SilhouetteFinder(const Scene& scene);

    /// Only @p caster, or any other set of one object's triangles.
    SilhouetteFinder(const Scene& scene, const Caster& caster);

    /// The casters in the order of casters(), as litCaster() describes them. Sides stand in the order of
    /// their lower, then their higher vertex.
    std::vector<LitCaster> lit(const glm::vec4& light, Silhouette silhouette,
                               CapFaces capFaces = CapFaces::Lit) const;

  private:
    /// Casters of one object. The triangles of the i-th are [begins[i], begins[i + 1]) of the mesh.
    struct Part {
        std::uint32_t object;
        bool twoSided;
        std::vector<std::uint32_t> begins;
        CasterMesh mesh;
    };
    struct Caps;

    void add(const Scene& scene, std::span<const Caster> casters);
    static void appendCaps(const Part& part, const Caps& caps, std::span<LitCaster> casters);
    static void appendSides(const Part& part, const Caps& caps, Silhouette silhouette,
                            std::span<LitCaster> casters);

    std::vector<Part> m_parts{};
};

}  // namespace gnomon
