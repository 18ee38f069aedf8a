#include "gl/depth_map.h"

#include <algorithm>

#include "volume/map_casters.h"

namespace gnomon {
namespace {

/// Where a surface's vertex lies, from the map's origin on, so that nothing is lost far from the world's.
glm::dvec3 coordinatesOf(const Scene& scene, const LightMap& map, const SurfaceOrigin& origin) {
    const Mesh& mesh = scene.objects[origin.object].mesh;
    const glm::uvec3& t = mesh.triangles[origin.triangle];
    glm::dvec3 at(0);
    for (int k = 0; k < 3; ++k)
        at += double(origin.weights[k]) * map.coordinates(glm::dvec3(mesh.positions[t[k]]));
    return at;
}

/// Appends a triangle in clip space of a cube's face, if the face may see it.
void appendToFace(const View& face, const glm::dvec3 corners[3], std::vector<glm::vec4>& triangles) {
    glm::dvec4 clip[3];
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p = corners[k] - face.eye;
        const double w = glm::dot(p, face.forward);
        clip[k] = {glm::dot(p, face.right), glm::dot(p, face.up), w - 2.0 * face.nearPlane, w};
    }
    if (clip[0].w <= 0 && clip[1].w <= 0 && clip[2].w <= 0) return;
    for (const int axis : {0, 1})
        for (const double sign : {1.0, -1.0})
            if (std::all_of(clip, clip + 3, [&](const glm::dvec4& p) { return sign * p[axis] > p.w; }))
                return;
    for (const glm::dvec4& p : clip) triangles.emplace_back(p);
}

}  // namespace

DepthMapFrame depthMapFrame(const Scene& scene, const Light& light, const FrameSurfaces& surfaces) {
    // Clip space does not depend on the map's size.
    const LightMap map = lightMap(scene, light.position, 1);
    DepthMapFrame out;
    out.nearPlane = map.parallel ? 0 : float(map.faces.front().nearPlane);
    out.faces.resize(map.faces.size());
    eachMapCaster(scene, light.position, [&](std::uint32_t object, const glm::uvec3& t) {
        const Mesh& mesh = scene.objects[object].mesh;
        const glm::dvec3 corners[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
        if (!map.parallel) {
            for (std::size_t f = 0; f < map.faces.size(); ++f)
                appendToFace(map.faces[f], corners, out.faces[f]);
            return;
        }
        for (const glm::dvec3& corner : corners) {
            const glm::dvec3 at = map.coordinates(corner);
            out.faces[0].emplace_back(at.x, at.y, 2 * at.z - 1, 1);
        }
    });
    for (const SurfaceOrigin& origin : surfaces.origins)
        out.coordinates.emplace_back(coordinatesOf(scene, map, origin));
    return out;
}

}  // namespace gnomon
