#pragma once

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "scene/load.h"
#include "scene/primitives.h"
#include "scenes.h"

// Small scenes that are hard for shadow volumes, made here.

namespace gnomon {

inline Mesh movedTo(Mesh mesh, const glm::vec3& at) {
    for (glm::vec3& p : mesh.positions) p += at;
    return mesh;
}

inline Object receiver(double side) {
    return {.name = "floor", .mesh = rectangle({side, side}), .casts = false};
}

/// Looks out from under three lids, each in the shadow of the one above.
inline Scene eyeInsideVolumes() {
    Scene scene;
    scene.objects = {receiver(20),
                     {.name = "post", .mesh = movedTo(box({0.7, 1.3, 0.6}), {0.37f, 0.71f, -3.93f})}};
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 at(0.13f + 0.11f * float(i), 3.07f + 0.71f * float(i), 0.11f);
        scene.objects.push_back({.name = "lid", .mesh = movedTo(box({2.3, 0.4, 2.1}), at)});
    }
    scene.lights = {{.position = {0.47f, 9.31f, 0.73f, 1}}};
    scene.frames = {{.eye = {0.17f, 1.61f, 0.29f}, .target = {0.31f, 0.47f, -4.13f}, .fovDegrees = 67}};
    return scene;
}

/// The near plane passes through a box and its volume; the eye stands outside of both.
inline Scene nearPlaneThroughCaster() {
    Scene scene;
    scene.objects = {receiver(20),
                     {.name = "cut", .mesh = movedTo(box({0.9, 0.8, 1.1}), {-0.43f, 1.57f, 2.11f})},
                     {.name = "whole", .mesh = movedTo(box({0.6, 0.9, 0.7}), {0.71f, 0.83f, -0.37f})}};
    scene.lights = {{.position = {2.71f, 6.13f, 3.37f, 1}}};
    scene.frames = {
        {.eye = {0.23f, 1.93f, 3.17f}, .target = {0.07f, 0.91f, 0.13f}, .fovDegrees = 60, .nearPlane = 1}};
    return scene;
}

/// Seven pages on one edge, a box without a lid, a bent sheet that casts from both sides, a strip with a half
/// twist.
inline Scene openAndNonManifold() {
    Scene scene;
    Mesh book{.positions = {{-1.31f, 0.41f, 0.17f}, {-1.27f, 2.03f, 0.11f}}, .triangles = {}};
    for (int i = 0; i < 7; ++i) {
        const double turn = 2 * std::numbers::pi * (i + 0.3) / 7;
        book.positions.push_back(
            {-1.29f + 0.9f * float(std::cos(turn)), 1.21f, 0.13f + 0.9f * float(std::sin(turn))});
        book.triangles.push_back(i % 2 ? glm::uvec3(0, 1, 2 + i) : glm::uvec3(1, 0, 2 + i));
    }
    Mesh open = movedTo(box({0.9, 0.9, 0.9}), {1.37f, 0.83f, 0.71f});
    open.triangles.erase(open.triangles.begin(), open.triangles.begin() + 2);
    const Mesh bent{.positions = {{-0.41f, 2.31f, -1.13f},
                                  {0.53f, 2.37f, -1.21f},
                                  {0.07f, 1.51f, -0.67f},
                                  {0.11f, 1.43f, -1.73f}},
                    .triangles = {{0, 1, 2}, {0, 1, 3}}};
    Mesh twisted;
    constexpr int kPieces = 12;
    for (int i = 0; i < kPieces; ++i) {
        const double turn = 2 * std::numbers::pi * i / kPieces;
        for (const double side : {-0.25, 0.25}) {
            const double r = 0.8 + side * std::cos(turn / 2);
            twisted.positions.push_back({float(r * std::cos(turn)) + 0.31f,
                                         float(side * std::sin(turn / 2)) + 2.91f,
                                         float(r * std::sin(turn)) + 0.57f});
        }
        const auto a = std::uint32_t(2 * i);
        // The last piece joins the ends with a half twist.
        const std::uint32_t c = i + 1 < kPieces ? a + 2 : 1, d = i + 1 < kPieces ? a + 3 : 0;
        twisted.triangles.push_back({a, a + 1, c});
        twisted.triangles.push_back({a + 1, d, c});
    }
    scene.objects = {receiver(20),
                     {.name = "book", .mesh = book, .twoSided = true},
                     {.name = "open", .mesh = open},
                     {.name = "bent", .mesh = bent, .twoSided = true},
                     {.name = "twisted", .mesh = twisted, .twoSided = true}};
    scene.lights = {{.position = {0.91f, 8.17f, 2.63f, 1}}};
    scene.frames = {{.eye = {2.17f, 4.71f, 6.37f}, .target = {0.07f, 0.93f, 0.11f}, .fovDegrees = 47}};
    return scene;
}

