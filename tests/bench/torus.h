#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "scene/scene.h"

namespace gnomon {

/// A closed torus of @p n by @p n quads, 2 n^2 triangles with shared vertices, in grid order: outer
/// radius 1.4, inner 0.6, around the y axis.
inline Mesh torusGrid(std::uint32_t n) {
    Mesh mesh;
    mesh.positions.reserve(std::size_t(n) * n);
    mesh.triangles.reserve(2 * std::size_t(n) * n);
    const double step = 2 * std::numbers::pi / n;
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t k = 0; k < n; ++k) {
            const double r = 1 + 0.4 * std::cos(step * k);
            mesh.positions.push_back(
                {r * std::cos(step * i), 0.4 * std::sin(step * k), r * std::sin(step * i)});
        }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t i1 = (i + 1) % n, k1 = (k + 1) % n;
            const std::uint32_t a = i * n + k, b = i1 * n + k, c = i1 * n + k1, d = i * n + k1;
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({a, d, c});
        }
    }
    return mesh;
}

/// The same surface with triangles and vertices in random order, each triangle begun at a random corner.
inline Mesh shuffled(const Mesh& mesh, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> place(mesh.positions.size());
    std::iota(place.begin(), place.end(), 0u);
    std::shuffle(place.begin(), place.end(), random);
    Mesh result{.positions = std::vector<glm::vec3>(mesh.positions.size())};
    for (std::size_t v = 0; v < place.size(); ++v) result.positions[place[v]] = mesh.positions[v];
    result.triangles = mesh.triangles;
    std::shuffle(result.triangles.begin(), result.triangles.end(), random);
    for (glm::uvec3& t : result.triangles) {
        t = {place[t.x], place[t.y], place[t.z]};
        for (auto turns = random() % 3; turns > 0; --turns) t = {t.y, t.z, t.x};
    }
    return result;
}

/// Light @p i of a ring of @p count around the torus, a little above its middle.
inline glm::vec4 ringLight(int i, int count) {
    const double angle = 2 * std::numbers::pi * (i + 0.3) / count;
    return {3 * std::cos(angle), 1.1, 3 * std::sin(angle), 1};
}

}  // namespace gnomon
