#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "scene/scene.h"
#include "scene/view.h"

namespace gnomon {

/// A rectangle from @p corner along @p u and @p v; its front is the side from which u turns to v
/// counter-clockwise.
inline Mesh rectangle(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
    return {.positions = {corner, corner + u, corner + u + v, corner + v},
            .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

/// A floor at y = 0 that only receives.
inline Object floorOf(float half) {
    return {.name = "floor",
            .mesh = rectangle({-half, 0, -half}, {0, 0, 2 * half}, {2 * half, 0, 0}),
            .casts = false};
}

inline Mesh sphere(const glm::vec3& centre, float radius, int rings, int sectors) {
    Mesh mesh;
    const auto add = [&](double theta, double phi) {
        mesh.positions.push_back(centre + radius * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                                             std::sin(theta) * std::sin(phi)));
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

/// Random triangles in the cube from -1 to 1: one caster, one two-sided caster, one receiver.
inline Scene soup(int trianglesEach, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    Scene scene;
    for (int i = 0; i < 3; ++i) {
        Object object{.casts = i != 2, .twoSided = i == 1};
        for (int t = 0; t < trianglesEach; ++t) {
            const auto first = static_cast<std::uint32_t>(object.mesh.positions.size());
            for (int k = 0; k < 3; ++k)
                object.mesh.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
            // Every other one shares an edge with the one before.
            if (t % 2 == 0)
                object.mesh.triangles.push_back({first, first + 1, first + 2});
            else
                object.mesh.triangles.push_back({first - 1, first - 2, first});
        }
        scene.objects.push_back(std::move(object));
    }
    return scene;
}

}  // namespace gnomon
