#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "scene/scene.h"
#include "truth/candidates.h"
#include "truth/light_grid.h"
#include "truth/predicates.h"
#include "volume/volume.h"

namespace gnomon {

/// What the side of a volume hangs from, world space.
struct SideEdge {
    glm::vec3 from{}, to{};
    int weight = 1;
};

/// A scene as one light sees it, ready to be searched along rays.
struct World {
    World(const Scene& scene, const glm::vec4& light, Silhouette silhouette);

    glm::dvec4 light;
    std::vector<LitTriangle> triangles;
    std::vector<SideEdge> sides;
    Candidates surfaces;
    Candidates edges;
    LightGrid casters;

    /// Calls @p visit(index) for each triangle or side that may be near the segment from @p point to the
    /// light, until it returns false.
    template <class Visit>
    void towardsLight(const Candidates& among, const glm::dvec3& point, Visit&& visit) const {
        const glm::dvec3 way = light.w == 0 ? glm::dvec3(light) : glm::dvec3(light) - point;
        const double length = glm::length(way);
        if (length == 0) return;
        among.anyOrder(point, way / length, 0,
                       light.w == 0 ? std::numeric_limits<double>::infinity() : length,
                       [&](std::uint32_t index) {
                           return visit(index) ? std::numeric_limits<double>::infinity()
                                               : -std::numeric_limits<double>::infinity();
                       });
    }

    /// Calls @p visit(index, crossed) for each caster's triangle that may cross the segment from any point
    /// within @p radius of @p point to the light, until it returns false; for some more than once. @p crossed
    /// is Yes where it is certain that all those segments cross it.
    /// @pre radius is less than half of the surfaces' reach
    template <class Visit>
    void castersTowardsLight(const RayPoint& point, double radius, Visit&& visit) const {
        if (casters.visit(point.position(), point.error(), radius, visit)) return;
        towardsLight(surfaces, point.position(), [&](std::uint32_t index) {
            return !triangles[index].casts || visit(index, Answer::Unsure);
        });
    }
};

}  // namespace gnomon
