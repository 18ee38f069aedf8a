#include "volume/caster_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "volume/orient.h"

namespace gnomon {
namespace {

/// In m_x of a triangle without area, which no light sees: not a value that a scaled plane can have.
constexpr float kNoArea = 2;

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

/// Words that a kernel takes at once, so that what it finds stays in the first cache.
constexpr std::size_t kWordsAtOnce = 64;

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

CasterMesh::CasterMesh(std::span<const glm::vec3> positions, std::vector<glm::uvec3> triangles)
    : m_positions(positions), m_triangles(std::move(triangles)), m_edges(adjacency(m_triangles)) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    glm::dvec3 low(kInfinity), high(-kInfinity);
    for (const glm::uvec3& t : m_triangles) {
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, glm::dvec3(positions[t[k]]));
            high = glm::max(high, glm::dvec3(positions[t[k]]));
        }
    }
    if (!m_triangles.empty()) {
        m_centre = (low + high) / 2.0;
        m_radius = largest(high - m_centre);
    }
    for (auto* plane : {&m_x, &m_y, &m_z, &m_d}) plane->assign(64 * words(), 0);
    for (std::size_t t = 0; t < m_triangles.size(); ++t) setPlane(t);
}

std::size_t CasterMesh::bytes() const {
    return m_triangles.size() * sizeof(m_triangles[0]) + 4 * m_x.size() * sizeof(float) + m_edges.bytes();
}

/// The sign of orientation() in an axis's direction is that of the normal there: all 0 without area.
bool CasterMesh::hasArea(const glm::uvec3& t) const {
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec4 towards(0);
        towards[axis] = 1;
        if (orientation(m_positions[t.x], m_positions[t.y], m_positions[t.z], towards) != 0) return true;
    }
    return false;
}

void CasterMesh::setPlane(std::size_t triangle) {
    const glm::uvec3 t = m_triangles[triangle];
    const glm::dvec3 a = m_positions[t.x], u = glm::dvec3(m_positions[t.y]) - a,
                     v = glm::dvec3(m_positions[t.z]) - a;
    const glm::dvec3 normal = glm::cross(u, v);
    const double length = largest(normal);
    // A component of the normal is wrong by at most 5 roundings of the products of u and v: 2^-50 |u| |v|.
    // Scaled to 1 that may be 2^-26 at most, or a sliver's plane says nothing.
    if (!(length > 0x1p-24 * largest(u) * largest(v))) {
        m_x[triangle] = hasArea(t) ? 0 : kNoArea;
        m_y[triangle] = m_z[triangle] = m_d[triangle] = kNotANumber;
        return;
    }
    const glm::dvec3 scaled = normal / length;
    m_x[triangle] = static_cast<float>(scaled.x);
    m_y[triangle] = static_cast<float>(scaled.y);
    m_z[triangle] = static_cast<float>(scaled.z);
    m_d[triangle] = static_cast<float>(-glm::dot(scaled, a - m_centre));
}

/// How far from 0 a height must be to have a certain sign. With P the largest coordinate of the light about
/// the centre, R the radius, e = 2^-24, in units of e:
///   the plane, rounded, and the sliver's 2^-26: 1.25 each, so 3.75 P, and 3 R + 0.75 R for d
///   the light, rounded: 3 P
///   three products, 3 P; three sums of at most 3 P + 3 R each, 9 P + 9 R; fused, fewer
/// That is below 19 P + 13 R; 32 leaves room for second-order terms. Where denormal numbers count as 0 a
/// result may lose 2^-126, and a coefficient as much times P.
float CasterMesh::boundFor(const glm::dvec3& light, double w) const {
    const double size = largest(light) + w * m_radius;
    const double bound = 0x1p-19 * size + 16 * 0x1p-126 * (1 + size);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    // From here on a sum might overflow: then nothing is certain.
    if (!(size < 0x1p120)) return kInfinity;
    return std::nextafter(static_cast<float>(bound), kInfinity);
}

void CasterMesh::face(const glm::vec4& light, Facing& facing, const Kernels& with) const {
    const glm::dvec3 towards = glm::dvec3(light) - double(light.w) * m_centre;
    facing.lit.resize(words());
    facing.away.resize(words());
    with.face({m_x.data(), m_y.data(), m_z.data(), m_d.data()}, glm::vec4(glm::vec3(towards), light.w),
              boundFor(towards, light.w), words(), facing.lit.data(), facing.away.data());
    judgeTheRest(light, facing);
}

/// Those that the filter left: neither lit nor away.
void CasterMesh::judgeTheRest(const glm::vec4& light, Facing& facing) const {
    for (std::size_t word = 0; word < words(); ++word) {
        std::uint64_t rest = ~(facing.lit[word] | facing.away[word]);
        if (word + 1 == words()) rest &= (std::uint64_t(1) << (m_triangles.size() % 64)) - 1;
        for (; rest != 0; rest &= rest - 1) {
            const std::size_t triangle = 64 * word + std::countr_zero(rest);
            if (m_x[triangle] == kNoArea) continue;
            const glm::uvec3 t = m_triangles[triangle];
            const int side = orientation(m_positions[t.x], m_positions[t.y], m_positions[t.z], light);
            const std::uint64_t bit = rest & -rest;
            if (side > 0) facing.lit[word] |= bit;
            if (side < 0) facing.away[word] |= bit;
        }
    }
}

void CasterMesh::outline(std::span<const std::uint64_t> caps, std::vector<std::uint32_t>& walks,
                         const Kernels& with) const {
    std::array<std::uint32_t, 192 * kWordsAtOnce> found;
    for (std::size_t word = 0; word < words(); word += kWordsAtOnce) {
        const std::size_t end = std::min(words(), word + kWordsAtOnce);
        const std::size_t count = with.outline(m_edges.across.data(), caps.data(), word, end, found.data());
        walks.insert(walks.end(), found.begin(), found.begin() + std::ptrdiff_t(count));
    }
}

void CasterMesh::list(std::span<const std::uint64_t> set, std::vector<std::uint32_t>& triangles,
                      const Kernels& with) const {
    std::array<std::uint32_t, 64 * kWordsAtOnce> found;
    for (std::size_t word = 0; word < words(); word += kWordsAtOnce) {
        const std::size_t end = std::min(words(), word + kWordsAtOnce);
        const std::size_t count = with.list(set.data(), word, end, found.data());
        triangles.insert(triangles.end(), found.begin(), found.begin() + std::ptrdiff_t(count));
    }
}

}  // namespace gnomon
