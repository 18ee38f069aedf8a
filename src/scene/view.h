#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace gnomon {

/// The camera of one frame as numbers that everybody shares: the renderer's matrices and the tracer's rays
/// come from the same double-precision basis. Eye space: x right, y up, -z forward; y up in the image.
struct View {
    glm::dvec3 eye{};
    glm::dvec3 right{}, up{}, forward{};  ///< orthonormal, world space
    double tanHalfX = 1, tanHalfY = 1;    ///< half extents of the image plane at distance 1
    double nearPlane = 0.1;
    int width = 0, height = 0;  ///< pixels
};

/// @pre eye != target, up not parallel to the view direction (then another up is taken)
View viewOf(const Camera& camera, int width, int height);

/// Eye from world, double precision.
glm::dmat4 eyeFromWorld(const View& view);

/// Clip from eye: the infinite projection (Everitt and Kilgard 2002, arXiv:cs/0301002, section 2); a point at
/// infinity (w = 0) has depth 1.
glm::dmat4 clipFromEye(const View& view);

/// World-space direction of the ray through the window position (x, y) in pixels, y up, pixel centres at .5;
/// not of unit length: its component along forward is 1, so its parameter is the distance from the eye along
/// forward.
glm::dvec3 rayDirection(const View& view, double x, double y);

/// Depth in the window, 0 at the near plane and 1 at infinity, of a point at distance @p z along forward.
double windowDepth(const View& view, double z);

/// Inverse of windowDepth; infinite for depth >= 1.
double distanceAtDepth(const View& view, double depth);

}  // namespace gnomon
