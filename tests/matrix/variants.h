#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "scene/primitives.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "scene/weld.h"
#include "volume/volume.h"

// The same frame told in another way: none of these may change what is seen, nor what is in shadow.

namespace gnomon {

/// Calls @p visit with each position of the scene: vertices, eyes, targets, and point lights.
template <class Visit>
void eachPosition(Scene& scene, const Visit& visit) {
    for (Object& object : scene.objects)
        for (glm::vec3& p : object.mesh.positions) visit(p);
    for (Camera& camera : scene.frames) {
        visit(camera.eye);
        visit(camera.target);
    }
    for (Light& light : scene.lights) {
        if (light.position.w == 0) continue;
        glm::vec3 p(light.position);
        visit(p);
        light.position = {p, 1};
    }
}

/// The exponent of the power of two that is above all coordinates.
inline int exponentOf(Scene scene) {
    float largest = 0;
    eachPosition(scene, [&](const glm::vec3& p) {
        for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(p[k]));
    });
    return largest > 0 ? std::ilogb(largest) + 1 : 0;
}

/// All positions rounded to a grid on which the middle of two of them is a float, and so is one of them moved
/// by a power of two that is no larger than that above the scene. A scene whose coordinates are short stays
/// as it is.
inline Scene onGrid(Scene scene) {
    const float step = std::ldexp(1.0f, exponentOf(scene) - 22);
    eachPosition(scene, [&](glm::vec3& p) { p = glm::round(p / step) * step; });
    // Vertices may have become one.
    for (Object& object : scene.objects)
        object.mesh = weld(object.mesh.positions, object.mesh.triangles, scene.dropped);
    return scene;
}

/// Another corner first in each triangle.
inline Scene cornersTurned(Scene scene, unsigned seed) {
    std::mt19937 random(seed);
    for (Object& object : scene.objects) {
        for (glm::uvec3& t : object.mesh.triangles)
            t = random() % 2 ? glm::uvec3(t.y, t.z, t.x) : glm::uvec3(t.z, t.x, t.y);
    }
    return scene;
}

/// Triangles in another order, within each connected piece: the pieces, each of which is a volume, keep
/// theirs.
inline Scene trianglesShuffled(Scene scene, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<bool> casts;
    for (Object& object : scene.objects) {
        casts.push_back(object.casts);
        object.casts = true;  // so that those of receivers are found as well
    }
    const std::vector<Caster> pieces = casters(scene);
    for (const Caster& piece : pieces) {
        auto& triangles = scene.objects[piece.object].mesh.triangles;
        std::vector<glm::uvec3> shuffled;
        for (const std::uint32_t t : piece.triangles) shuffled.push_back(triangles[t]);
        std::shuffle(shuffled.begin(), shuffled.end(), random);
        for (std::size_t i = 0; i < shuffled.size(); ++i) triangles[piece.triangles[i]] = shuffled[i];
    }
    for (std::size_t i = 0; i < casts.size(); ++i) scene.objects[i].casts = casts[i];
    return scene;
}

/// Vertices under other indices.
inline Scene verticesShuffled(Scene scene, unsigned seed) {
    std::mt19937 random(seed);
    for (Object& object : scene.objects) {
        Mesh& mesh = object.mesh;
        std::vector<std::uint32_t> to(mesh.positions.size());
        std::iota(to.begin(), to.end(), 0u);
        std::shuffle(to.begin(), to.end(), random);
        const std::vector<glm::vec3> before = mesh.positions;
        for (std::size_t i = 0; i < to.size(); ++i) mesh.positions[to[i]] = before[i];
        for (glm::uvec3& t : mesh.triangles) t = {to[t.x], to[t.y], to[t.z]};
    }
    return scene;
}

/// Objects, and all triangles within them, in another order: so are the volumes.
inline Scene volumesShuffled(Scene scene, unsigned seed) {
    std::mt19937 random(seed);
    std::shuffle(scene.objects.begin(), scene.objects.end(), random);
    for (Object& object : scene.objects)
        std::shuffle(object.mesh.triangles.begin(), object.mesh.triangles.end(), random);
    return scene;
}

/// @pre onGrid(), and each component of @p offset 0 or a power of two no larger than that above the scene
inline Scene moved(Scene scene, const glm::vec3& offset) {
    eachPosition(scene, [&](glm::vec3& p) { p += offset; });
    return scene;
}

