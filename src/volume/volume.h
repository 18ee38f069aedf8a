#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
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

/// An edge from which one side of a volume hangs, wound as the cap triangle that it hangs from walks it.
struct Side {
    std::uint32_t from = 0, to = 0;  ///< vertices of the object's mesh
    int weight = 1;                  ///< how many sides hang here, more than 0
};

/// What one light makes of a caster: the triangles and edges that its volume is made of.
struct LitCaster {
    std::uint32_t object = 0;
    std::vector<glm::uvec3> lit{};  ///< triangles that cap the volume, counter-clockwise seen from the light
    std::vector<Side> sides{};      ///< for PerTriangle: three for each of lit, in its order, weight 1
    bool perTriangle = false;       ///< each of lit, with its three sides, is a volume of its own
};

/// The cap triangles of @p caster in @p light, and the edges from which the sides of its volume hang.
///
/// A triangle faces the light, faces away, or is edge-on by the exact sign of orientation(); one that is
/// edge-on is never a cap. Those that face away are turned round (their first two vertices change places),
/// and are caps with CapFaces::Away, and of two-sided casters always: there both sides cast, so Away and Lit
/// are the same.
///
/// With f cap triangles that walk an edge one way and b that walk it the other way, the sides there are
///   Winding      f - b, in the direction of its sign
///   Manifold     the same; only edges with two triangles are looked at
///   Triangular   one where f + b is odd: toggling leaves it in. In the direction of the majority, which no
///                order of the triangles changes (a list would keep that of whichever comes last)
///   Visible      one where f + b is 1, in the direction of that triangle
///   PerTriangle  all f + b
/// So Triangular and Visible leave out sides where several caps walk an edge the same way: limitation().
///
/// @pre no refusal() of @p scene
LitCaster litCaster(const Scene& scene, const Caster& caster, const glm::vec4& light, Silhouette silhouette,
                    CapFaces capFaces = CapFaces::Lit);

/// litCaster() of all casters of @p scene, in their order.
std::vector<LitCaster> litCasters(const Scene& scene, const glm::vec4& light, Silhouette silhouette,
                                  CapFaces capFaces = CapFaces::Lit);

/// Why volumes of the casters of @p scene can't be built so: one phrase that names the first object and edge
/// in the way (indices, and positions in world space). Nothing if they can.
///
/// Manifold needs two triangles at each edge, which walk it in opposite directions. CapFaces::Away needs
/// one-sided casters to be closed: at each edge as many triangles that walk it one way as the other.
/// Triangular and Visible take any mesh, though their volumes may leak: limitation(). A triangle with a
/// repeated vertex never casts and has no say.
std::optional<std::string> refusal(const Scene& scene, Silhouette silhouette,
                                   CapFaces capFaces = CapFaces::Lit);

/// How volumes of @p mesh can come out wrong for some light although refusal() has nothing against it: one
/// phrase that names the first edge in the way. Nothing for builders that are right for any mesh, nor for
/// meshes with which Triangular and Visible are right in any light: where no edge has two triangles that can
/// both be caps and walk it the same way then. A two-sided caster has such edges wherever it bends.
std::optional<std::string> limitation(const Mesh& mesh, Silhouette silhouette, bool twoSided = false);

/// The point at infinity to which @p position is extruded: direction away from @p light, w = 0.
/// Computed in float, once per vertex, so that all faces that share the vertex share it to the bit.
glm::vec4 extruded(const glm::vec3& position, const glm::vec4& light);

}  // namespace gnomon
