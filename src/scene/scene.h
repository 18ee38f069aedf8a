#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/hard_case.h"

namespace gnomon {

/// A triangle mesh in world space. Vertices that coincide exactly are one vertex.
struct Mesh {
    std::vector<glm::vec3> positions{};
    std::vector<glm::uvec3> triangles{};  ///< counter-clockwise seen from the front
};

/// A mesh with what shadows and shading need to know of it.
struct Object {
    std::string name{};
    Mesh mesh{};
    glm::vec3 colour{0.8f};  ///< diffuse reflectance, 0..1
    bool casts = true;       ///< its triangles are casters; every object is a receiver
    bool twoSided = false;   ///< both sides of its triangles cast; otherwise only those that face the light
};

/// A light in homogeneous world coordinates: (x, y, z, 1) is a point light, (x, y, z, 0) a directional light
/// with the unit vector *towards* the light.
struct Light {
    glm::vec4 position{0, 10, 0, 1};
    glm::vec3 colour{1.0f};
};

/// A pinhole camera. The projection is infinite: there is no far plane.
struct Camera {
    glm::vec3 eye{0, 0, 5};
    glm::vec3 target{0};
    glm::vec3 up{0, 1, 0};
    float fovDegrees = 45;   ///< vertical
    float nearPlane = 0.1f;  ///< distance of the near plane from the eye
};

/// Triangles that a loader left out of casting objects, since nothing of them can be drawn.
struct Dropped {
    std::size_t repeatedVertex = 0;  ///< two corners are the same vertex
    /// Corners, world space, of those without area: three vertices exactly on one line. They can close a mesh
    /// that is open without them.
    std::vector<std::array<glm::vec3, 3>> flat{};
};

/// All that a frame shows. Value type; owns its meshes.
struct Scene {
    std::string id{};  ///< file stem (of scenes/hard/x.toml "hard/x"), or the path as given for a mesh file
    std::string title{};            ///< one line for lists
    std::vector<Object> objects{};  ///< may be none: all is background then
    std::vector<Light> lights{};    ///< may be none: the ambient part is all that shows then
    bool chosenLight = false;       ///< the file has no light; the one above is the loader's
    std::vector<Camera> frames{};   ///< the camera path, at least one
    float ambient = 0.2f;           ///< share of the reflectance that shows without any light, 0..1
    glm::vec3 background{0.5f, 0.6f, 0.7f};
    /// What the loader dropped or chose, one line each: "12 degenerate triangles dropped".
    std::vector<std::string> notes{};
    Dropped dropped{};
    std::optional<HardCase> hard{};  ///< what a file of scenes/hard promises
};

/// Number of triangles of all objects.
std::size_t triangleCount(const Scene& scene);

}  // namespace gnomon