/// Two to the power of @p exponent times as large.
inline Scene scaled(Scene scene, int exponent) {
    const float factor = std::ldexp(1.0f, exponent);
    eachPosition(scene, [&](glm::vec3& p) { p *= factor; });
    for (Camera& camera : scene.frames) camera.nearPlane *= factor;
    return scene;
}

/// Turned by 90 degrees about @p axis (0 to 2: x, y, z), with eye and light.
inline Scene turned(Scene scene, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto turn = [&](auto& p) {
        const float before = p[u];
        p[u] = -p[v];
        p[v] = before;
    };
    for (Camera& camera : scene.frames) {
        // viewOf() takes an axis of the world for an up vector along the line of sight; take the same before
        // turning.
        const glm::dvec3 sight = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
        const glm::dvec3 up(camera.up);
        if (glm::length(glm::cross(sight, up)) < 1e-6 * glm::length(up))
            camera.up = std::abs(sight.z) < 0.9 ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
        turn(camera.up);
    }
    eachPosition(scene, [&](glm::vec3& p) { turn(p); });
    for (Light& light : scene.lights)
        if (light.position.w == 0) turn(light.position);
    return scene;
}

/// Some edges of each object get a vertex in their middle, and all triangles there become two. No T-junction
/// comes of it. @pre onGrid()
inline Scene edgesSplit(Scene scene, int edgesPerObject, unsigned seed) {
    std::mt19937 random(seed);
    for (Object& object : scene.objects) {
        Mesh& mesh = object.mesh;
        for (int i = 0; i < edgesPerObject && !mesh.triangles.empty(); ++i) {
            const glm::uvec3 chosen = mesh.triangles[random() % mesh.triangles.size()];
            const int k = int(random() % 3);
            const std::uint32_t a = chosen[k], b = chosen[(k + 1) % 3];
            // Only edges whose ends are on the grid: the middle of a middle may be no float.
            const glm::vec3 middle = mesh.positions[a] / 2.0f + mesh.positions[b] / 2.0f;
            const bool isExact =
                glm::dvec3(middle) * 2.0 == glm::dvec3(mesh.positions[a]) + glm::dvec3(mesh.positions[b]);
            const auto same = std::find(mesh.positions.begin(), mesh.positions.end(), middle);
            if (!isExact || same != mesh.positions.end()) continue;
            const auto m = std::uint32_t(mesh.positions.size());
            mesh.positions.push_back(middle);
            const std::size_t before = mesh.triangles.size();
            for (std::size_t t = 0; t < before; ++t) {
                for (int c = 0; c < 3; ++c) {
                    const glm::uvec3 whole = mesh.triangles[t];
                    const std::uint32_t from = whole[c], to = whole[(c + 1) % 3], apex = whole[(c + 2) % 3];
                    if (std::minmax(from, to) != std::minmax(a, b)) continue;
                    mesh.triangles[t] = {from, m, apex};
                    mesh.triangles.push_back({m, to, apex});
                    break;
                }
            }
        }
    }
    return scene;
}

/// With one closed caster more, beyond one side of the pyramid of sight like all of its volume; nothing where
/// each place is such that a light would carry its volume into view.
inline std::optional<Scene> withUnseenCaster(Scene scene) {
    const View view = viewOf(scene.frames.front(), 4, 3);
    const double size = std::ldexp(1.0, exponentOf(scene) - 4);
    const std::array<glm::dvec3, 5> inwards = {
        view.forward, view.tanHalfX * view.forward + view.right, view.tanHalfX * view.forward - view.right,
        view.tanHalfY * view.forward + view.up, view.tanHalfY * view.forward - view.up};
    for (glm::dvec3 inward : inwards) {
        inward = glm::normalize(inward);
        double distance = 2 * size + 2 * view.nearPlane;
        bool isHidden = true;
        for (const Light& light : scene.lights) {
            const glm::dvec3 l(light.position);
            if (light.position.w == 0)
                isHidden = isHidden && glm::dot(inward, l) >= 0;
            else
                distance = std::max(distance, 2 * size - glm::dot(inward, l - view.eye));
        }
        if (!isHidden) continue;
        Object unseen{.name = "unseen", .mesh = box(glm::dvec3(size))};
        for (glm::vec3& p : unseen.mesh.positions) p += glm::vec3(view.eye - distance * inward);
        scene.objects.insert(scene.objects.begin(), std::move(unseen));
        return scene;
    }
    return {};
}

}  // namespace gnomon
