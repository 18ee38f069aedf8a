#include "scene/load.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/framing.h"
#include "scene/mesh_file.h"
#include "scene/scene_file.h"
#include "scene/text.h"

namespace gnomon {
namespace {

template <typename Vector>
void requireCoordinates(const char* argument, const Vector& value) {
    for (int k = 0; k < Vector::length(); ++k)
        if (const std::string fault = coordinateFault(double(value[k])); !fault.empty())
            throw SceneError(fmt::format("{}: {}", argument, fault));
}

constexpr float kLeastNearPlane = 1e-12f;  ///< depth of anything that is seen is 1 to the last bit below it

void checkOverrides(const SceneOverrides& overrides) {
    if (overrides.light) {
        requireCoordinates("light", *overrides.light);
        if (overrides.light->w != 0 && overrides.light->w != 1)
            throw SceneError(fmt::format("light: w is {}, not 0 or 1", overrides.light->w));
        if (overrides.light->w == 0 && glm::vec3(*overrides.light) == glm::vec3(0))
            throw SceneError("light: the direction is zero");
    }
    if (overrides.eye) requireCoordinates("eye", *overrides.eye);
    if (overrides.target) requireCoordinates("target", *overrides.target);
    if (overrides.fovDegrees && !(*overrides.fovDegrees >= 0.01f && *overrides.fovDegrees <= 179))
        throw SceneError(fmt::format("fov: {} is not between 0.01 and 179 degrees", *overrides.fovDegrees));
    if (overrides.nearPlane && !(*overrides.nearPlane > 0 && std::isfinite(*overrides.nearPlane)))
        throw SceneError(fmt::format("near: {} is not a positive distance", *overrides.nearPlane));
    if (overrides.nearPlane && *overrides.nearPlane < kLeastNearPlane)
        throw SceneError(fmt::format("near: {} is less than {}", *overrides.nearPlane, kLeastNearPlane));
}

/// What the cameras of a mesh file leave open: a near plane that a depth buffer can live with.
void adoptCameras(const MeshFile& mesh, const Bounds& bounds, Scene& scene) {
    const float least = float(bounds.radius / 1000);
    std::size_t changed = 0;
    for (Camera camera : mesh.cameras) {
        if (!(camera.nearPlane >= least && std::isfinite(camera.nearPlane))) {
            camera.nearPlane = least;
            ++changed;
        }
        scene.frames.push_back(camera);
    }
    if (changed > 0)
        scene.notes.push_back(
            fmt::format("near plane of {} camera{} moved out to {:.4g}, a thousandth of the radius", changed,
                        changed == 1 ? "" : "s", least));
}

constexpr double kLeastRadius = 1e-18;  ///< float has room for the square

Scene sceneOfMesh(const std::filesystem::path& file, const SceneOverrides& overrides,
                  const SceneLimits& limits) {
    MeshFile mesh = loadMeshFile(file, limits);
    Scene scene;
    scene.id = file.string();
    scene.title = file.filename().string();
    scene.objects = std::move(mesh.objects);
    scene.notes = std::move(mesh.notes);
    scene.dropped = std::move(mesh.dropped);
    const Bounds bounds = boundsOf(scene.objects);
    if (bounds.radius < kLeastRadius)
        fail(file, fmt::format("all of it lies within {:g} of one point (at least {:g})", bounds.radius,
                               kLeastRadius));

    adoptCameras(mesh, bounds, scene);
    if (scene.frames.empty())
        scene.frames.push_back(framingCamera(bounds, overrides.fovDegrees.value_or(45)));
    scene.lights = std::move(mesh.lights);
    scene.chosenLight = scene.lights.empty();
    if (scene.chosenLight) scene.lights.push_back(framingLight(bounds));
    return scene;
}

/// @param bounds of the scene without the ground
void applyOverrides(const SceneOverrides& overrides, const Bounds& bounds, Scene& scene) {
    if (overrides.light) {
        Light light{.position = *overrides.light};
        if (light.position.w == 0)
            light.position = glm::vec4(glm::vec3(glm::normalize(glm::dvec3(light.position))), 0);
        scene.lights = {light};
        scene.chosenLight = false;
    }
    if (overrides.eye || overrides.target) {
        Camera camera = scene.frames.front();
        camera.up = Camera{}.up;  // y is up, however the file's camera was rolled
        if (overrides.eye && !overrides.target) camera.target = glm::vec3(bounds.centre);
        if (overrides.eye) camera.eye = *overrides.eye;
        if (overrides.target) camera.target = *overrides.target;
        if (camera.eye == camera.target) throw SceneError("eye: the same point as the target");
        if (bounds.radius > 0) camera.nearPlane = nearPlaneFor(scene.objects, bounds, camera.eye);
        scene.frames = {camera};
    }
    for (Camera& camera : scene.frames) {
        if (overrides.fovDegrees) camera.fovDegrees = *overrides.fovDegrees;
        if (overrides.nearPlane) camera.nearPlane = *overrides.nearPlane;
    }
}

}  // namespace

Scene loadScene(const std::filesystem::path& file, const SceneOverrides& overrides,
                const SceneLimits& limits) {
    checkOverrides(overrides);
    const bool isToml = file.extension() == ".toml";
    if (!isToml && !isMeshFile(file)) {
        readWhole(file, limits.meshBytes);  // a folder, or nothing at all, is the better complaint
        fail(file, "unknown kind of file, known: .toml .obj .ply .stl .gltf .glb");
    }
    Scene scene = isToml ? loadSceneFile(file, limits) : sceneOfMesh(file, overrides, limits);
    const Bounds bounds = boundsOf(scene.objects);
    const bool isGltf = file.extension() == ".gltf" || file.extension() == ".glb";
    if (overrides.ground.value_or(!isToml && !isGltf)) {
        if (scene.objects.empty()) throw SceneError("ground: nothing is there to put a floor below");
        scene.objects.push_back(groundBelow(bounds));
    }
    applyOverrides(overrides, bounds, scene);
    return scene;
}

std::filesystem::path findScene(const std::string& idOrFile, const std::filesystem::path& folder) {
    std::error_code ignored;
    const bool isFile =
        std::filesystem::exists(idOrFile, ignored) && !std::filesystem::is_directory(idOrFile);
    if (isFile) return idOrFile;
    constexpr std::string_view kHard = "hard/";
    const std::vector<std::string> shipped = sceneIds(folder), hard = hardSceneIds(folder);
    for (const auto* ids : {&shipped, &hard})
        if (std::find(ids->begin(), ids->end(), idOrFile) != ids->end()) return folder / (idOrFile + ".toml");
    if (idOrFile.starts_with(kHard) && !hard.empty())
        throw SceneError(
            fmt::format("{}: no such hard case, known: {}", printable(idOrFile), fmt::join(hard, ", ")));
    throw SceneError(fmt::format("{}: neither a file nor a scene, known: {}{}", printable(idOrFile),
                                 fmt::join(shipped, ", "), hard.empty() ? "" : ", hard, all"));
}

std::vector<std::string> sceneIds(const std::filesystem::path& folder) {
    std::vector<std::string> ids;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (entry.path().extension() == ".toml" && entry.is_regular_file())
            ids.push_back(entry.path().stem().string());
    std::sort(ids.begin(), ids.end());
    return ids;
}

std::vector<std::string> hardSceneIds(const std::filesystem::path& folder) {
    std::vector<std::string> ids = sceneIds(folder / "hard");
    for (std::string& id : ids) id = fmt::format("hard/{}", id);
    return ids;
}

std::string sceneIdOf(const std::filesystem::path& file) {
    const bool isHard = file.parent_path().filename() == "hard";
    return fmt::format("{}{}", isHard ? "hard/" : "", file.stem().string());
}

}  // namespace gnomon
