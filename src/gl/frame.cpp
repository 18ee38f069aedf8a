#include "gl/frame.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

Rgba rounded(const glm::dvec3& colour) {
    const glm::dvec3 c = glm::clamp(colour, 0.0, 1.0) * 255.0 + 0.5;
    return {std::uint8_t(c.r), std::uint8_t(c.g), std::uint8_t(c.b), 255};
}

}  // namespace

FrameSurfaces frameSurfaces(const Scene& scene, const Light& light, const View& view) {
    FrameSurfaces out;
    out.background = scene.background;
    const std::size_t vertices = 3 * triangleCount(scene);
    out.positions.reserve(vertices);
    for (auto* colours : {&out.lit, &out.diffuse, &out.ambient}) colours->reserve(vertices);

    const glm::dmat4 clip = clipFromEye(view) * eyeFromWorld(view);
    std::vector<glm::vec4> projected;
    for (const Object& object : scene.objects) {
        projected.clear();
        for (const glm::vec3& p : object.mesh.positions)
            projected.push_back(glm::vec4(clip * glm::dvec4(p, 1)));
        const glm::dvec3 reflectance = object.colour;
        for (const glm::uvec3& t : object.mesh.triangles) {
            const glm::dvec3 a = object.mesh.positions[t.x], b = object.mesh.positions[t.y],
                             c = object.mesh.positions[t.z];
            glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
            if (glm::dot(normal, view.eye - a) < 0) normal = -normal;
            const glm::dvec3 corners[3] = {a, b, c};
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 toLight = glm::dvec3(light.position) - double(light.position.w) * corners[k];
                const double cosine = std::max(0.0, glm::dot(normal, glm::normalize(toLight)));
                const glm::dvec3 diffuse =
                    reflectance * glm::dvec3(light.colour) * (1.0 - scene.ambient) * cosine;
                const glm::dvec3 ambient = reflectance * double(scene.ambient);
                out.positions.push_back(projected[t[k]]);
                out.lit.push_back(rounded(ambient + diffuse));
                out.diffuse.push_back(rounded(diffuse));
                out.ambient.push_back(rounded(ambient));
            }
        }
    }
    return out;
}

}  // namespace gnomon
