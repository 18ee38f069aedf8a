#pragma once

#include "scene/scene.h"

namespace gnomon {

// Simple shapes about the origin, y up, triangles counter-clockwise seen from outside. All but the rectangle
// are closed and share their vertices.

Mesh box(const glm::dvec3& size);

/// In the plane y = 0, facing up, @p size along x and z.
Mesh rectangle(const glm::dvec2& size);

/// Axis y. @pre segments >= 3
Mesh cylinder(double radius, double height, int segments);

/// @pre segments >= 3 (around the axis y), rings >= 2 (from pole to pole)
Mesh sphere(double radius, int segments, int rings);

/// Axis y. @p radius to the middle of the tube. @pre segments, sides >= 3, tube < radius
Mesh torus(double radius, double tube, int segments, int sides);

/// What torusKnot() needs.
struct KnotShape {
    int p = 2, q = 3;    ///< turns about the axis y, and about the torus' own circle: 2, 3 is the trefoil
    double radius = 1;   ///< of the torus on which the knot lies, to the middle of its tube
    double minor = 0.4;  ///< of that torus' tube
    double tube = 0.15;  ///< of the knot's own tube
    int segments = 128;  ///< along the knot
    int sides = 12;      ///< around its tube
};

/// A tube along a torus knot. @pre p and q without a common divisor (else the turns coincide), segments and
/// sides >= 3
Mesh torusKnot(const KnotShape& shape);

}  // namespace gnomon
