#pragma once

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "method/method.h"

namespace gnomon {

inline Profile chip(const std::string& id) {
    return loadProfile(std::filesystem::path(GNOMON_SOURCE) / "profiles" / (id + ".toml"));
}

inline FrameShape shapeOf(int volumes, int width, int height) {
    return {.width = width, .height = height, .lights = {{.volumes = volumes}}};
}

inline constexpr int kVolumes = 3;
inline const FrameShape kFrame = shapeOf(kVolumes, 321, 241);

inline Plan planOf(const std::string& method, Shade shade = Shade::Attenuated,
                   const std::string& chipId = "ideal", const FrameShape& frame = kFrame) {
    Axes axes = findMethod(method)->axes;
    axes.shade = shade;
    return planFrame(axes, frame, chip(chipId));
}

inline std::vector<Pass> passesOf(const Plan& plan, PassKind kind) {
    std::vector<Pass> passes;
    std::copy_if(plan.passes.begin(), plan.passes.end(), std::back_inserter(passes),
                 [&](const Pass& pass) { return pass.kind == kind; });
    return passes;
}

}  // namespace gnomon
