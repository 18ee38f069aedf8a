#include "scene/weld.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <limits>

namespace gnomon {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

std::size_t hashOf(const glm::vec3& p) {
    std::uint64_t h = 0;
    for (int k = 0; k < 3; ++k) {
        h = (h ^ std::bit_cast<std::uint32_t>(p[k])) * 0x9e3779b97f4a7c15u;
        h ^= h >> 29;
    }
    return h;
}

/// For each position, the first one that equals it.
std::vector<std::uint32_t> firstEqual(std::span<const glm::vec3> positions) {
    const std::size_t slots = std::bit_ceil(2 * positions.size() + 1);
    std::vector<std::uint32_t> table(slots, kNone);
    std::vector<std::uint32_t> first(positions.size());
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
        const glm::vec3 p = positions[v] + 0.0f;  // -0 + 0 is +0
        std::size_t slot = hashOf(p) & (slots - 1);
        while (table[slot] != kNone && positions[table[slot]] != p) slot = (slot + 1) & (slots - 1);
        if (table[slot] == kNone) table[slot] = v;
        first[v] = table[slot];
    }
    return first;
}

bool repeatsVertex(const glm::uvec3& t) {
    return t.x == t.y || t.y == t.z || t.z == t.x;
}

/// Twice the area, as a vector. The differences of floats and their products are exact in double unless their
/// exponents lie far apart, so that exactly collinear corners give exactly zero.
glm::dvec3 areaVector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

/// Newell's normal: the sum over a polygon's edges, for any outline.
glm::dvec3 polygonNormal(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners) {
    glm::dvec3 sum(0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += areaVector(positions[corners[0]], positions[corners[i]], positions[corners[i + 1]]);
    return sum;
}

/// No triangle of the fan is turned over, or has no area as with corners in the middle of an edge.
bool fanIsSound(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners,
                const glm::dvec3& normal) {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const auto area = areaVector(positions[corners[0]], positions[corners[i]], positions[corners[i + 1]]);
        if (!(glm::dot(area, normal) > 0)) return false;
    }
    return true;
}

/// Clipping takes up to the cube of this many steps.
constexpr std::size_t kMaxEarCorners = 500;

/// True if the triangle a, b, c turns the polygon's way and no other corner lies in it or on its border.
bool isEar(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners, std::uint32_t a,
           std::uint32_t b, std::uint32_t c, const glm::dvec3& normal) {
    const auto side = [&](const glm::vec3& p, const glm::vec3& q, const glm::vec3& r) {
        return glm::dot(areaVector(p, q, r), normal);
    };
    const glm::vec3 &pa = positions[a], &pb = positions[b], &pc = positions[c];
    if (side(pa, pb, pc) <= 0) return false;
    for (const std::uint32_t v : corners) {
        const glm::vec3& p = positions[v];
        if (p == pa || p == pb || p == pc) continue;
        if (side(pa, pb, p) >= 0 && side(pb, pc, p) >= 0 && side(pc, pa, p) >= 0) return false;
    }
    return true;
}

}  // namespace

std::uint64_t triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners,
                          std::vector<glm::uvec3>& triangles) {
    std::uint64_t steps = 0;
    std::vector<std::uint32_t> rest;
    if (corners.size() > 3 && corners.size() <= kMaxEarCorners) {
        const glm::dvec3 normal = polygonNormal(positions, corners);
        if (!fanIsSound(positions, corners, normal)) {
            rest.assign(corners.begin(), corners.end());
            for (bool clipped = true; clipped && rest.size() > 3;) {
                clipped = false;
                for (std::size_t i = 0; i < rest.size() && !clipped; ++i) {
                    const std::uint32_t a = rest[(i + rest.size() - 1) % rest.size()], b = rest[i],
                                        c = rest[(i + 1) % rest.size()];
                    steps += rest.size();
                    if (!isEar(positions, rest, a, b, c, normal)) continue;
                    triangles.emplace_back(a, b, c);
                    rest.erase(rest.begin() + std::ptrdiff_t(i));
                    clipped = true;
                }
            }
            corners = rest;
        }
    }
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        triangles.emplace_back(corners[0], corners[i], corners[i + 1]);
    return steps;
}

Mesh weld(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles, Dropped& dropped) {
    const std::vector<std::uint32_t> first = firstEqual(positions);
    std::vector<std::uint32_t> welded(positions.size(), kNone);
    Mesh mesh;
    mesh.triangles.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
        glm::uvec3 corners(first[t.x], first[t.y], first[t.z]);
        if (repeatsVertex(corners)) {
            ++dropped.repeatedVertex;
            continue;
        }
        if (areaVector(positions[corners.x], positions[corners.y], positions[corners.z]) == glm::dvec3(0)) {
            dropped.flat.push_back({positions[corners.x], positions[corners.y], positions[corners.z]});
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& vertex = welded[corners[k]];
            if (vertex == kNone) {
                vertex = std::uint32_t(mesh.positions.size());
                mesh.positions.push_back(positions[corners[k]] + 0.0f);
            }
            corners[k] = vertex;
        }
        mesh.triangles.push_back(corners);
    }
    return mesh;
}

Mesh joinCasters(const Scene& scene, bool withFlat) {
    std::vector<glm::vec3> positions;
    Mesh mesh;
    for (const Object& object : scene.objects) {
        if (!object.casts) continue;
        const auto base = glm::uvec3(std::uint32_t(positions.size()));
        positions.insert(positions.end(), object.mesh.positions.begin(), object.mesh.positions.end());
        for (const glm::uvec3& t : object.mesh.triangles) mesh.triangles.push_back(t + base);
    }
    if (withFlat)
        for (const auto& corners : scene.dropped.flat) {
            const auto base = std::uint32_t(positions.size());
            positions.insert(positions.end(), corners.begin(), corners.end());
            mesh.triangles.emplace_back(base, base + 1, base + 2);
        }

    const std::vector<std::uint32_t> first = firstEqual(positions);
    std::vector<std::uint32_t> welded(positions.size());
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
        if (first[v] == v) {
            welded[v] = std::uint32_t(mesh.positions.size());
            mesh.positions.push_back(positions[v] + 0.0f);
        } else {
            welded[v] = welded[first[v]];
        }
    }
    for (glm::uvec3& t : mesh.triangles) t = {welded[t.x], welded[t.y], welded[t.z]};
    // A scene file may have moved a triangle without area so that it repeats a vertex now.
    std::erase_if(mesh.triangles, repeatsVertex);
    return mesh;
}

std::string describe(const Dropped& dropped) {
    const std::size_t sum = dropped.repeatedVertex + dropped.flat.size();
    if (sum == 0) return {};
    return fmt::format("{} degenerate triangle{} dropped ({} repeat a vertex, {} have no area)", sum,
                       sum == 1 ? "" : "s", dropped.repeatedVertex, dropped.flat.size());
}

}  // namespace gnomon
