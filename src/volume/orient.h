#pragma once

#include <glm/glm.hpp>

namespace gnomon {

/// Exact sign of the side of the plane (a, b, c) on which the homogeneous point @p p lies (its w is 0 or 1):
/// +1 where a, b, c appear counter-clockwise from p, -1 behind, 0 in the plane. Floating-point filter first
/// (Shewchuk 1997, Adaptive precision floating-point arithmetic, section 4.3, bound A), exact expansion where
/// it can't decide.
int orientation(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec4& p);

/// The same for a point in double precision.
/// @pre products of three coordinates neither overflow nor, unless 0, come near the smallest double
int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p);

/// The same for a homogeneous point (its w is 0 or 1) in double precision.
int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& p);

}  // namespace gnomon
