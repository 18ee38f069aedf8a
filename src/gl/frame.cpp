#include "gl/frame.h"

#include <algorithm>
#include <cmath>

#include "volume/surface_cut.h"

namespace gnomon {
namespace {

VertexColour rounded(const glm::dvec3& colour) {
    const glm::dvec3 c = glm::clamp(colour, 0.0, 1.0) * 255.0 + 0.5;
    return {std::uint8_t(c.r), std::uint8_t(c.g), std::uint8_t(c.b), 255};
}

/// The light's part at the corners of a triangle, for the side that the eye sees.
struct CornerColours {
    glm::dvec3 at[3];
};

CornerColours shade(const Object& object, const glm::uvec3& t, const Light& light, double lightShare,
                    const View& view) {
    const glm::dvec3 corners[3] = {object.mesh.positions[t.x], object.mesh.positions[t.y],
                                   object.mesh.positions[t.z]};
    glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (glm::dot(normal, view.eye - corners[0]) < 0) normal = -normal;
    CornerColours colours{};
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 toLight = glm::dvec3(light.position) - double(light.position.w) * corners[k];
        const double cosine = std::max(0.0, glm::dot(normal, glm::normalize(toLight)));
        colours.at[k] = glm::dvec3(object.colour) * glm::dvec3(light.colour) * lightShare * cosine;
    }
    return colours;
}

}  // namespace

FrameSurfaces frameSurfaces(const Scene& scene, const View& view) {
    FrameSurfaces out;
    out.background = scene.background;
    for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
        const Object& object = scene.objects[o];
        const VertexColour ambient = rounded(glm::dvec3(object.colour) * double(scene.ambient));
        SurfaceCut cut(object.mesh, view);
        for (std::uint32_t t = 0; t < object.mesh.triangles.size(); ++t) {
            for (const SurfacePoint& p : cut.triangles(object.mesh.triangles[t])) {
                out.positions.push_back(p.position);
                out.origins.push_back({o, t, glm::vec3(p.weights)});
            }
        }
        out.ambient.resize(out.positions.size(), ambient);
    }
    return out;
}

LightColours lightColours(const Scene& scene, const Light& light, const View& view,
                          const FrameSurfaces& surfaces) {
    LightColours out;
    out.diffuse.reserve(surfaces.positions.size());
    out.lit.reserve(surfaces.positions.size());
    CornerColours corners{};
    const SurfaceOrigin* last = nullptr;
    for (const SurfaceOrigin& origin : surfaces.origins) {
        const Object& object = scene.objects[origin.object];
        if (!last || last->object != origin.object || last->triangle != origin.triangle)
            corners = shade(object, object.mesh.triangles[origin.triangle], light, 1.0 - scene.ambient, view);
        last = &origin;
        glm::dvec3 colour(0);
        for (int k = 0; k < 3; ++k) colour += double(origin.weights[k]) * corners.at[k];
        out.diffuse.push_back(rounded(colour));
        out.lit.push_back(rounded(colour + glm::dvec3(object.colour) * double(scene.ambient)));
    }
    return out;
}

}  // namespace gnomon
