#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "gl/light_frame.h"
#include "method/method.h"
#include "profile/shipped.h"
#include "scene/primitives.h"
#include "volume/blockers.h"

namespace gnomon {

inline void PrintTo(Shade shade, std::ostream* out) {
    *out << name(shade);
}

inline const std::vector<std::string> kLimitedChips{"geforce2mx", "ps2",     "tnt",
                                                    "voodoo1",    "voodoo2", "voodoo3"};

inline Object placed(const std::string& name, Mesh mesh, const glm::vec3& at, bool casts = true) {
    for (glm::vec3& p : mesh.positions) p += at;
    return {.name = name, .mesh = std::move(mesh), .casts = casts};
}

/// A floor, two boxes above it whose shadows overlap, and some background at the top of the picture.
inline Scene twoBoxes() {
    Scene scene;
    scene.objects = {placed("floor", rectangle({9, 9}), {0, 0, 0}, false),
                     placed("low", box({1.1, 0.3, 1.3}), {0.21f, 0.83f, 0.17f}),
                     placed("high", box({0.9, 0.4, 0.7}), {-0.33f, 1.67f, -0.29f})};
    scene.lights = {{.position = {0.4f, 8.3f, 0.7f, 1}}};
    scene.frames = {{.eye = {2.9f, 3.1f, 5.7f}, .target = {0, 0.6f, 0}, .fovDegrees = 50, .nearPlane = 0.5f}};
    return scene;
}

/// An eye in the shadow of a wide slab, looking at floor in the same shadow.
inline Scene underASlab() {
    Scene scene;
    scene.objects = {placed("floor", gnomon::rectangle({9, 9}), {0, 0, 0}, false),
                     placed("slab", box({8, 0.2, 8}), {0, 4.1f, 0})};
    scene.lights = {{.position = {0.3f, 9.7f, 0.2f, 1}}};
    scene.frames = {{.eye = {0.1f, 1.3f, 1.7f}, .target = {0, 0, 0}, .nearPlane = 0.2f}};
    return scene;
}

/// What one frame of a scene with one light is drawn from.
struct Frame {
    FrameSurfaces surfaces{};
    LightFrame light{};

    const FrameVolumes& volumes() const { return *light.volumes; }
    LightFrames lights() const {
        return [this](int) -> const LightFrame& { return light; };
    }
};

constexpr Parts kAllParts =
    Part::Sides | Part::NearFaces | Part::FarCap | Part::LightCap | Parts(Part::NearCap);

/// With all that any plan draws: a plan takes the parts that it needs.
inline Frame frameOf(const Scene& scene, int width, int height, std::size_t lightIndex = 0) {
    const View view = viewOf(scene.frames.front(), width, height);
    const Light& light = scene.lights.at(lightIndex);
    const auto lit = litCasters(scene, light.position, Silhouette::Winding);
    Frame out{.surfaces = frameSurfaces(scene, view)};
    out.light.colours = std::make_shared<LightColours>(lightColours(scene, light, view, out.surfaces));
    out.light.volumes =
        std::make_shared<FrameVolumes>(frameVolumes(scene, lit, light.position, view, kAllParts));
    out.light.blockers = eyeBlockers(scene, lit, light.position, view.eye);
    out.light.silhouettes = silhouetteMesh(scene, light.position, view);
    out.light.depthMap = depthMapFrame(scene, light, out.surfaces);
    return out;
}

/// The shape of a frame with one light.
inline FrameShape shapeOf(int volumes, int width, int height) {
    return {.width = width, .height = height, .lights = {{.volumes = volumes}}};
}

/// All methods that don't contradict themselves: the full product of the axes that shape a plan, at
/// @p levels.
inline std::vector<Axes> allMethods(int levels = 2) {
    using enum Store;
    using enum Arithmetic;
    std::vector<Axes> all;
    for (const Shade shade : {Shade::Black, Shade::Ambient, Shade::Attenuated}) {
        all.push_back({.store = None, .levels = 0, .shade = shade});
        all.push_back({.store = DepthMap, .levels = 0, .shade = shade, .mapSize = 64, .mapBias = 0.02f});
        for (const Store store : {Stencil, Alpha, Screen, Counter})
            for (const Arithmetic arithmetic : {Arithmetic::Count, Double, Halve, Parity})
                for (const gnomon::Count count : {Count::Zpass, Count::ZpassCap, Count::Zfail, Count::ZpPlus,
                                                  Count::PlusPlusZp, Count::AtomicZp})
                    for (const int divisor : {1, 2, 4})
                        for (const Apply apply : {Apply::Blend, Apply::Texture}) {
                            const Axes axes{.store = store,
                                            .arithmetic = arithmetic,
                                            .levels = arithmetic == Double ? levels : 0,
                                            .count = count,
                                            .maskDivisor = divisor,
                                            .apply = apply,
                                            .shade = shade};
                            if (!contradiction(axes)) all.push_back(axes);
                        }
    }
    return all;
}

inline std::string describe(const Axes& axes) {
    return methodId(axes) + " " + name(axes.shade);
}

}  // namespace gnomon
