#pragma once

#include <filesystem>

#include "scene/limits.h"
#include "scene/scene.h"

namespace gnomon {

/// Reads a scene file. Unknown keys, wrong types and values out of range are errors.
///
///     title = "..."  ambient = 0.2  background = [r, g, b]
///     [light] or [[lights]]  position = [x, y, z] or direction = [x, y, z] (towards the light),
///                colour = [r, g, b]; lights = []: none
///     [camera]   eye, target, up = [x, y, z], fov (degrees, vertical), near
///                orbit = { frames = 60, axis = [0, 1, 0] }: a full turn of the eye about the axis through
///                the target
///     [[objects]]  name, at = [x, y, z], rotate = [axis x, y, z, degrees], scale, colour, casts, two_sided,
///                repeat = { count = 3, step = [x, y, z] }: so many times, each moved on by a step
///                shape =
///         "box"        size = [x, y, z]
///         "rectangle"  size = [x, z]: in the plane y = 0, facing up
///         "cylinder"   radius, height, segments: about the axis y
///         "sphere"     radius, segments, rings
///         "torus"      radius, tube, segments, sides
///         "knot"       p, q, radius, minor, tube, segments, sides
///         "triangles"  vertices = [[x, y, z], ...], triangles = [[0, 1, 2], ...]: counter-clockwise seen
///                      from the front
///         "mesh"       file, relative to the scene file
///                objects = []: none
///     [hard]     family, what, source: of a hard case (hard_case.h)
///                fails = [{ method, cause, ... }, ...], exact = [{ method, ... }, ...]; each may add
///                profile, fidelity, dither, frame, size = [w, h], and the axes' flags with _ for -
///
/// An object is scaled, rotated, then moved.
/// @throws SceneError "file:line: what"
Scene loadSceneFile(const std::filesystem::path& file, const SceneLimits& limits = {});

}  // namespace gnomon
