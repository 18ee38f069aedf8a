#include "matrix/result_key.h"

#include <fmt/format.h>

namespace gnomon {

std::string resultKey(const BufferFormat& f, const ChipArithmetic& chip, const Plan& plan, const Axes& axes,
                      const std::vector<VolumeKey>& volumes,
                      const std::vector<std::vector<std::uint32_t>>& kept) {
    std::string key =
        fmt::format("{}.{}.{}.{}.{}.{} {}x{} {}x{} {}x{} {} {} {} {} {}", f.red, f.green, f.blue, f.alpha,
                    f.depth, f.stencil, plan.maskWidth, plan.maskHeight, plan.textureWidth,
                    plan.textureHeight, plan.frameTextureWidth, plan.frameTextureHeight, plan.threshold,
                    plan.shadowShare, plan.mapSize, plan.mapBias, name(plan.clip));
    key += fmt::format(" {} {} {} {}", name(chip.fidelity), name(chip.unit), name(chip.undithered),
                       name(chip.depth));
    for (const VolumeKey& v : volumes) {
        key += fmt::format(" {} {} {} {} {} ", name(v.silhouette), name(v.capFaces), name(v.style.clip),
                           v.style.flatten, v.style.offset);
        for (int part = 0; part < kParts; ++part) key += v.parts.has(Part(part)) ? '1' : '0';
    }
    // What decides of causes and of what is a tie.
    key += fmt::format(" {} {} {}", name(axes.arithmetic), name(axes.store), axes.levels);
    for (const Pass& pass : plan.passes)
        key += fmt::format("|{} {} {} {} {} {} {}", pass.label, describeState(pass), int(pass.shading),
                           pass.light, int(pass.drawn), pass.stencilValue, int(pass.extent));
    for (const MaskTap& tap : plan.masks) key += fmt::format(" outside {}", tap.outside);
    const auto add = [&](const WindowRect& r) {
        key += fmt::format(" {},{} {}x{}", r.x, r.y, r.width, r.height);
    };
    for (const MaskWindow& window : plan.windows) {
        add(window.all);
        for (const WindowRect& one : window.volumes) add(one);
    }
    for (const auto& light : kept) key += fmt::format(" [{}]", fmt::join(light, " "));
    return key;
}

}  // namespace gnomon
