#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "scene/scene.h"

namespace gnomon {

inline Mesh cube(const glm::vec3& centre, float half) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(centre + half * glm::vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return mesh;
}

/// A closed sphere of rings and sectors whose radius wobbles by up to the factor 1 +- @p wobble.
inline Mesh blob(const glm::vec3& centre, float radius, int rings, int sectors, float wobble, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> factor(1 - wobble, 1 + wobble);
    Mesh mesh;
    const auto add = [&](double theta, double phi) {
        const double r = radius * factor(random);
        mesh.positions.push_back(centre + glm::vec3(r * std::sin(theta) * std::cos(phi), r * std::cos(theta),
                                                    r * std::sin(theta) * std::sin(phi)));
    };
    add(0, 0);
    for (int i = 1; i < rings; ++i) {
        for (int k = 0; k < sectors; ++k)
            add(std::numbers::pi * i / rings, 2 * std::numbers::pi * k / sectors);
    }
    add(std::numbers::pi, 0);

    const auto at = [&](int ring, int sector) {
        return static_cast<std::uint32_t>(1 + (ring - 1) * sectors + sector % sectors);
    };
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (int k = 0; k < sectors; ++k) {
        mesh.triangles.push_back({0, at(1, k + 1), at(1, k)});
        for (int i = 1; i + 1 < rings; ++i) {
            mesh.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
            mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
        }
        mesh.triangles.push_back({last, at(rings - 1, k), at(rings - 1, k + 1)});
    }
    return mesh;
}

/// Triangles of random vertices, of which many share edges and some have no area.
inline Mesh soup(std::uint32_t vertices, std::uint32_t triangles, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    Mesh mesh;
    for (std::uint32_t i = 0; i < vertices; ++i)
        mesh.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
    for (std::uint32_t i = 0; i < triangles; ++i)
        mesh.triangles.push_back({random() % vertices, random() % vertices, random() % vertices});
    return mesh;
}

inline Scene sceneOf(Mesh mesh) {
    Scene scene;
    scene.objects.push_back({.name = "mesh", .mesh = std::move(mesh)});
    return scene;
}

}  // namespace gnomon
