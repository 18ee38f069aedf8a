#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "scene/scene.h"
#include "volume/orient.h"

namespace gnomon {

/// Calls @p visit(object, triangle) for each triangle that is drawn into the depth map of @p light: those
/// that truth lets cast, which face the light, or belong to a two-sided caster and are not seen edge-on.
template <class Visit>
void eachMapCaster(const Scene& scene, const glm::vec4& light, const Visit& visit) {
    for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
        const Object& object = scene.objects[o];
        if (!object.casts) continue;
        for (const glm::uvec3& t : object.mesh.triangles) {
            const int side = orientation(object.mesh.positions[t.x], object.mesh.positions[t.y],
                                         object.mesh.positions[t.z], light);
            if (side > 0 || (side < 0 && object.twoSided)) visit(o, t);
        }
    }
}

}  // namespace gnomon
