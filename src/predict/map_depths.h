#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "predict/seen_surfaces.h"
#include "scene/light_map.h"
#include "scene/scene.h"

namespace gnomon {

/// What may stand in one texel of a depth map.
struct StoredDepth {
    double inverse = 0;  ///< Seen::inverse of a caster: 0 where there is none
    double slack = 0;    ///< how far from it the stored depth may be, in window depth
};

/// The depth map of one light: in each texel the nearest caster along the light's ray through its centre,
/// and what a rasteriser may store instead. Depends on no camera. Texels are found when they are asked for,
/// a tile at a time, and kept.
class MapDepths {
  public:
    /// @param scene  must outlive it
    /// @param size   texels per side
    /// @pre at least one object with a vertex
    MapDepths(const Scene& scene, const glm::vec4& light, int size);
    ~MapDepths();

    const LightMap& map() const { return m_map; }
    int size() const { return m_size; }

    /// What a texel may hold, what it holds in exact arithmetic first; rows from the bottom, as a texture
    /// has them. Valid while this lives.
    std::span<const StoredDepth> at(int face, int x, int y);

    /// Seen::inverse of the nearest caster other than @p own along the light's ray through a position of the
    /// map, in texels: what a map without texels would hold. 0 if there is none.
    /// @param uncut  casters before the map's near plane too
    double along(int face, double x, double y, const SurfaceFace& own, bool uncut = false) const;

  private:
    struct Tile;

    LightMap m_map;
    int m_size;
    std::vector<SeenSurfaces> m_faces{};
    std::vector<std::vector<std::unique_ptr<const Tile>>> m_tiles{};
};

}  // namespace gnomon
