#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "volume/clip_space.h"
#include "volume/window_clip.h"

namespace gnomon {

/// A point of a surface's triangle in clip space.
struct SurfacePoint {
    glm::vec4 position{};
    glm::dvec3 weights{};  ///< of the triangle's corners, in the order in which it was given
};
inline const glm::vec4& positionOf(const SurfacePoint& p) {
    return p.position;
}
inline SurfacePoint between(const SurfacePoint& a, const SurfacePoint& b, double v, double u) {
    return {between(a.position, b.position, v, u), v * a.weights + u * b.weights};
}

/// Cuts the surfaces of one mesh at the near plane and the window's sides as cutVolume() cuts the light caps
/// on them: the same polygons to the bit, so that a cap has the depth of its surface.
class SurfaceCut {
  public:
    SurfaceCut(const Mesh& mesh, const View& view);

    /// The part of the triangle that the window shows, as a triangle list; valid until the next call.
    std::span<const SurfacePoint> triangles(const glm::uvec3& triangle);

  private:
    ClipSpace m_space;
    WindowClip<SurfacePoint> m_window;
    std::vector<SurfacePoint> m_polygon{}, m_triangles{};
};

}  // namespace gnomon