/// Six spheres, each within the next, and the outermost open to the eye through nothing: seen from outside.
inline Scene nested() {
    Scene scene;
    scene.objects = {receiver(20)};
    for (int i = 0; i < 6; ++i)
        scene.objects.push_back(
            {.name = "shell", .mesh = movedTo(sphere(0.27 + 0.19 * i, 9, 5), {0.11f, 2.07f, -0.13f})});
    for (int i = 0; i < 5; ++i)
        scene.objects.push_back({.name = "lid",
                                 .mesh = movedTo(box({1.7, 0.1, 1.5}), {1.43f + 0.07f * float(i),
                                                                        1.13f + 0.41f * float(i), 0.9f})});
    scene.lights = {{.position = {0.67f, 9.43f, 1.39f, 1}}};
    scene.frames = {{.eye = {3.17f, 3.23f, 6.11f}, .target = {0.31f, 1.01f, 0.07f}, .fovDegrees = 49}};
    return scene;
}

/// The knot's volume nests in itself, and the eye is inside of it; the sun is far.
inline Scene eyeInsideKnot() {
    Scene scene = shippedScene("knot");
    scene.lights = {{.position = glm::vec4(glm::normalize(glm::vec3(0.31f, 0.87f, 0.23f)), 0)}};
    scene.frames = {{.eye = {-0.61f, 0.53f, -0.37f}, .target = {0.37f, 0.11f, 2.13f}, .fovDegrees = 71}};
    return scene;
}

/// Light on the lines of a box's edges, in planes of its faces; eye level with others.
inline Scene edgeOn() {
    Scene scene;
    scene.objects = {receiver(16),
                     {.name = "at-light", .mesh = movedTo(box({1, 1, 1}), {0.5f, 1, 0.5f})},
                     {.name = "at-eye", .mesh = movedTo(box({1, 0.5, 1}), {-1.5f, 0.75f, 0})}};
    scene.lights = {{.position = {1, 6, 1, 1}}};
    scene.frames = {{.eye = {1.5f, 1, 5}, .target = {0, 0.5f, 0}, .fovDegrees = 53}};
    return scene;
}

/// By id.
inline const std::map<std::string, Scene (*)()>& nastyScenes() {
    static const std::map<std::string, Scene (*)()> scenes = {
        {"eye-inside-volumes", eyeInsideVolumes},
        {"near-plane-through-caster", nearPlaneThroughCaster},
        {"open-and-non-manifold", openAndNonManifold},
        {"nested", nested},
        {"eye-inside-knot", eyeInsideKnot},
        {"edge-on", edgeOn}};
    return scenes;
}

/// The scene files of the hard-case suite, sorted; none where the folder is missing.
inline std::vector<std::filesystem::path> hardCases() {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path folder = kSource / "scenes" / "hard";
    if (!std::filesystem::is_directory(folder)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// Ids of the scenes that must stay stable: those that come with gnomon, the hard ones, and the ones above.
inline std::vector<std::string> stableSceneIds() {
    std::vector<std::string> ids = {"boxes", "knot", "roettger"};
    for (const auto& [id, make] : nastyScenes()) ids.push_back(id);
    for (const std::filesystem::path& file : hardCases()) ids.push_back("hard/" + file.stem().string());
    return ids;
}

/// The same, some at a time: each test is a program's start, which takes longer than a scene.
inline std::vector<std::vector<std::string>> stableSceneGroups() {
    constexpr std::size_t kMost = 8;
    std::vector<std::vector<std::string>> groups;
    for (const std::string& id : stableSceneIds()) {
        if (groups.empty() || groups.back().size() == kMost) groups.emplace_back();
        groups.back().push_back(id);
    }
    return groups;
}

/// "boxes_to_nested"
inline std::string testNameOf(const std::vector<std::string>& ids) {
    std::string name = ids.front() + "_to_" + ids.back();
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

/// One of them, with its first frame alone.
inline Scene stableScene(const std::string& id) {
    const auto nasty = nastyScenes().find(id);
    Scene scene = nasty == nastyScenes().end() ? shippedScene(id) : nasty->second();
    scene.id = id;
    scene.frames.resize(1);
    return scene;
}

}  // namespace gnomon
