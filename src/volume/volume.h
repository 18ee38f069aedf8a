#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace gnomon {

/// How the sides of shadow volumes are found.
enum class Silhouette {
    Triangular,  ///< edges toggled by each lit triangle (Kolivand and Sunar 2011, section 2.1)
    Visible,     ///< edges with exactly one lit triangle (Kolivand and Sunar 2011, section 2.2)
    Manifold,    ///< edges between a lit and an unlit triangle (Crow 1977, Bergeron 1986); two-manifolds only
    Winding,     ///< signed edge counter over any mesh (Aldridge and Woods, section 2.4)
    PerTriangle,  ///< one volume per triangle (brute force; Roettger et al. 2002, section 3.2)
};
constexpr int kSilhouettes = 5;

/// Which triangles of a caster close its volume, near and far (Aldridge and Woods, section 2).
enum class CapFaces {
    Lit,   ///< those that face the light: right for any mesh
    Away,  ///< those that face away: a smaller volume that starts behind the caster; right for closed meshes
};

/// One connected piece of a caster: the unit that is drawn fronts before backs.
/// Positions are shared with the scene's mesh, so that volume and surface have the same vertices to the bit.
struct Caster {
    std::uint32_t object = 0;                ///< index into Scene::objects
    std::vector<std::uint32_t> triangles{};  ///< indices into the object's triangles
    bool twoSided = false;
};

/// The casters of @p scene: the connected components (by shared vertices) of its casting objects, in mesh
/// order.
std::vector<Caster> casters(const Scene& scene);

/// An edge from which one side of a volume hangs, wound as the lit triangles walk it.
struct Side {
    std::uint32_t from = 0, to = 0;  ///< vertices of the object's mesh
    int weight = 1;                  ///< how many sides hang here
};

/// The part of a caster that one light sees: what a volume is made of.
struct LitCaster {
    std::uint32_t object = 0;
    std::vector<glm::uvec3> lit{};  ///< triangles that cast, wound counter-clockwise seen from the light
    std::vector<Side> sides{};      ///< for PerTriangle: three for each of lit, in its order, weight 1
    bool perTriangle = false;       ///< each of lit, with its three sides, is a volume of its own
};

/// Which triangles of @p caster cast a shadow of @p light, and the edges from which the sides of its volume
/// hang. A triangle that sees the light edge-on does not cast: the sign of orient3d is exact.
LitCaster litCaster(const Scene& scene, const Caster& caster, const glm::vec4& light, Silhouette silhouette);

/// The point at infinity to which @p position is extruded: direction away from @p light, w = 0.
/// Computed in float, once per vertex, so that all faces that share the vertex share it to the bit.
glm::vec4 extruded(const glm::vec3& position, const glm::vec4& light);

}  // namespace gnomon
