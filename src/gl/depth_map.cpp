#include "gl/depth_map.h"

#include <algorithm>

#include "scene/framing.h"
#include "volume/orient.h"

namespace gnomon {
namespace {

/// Calls @p visit with the corners of each triangle that casts a shadow of @p light.
template <class Visit>
void eachCaster(const Scene& scene, const glm::vec4& light, Visit visit) {
    for (const Object& object : scene.objects) {
        if (!object.casts) continue;
        for (const glm::uvec3& t : object.mesh.triangles) {
            const glm::vec3 &a = object.mesh.positions[t.x], &b = object.mesh.positions[t.y],
                            &c = object.mesh.positions[t.z];
            const int side = orientation(a, b, c, light);
            if (side > 0 || (side < 0 && object.twoSided)) visit(glm::mat3(a, b, c));
        }
    }
}

glm::vec3 positionOf(const Scene& scene, const SurfaceOrigin& origin) {
    const Mesh& mesh = scene.objects[origin.object].mesh;
    const glm::uvec3& t = mesh.triangles[origin.triangle];
    return origin.weights.x * mesh.positions[t.x] + origin.weights.y * mesh.positions[t.y] +
           origin.weights.z * mesh.positions[t.z];
}

DepthMapFrame pointMap(const Scene& scene, const Light& light, const FrameSurfaces& surfaces) {
    DepthMapFrame map;
    const glm::dvec3 at(light.position);
    map.nearPlane = float(2e-3 * boundsOf(scene.objects).radius);
    map.faces.resize(6);
    for (int f = 0; f < 6; ++f) {
        const CubeFace& face = kCubeFaces[f];
        eachCaster(scene, light.position, [&](const glm::mat3& corners) {
            glm::dvec4 clip[3];
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 p = glm::dvec3(corners[k]) - at;
                const double w = glm::dot(p, glm::dvec3(face.forward));
                clip[k] = {glm::dot(p, glm::dvec3(face.right)), glm::dot(p, glm::dvec3(face.up)),
                           w - 2.0 * map.nearPlane, w};
            }
            if (clip[0].w <= 0 && clip[1].w <= 0 && clip[2].w <= 0) return;
            for (const int axis : {0, 1})
                for (const double sign : {1.0, -1.0})
                    if (std::all_of(clip, clip + 3,
                                    [&](const glm::dvec4& p) { return sign * p[axis] > p.w; }))
                        return;
            for (const glm::dvec4& p : clip) map.faces[std::size_t(f)].push_back(glm::vec4(p));
        });
    }
    for (const SurfaceOrigin& origin : surfaces.origins)
        map.coordinates.push_back(glm::vec3(glm::dvec3(positionOf(scene, origin)) - at));
    return map;
}

DepthMapFrame directionalMap(const Scene& scene, const Light& light, const FrameSurfaces& surfaces) {
    DepthMapFrame map;
    const Bounds bounds = boundsOf(scene.objects);
    const double radius = std::max(bounds.radius, 1e-30);
    const glm::dvec3 forward = -glm::normalize(glm::dvec3(light.position));
    const glm::dvec3 side = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, side)), up = glm::cross(right, forward);
    const auto mapped = [&](const glm::vec3& p) {
        const glm::dvec3 q = (glm::dvec3(p) - bounds.centre) / radius;
        return glm::dvec3(glm::dot(q, right), glm::dot(q, up), glm::dot(q, forward));
    };
    map.faces.resize(1);
    eachCaster(scene, light.position, [&](const glm::mat3& corners) {
        for (int k = 0; k < 3; ++k) map.faces[0].push_back(glm::vec4(mapped(corners[k]), 1));
    });
    for (const SurfaceOrigin& origin : surfaces.origins) {
        const glm::dvec3 p = mapped(positionOf(scene, origin));
        map.coordinates.push_back({float(p.x), float(p.y), float(p.z * 0.5 + 0.5)});
    }
    return map;
}

}  // namespace

const CubeFace kCubeFaces[6] = {
    {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
};

DepthMapFrame depthMapFrame(const Scene& scene, const Light& light, const FrameSurfaces& surfaces) {
    return light.position.w == 0 ? directionalMap(scene, light, surfaces) : pointMap(scene, light, surfaces);
}

}  // namespace gnomon
