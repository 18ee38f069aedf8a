#include "scene/primitives.h"

#include <cmath>
#include <numbers>

namespace gnomon {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

void addQuad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
}

/// Triangles of a grid of rows x columns vertices that is closed both ways. Front: columns x rows.
void addClosedGrid(Mesh& mesh, int rows, int columns) {
    const auto vertex = [&](int r, int c) { return std::uint32_t(r % rows * columns + c % columns); };
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
            addQuad(mesh, vertex(r, c), vertex(r, c + 1), vertex(r + 1, c + 1), vertex(r + 1, c));
}

}  // namespace

Mesh box(const glm::dvec3& size) {
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        mesh.positions.emplace_back(sign * size / 2.0);
    }
    addQuad(mesh, 0, 4, 6, 2);  // -x
    addQuad(mesh, 1, 3, 7, 5);  // +x
    addQuad(mesh, 0, 1, 5, 4);  // -y
    addQuad(mesh, 2, 6, 7, 3);  // +y
    addQuad(mesh, 0, 2, 3, 1);  // -z
    addQuad(mesh, 4, 5, 7, 6);  // +z
    return mesh;
}

Mesh rectangle(const glm::dvec2& size) {
    Mesh mesh;
    const glm::dvec2 h = size / 2.0;
    mesh.positions = {glm::dvec3(-h.x, 0, -h.y), glm::dvec3(-h.x, 0, h.y), glm::dvec3(h.x, 0, h.y),
                      glm::dvec3(h.x, 0, -h.y)};
    addQuad(mesh, 0, 1, 2, 3);
    return mesh;
}

Mesh cylinder(double radius, double height, int segments) {
    Mesh mesh;
    for (int s = 0; s < segments; ++s) {
        const double angle = kTurn * s / segments;
        const double x = radius * std::cos(angle), z = -radius * std::sin(angle);
        mesh.positions.emplace_back(glm::dvec3(x, -height / 2, z));
        mesh.positions.emplace_back(glm::dvec3(x, height / 2, z));
    }
    const std::uint32_t bottom = std::uint32_t(2 * segments), top = bottom + 1;
    mesh.positions.emplace_back(glm::dvec3(0, -height / 2, 0));
    mesh.positions.emplace_back(glm::dvec3(0, height / 2, 0));
    for (int s = 0; s < segments; ++s) {
        const std::uint32_t a = std::uint32_t(2 * s), b = std::uint32_t(2 * ((s + 1) % segments));
        addQuad(mesh, a, b, b + 1, a + 1);
        mesh.triangles.emplace_back(bottom, b, a);
        mesh.triangles.emplace_back(top, a + 1, b + 1);
    }
    return mesh;
}

Mesh sphere(double radius, int segments, int rings) {
    Mesh mesh;
    for (int r = 1; r < rings; ++r) {
        const double polar = kTurn / 2 * r / rings;
        for (int s = 0; s < segments; ++s) {
            const double angle = kTurn * s / segments;
            mesh.positions.emplace_back(radius * glm::dvec3(std::sin(polar) * std::cos(angle),
                                                            std::cos(polar),
                                                            -std::sin(polar) * std::sin(angle)));
        }
    }
    const std::uint32_t north = std::uint32_t(mesh.positions.size()), south = north + 1;
    mesh.positions.emplace_back(glm::dvec3(0, radius, 0));
    mesh.positions.emplace_back(glm::dvec3(0, -radius, 0));
    const auto vertex = [&](int r, int s) { return std::uint32_t((r - 1) * segments + s % segments); };
    for (int s = 0; s < segments; ++s) {
        mesh.triangles.emplace_back(north, vertex(1, s), vertex(1, s + 1));
        for (int r = 1; r + 1 < rings; ++r)
            addQuad(mesh, vertex(r, s), vertex(r + 1, s), vertex(r + 1, s + 1), vertex(r, s + 1));
        mesh.triangles.emplace_back(south, vertex(rings - 1, s + 1), vertex(rings - 1, s));
    }
    return mesh;
}

Mesh torus(double radius, double tube, int segments, int sides) {
    Mesh mesh;
    for (int s = 0; s < segments; ++s) {
        const double angle = kTurn * s / segments;
        for (int k = 0; k < sides; ++k) {
            const double around = kTurn * k / sides;
            const double r = radius + tube * std::cos(around);
            mesh.positions.emplace_back(
                glm::dvec3(r * std::cos(angle), tube * std::sin(around), r * std::sin(angle)));
        }
    }
    addClosedGrid(mesh, segments, sides);
    return mesh;
}

Mesh torusKnot(const KnotShape& shape) {
    Mesh mesh;
    for (int s = 0; s < shape.segments; ++s) {
        const double t = kTurn * s / shape.segments;
        const double around = shape.p * t, along = shape.q * t;
        const glm::dvec3 outwards(std::cos(around), 0, std::sin(around));
        const glm::dvec3 sideways(-std::sin(around), 0, std::cos(around));
        const glm::dvec3 up(0, 1, 0);
        const double r = shape.radius + shape.minor * std::cos(along);
        const glm::dvec3 centre = r * outwards + shape.minor * std::sin(along) * up;

        // The torus' own normal is at right angles to the knot and comes back to itself: a frame that closes.
        const glm::dvec3 normal = std::cos(along) * outwards + std::sin(along) * up;
        const glm::dvec3 tangent =
            glm::normalize(shape.q * shape.minor * (std::cos(along) * up - std::sin(along) * outwards) +
                           shape.p * r * sideways);
        const glm::dvec3 binormal = glm::cross(tangent, normal);
        for (int k = 0; k < shape.sides; ++k) {
            const double turn = kTurn * k / shape.sides;
            mesh.positions.emplace_back(centre +
                                        shape.tube * (std::cos(turn) * normal + std::sin(turn) * binormal));
        }
    }
    addClosedGrid(mesh, shape.segments, shape.sides);
    return mesh;
}

}  // namespace gnomon
