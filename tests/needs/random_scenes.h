#pragma once

#include <random>
#include <utility>
#include <vector>

#include "scene/primitives.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "truth/scenes.h"

namespace gnomon {

/// Random small scenes: a few casters over a floor and before walls, or with nothing around them.
class RandomScenes {
  public:
    explicit RandomScenes(unsigned seed) : m_random(seed) {}

    Scene next() {
        Scene scene;
        const int casters = 1 + int(m_random() % 4);
        for (int i = 0; i < casters; ++i) scene.objects.push_back(caster());
        // Surroundings: some cast too.
        if (chance(0.7)) scene.objects.push_back(sheet({-6, 0, -6}, {0, 0, 12}, {12, 0, 0}));
        if (chance(0.4)) scene.objects.push_back(sheet({-6, -1, -3}, {12, 0, 0}, {0, 7, 0}));
        if (chance(0.3)) scene.objects.push_back(sheet(point(2), point(4), point(4)));
        if (chance(0.2)) scene.objects.push_back(sheet({-3, -1, -6}, {0, 7, 0}, {0, 0, 12}));
        for (Object& object : scene.objects)
            for (glm::vec3& p : object.mesh.positions) p += glm::vec3(0, 1, 0);

        const glm::vec3 from = chance(0.7) ? point(1) + glm::vec3(0, 6, 0) : point(4);
        scene.lights = {{.position = chance(0.6) ? glm::vec4(from, 1) : glm::vec4(glm::normalize(from), 0)}};
        const bool isNear = chance(0.3);  // among the casters, and so in volumes and close to surfaces
        scene.frames = {{.eye = isNear ? point(1.5f) + glm::vec3(0, 1.5f, 0) : point(5) + glm::vec3(0, 3, 0),
                         .target = point(1.5f) + glm::vec3(0, 1, 0),
                         .fovDegrees = isNear ? 50.0f : 25.0f,
                         .nearPlane = chance(0.5) ? 0.1f : 0.5f}};
        return scene;
    }

    bool chance(double share) { return std::uniform_real_distribution<double>(0, 1)(m_random) < share; }

    glm::vec3 point(float size) {
        std::uniform_real_distribution<float> coordinate(-size, size);
        return {coordinate(m_random), coordinate(m_random), coordinate(m_random)};
    }

  private:
    Object caster() {
        Object object{.twoSided = chance(0.25)};
        switch (m_random() % 5) {
            case 0:
                object.mesh = box(glm::dvec3(glm::abs(point(1))) + 0.1);
                break;
            case 1:  // flat on one side, so that it may lie on a floor
                object.mesh = {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0.3f, 1, 0.2f}},
                               .triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
                break;
            case 2:
                object.mesh = {.positions = {point(1), point(1), point(1)}, .triangles = {{0, 1, 2}}};
                break;
            case 3:
                object.mesh = sphere({0, 0, 0}, 0.3f + 0.2f * point(1).x, 4, 5);
                break;
            default: {  // open, bent in any way
                object.mesh.positions = {point(0.3f), point(1)};
                const std::uint32_t pages = 2 + std::uint32_t(m_random() % 4);
                for (std::uint32_t i = 0; i < pages; ++i) {
                    object.mesh.positions.push_back(point(1));
                    object.mesh.triangles.push_back(chance(0.5) ? glm::uvec3(0, i + 1, i + 2)
                                                                : glm::uvec3(0, i + 2, i + 1));
                }
            }
        }
        const float size = chance(0.2) ? 0.2f : 1;
        const glm::vec3 at = chance(0.2) ? glm::vec3(1, 0, 1) * point(2) : point(2);  // or on the floor
        for (glm::vec3& p : object.mesh.positions) p = size * p + at;
        return object;
    }

    Object sheet(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
        return {.mesh = rectangle(corner, u, v), .casts = chance(0.3), .twoSided = chance(0.2)};
    }

    std::mt19937 m_random;
};

}  // namespace gnomon
