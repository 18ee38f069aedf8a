#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"
#include "scene/view.h"

namespace gnomon {

/// The casters of a scene as triangles with adjacency, for a geometry shader that finds their silhouettes
/// itself (Usta et al. 2019, section 3).
///
/// Of the two triangles at an edge one holds it and looks at the other's far corner; where more meet, they
/// are taken in pairs that walk the edge in opposite directions, and what is left over has no neighbour. So
/// any mesh can be drawn: the sides that its pairs get add up to those of the signed counter.
struct SilhouetteMesh {
    /// xyz world; w: 1 a vertex of a one-sided caster, 2 of a two-sided one, 0 stands for "no neighbour", -1
    /// for "the neighbour holds this edge".
    std::vector<glm::vec4> vertices{};
    std::vector<std::uint32_t> indices{};  ///< GL_TRIANGLES_ADJACENCY

    // What the shader needs of the frame.
    glm::dvec4 light{};
    glm::dmat4 clipFromWorld{1};
    glm::dvec3 eye{};
    double nearPlane = 0;
    glm::dvec2 window{};  ///< limits of |x| and |y| over w
};

SilhouetteMesh silhouetteMesh(const Scene& scene, const glm::vec4& light, const View& view);

}  // namespace gnomon
