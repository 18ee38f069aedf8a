#include <algorithm>

#include "plan/plan.h"

namespace gnomon {

WindowRect around(const WindowRect& a, const WindowRect& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

std::optional<WindowRect> scissorOf(const Pass& pass, std::span<const MaskWindow> windows) {
    if (pass.extent == Extent::Whole || pass.kind == PassKind::Copy) return std::nullopt;
    const MaskWindow& window = windows[std::size_t(pass.light)];
    const bool ofOne = pass.extent == Extent::Volumes && pass.volume != kAllVolumes;
    return ofOne ? window.volumes[std::size_t(pass.volume)] : window.all;
}

PassCounts countPasses(const Plan& plan) {
    PassCounts counts;
    for (const Pass& pass : plan.passes) {
        switch (pass.kind) {
            case PassKind::Clear:
                break;
            case PassKind::Scene:
                ++counts.scene;
                break;
            case PassKind::Volume:
                ++counts.volume;
                break;
            case PassKind::Rectangle:
                ++counts.rectangle;
                break;
            case PassKind::Copy:
                ++counts.copy;
                break;
        }
    }
    return counts;
}

bool passes(Compare function, float value, float reference) {
    switch (function) {
        case Compare::Never:
            return false;
        case Compare::Less:
            return value < reference;
        case Compare::Equal:
            return value == reference;
        case Compare::Lequal:
            return value <= reference;
        case Compare::Greater:
            return value > reference;
        case Compare::Notequal:
            return value != reference;
        case Compare::Gequal:
            return value >= reference;
        case Compare::Always:
            return true;
    }
    return true;
}

bool drawsBackdrop(const Pass& pass) {
    if (pass.kind != PassKind::Scene || pass.target == Target::DepthMap || !pass.write.any()) return false;
    if (pass.shading == Shading::Mask) return false;
    return pass.program == Program::ShadeCount ||
           (pass.blend.enabled && pass.blend.source == BlendFactor::DstColor);
}

bool isShadow(const Plan& plan, const MaskTap& tap, double value, int reference) {
    switch (tap.place) {
        case MaskPlace::Stencil:
            return value != reference;
        case MaskPlace::Counter:
            return value != 0;
        case MaskPlace::Texture:
            if (tap.alphaTest.enabled)
                return passes(tap.alphaTest.function, float(value), tap.alphaTest.reference * 255);
            break;
        case MaskPlace::None:
            return false;
        default:
            break;
    }
    return value < plan.threshold * 255;
}

}  // namespace gnomon
