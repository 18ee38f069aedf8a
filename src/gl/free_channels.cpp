#include "gl/free_channels.h"

#include <algorithm>

namespace gnomon {
namespace {

bool readsAlpha(BlendFactor factor) {
    return factor == BlendFactor::DstAlpha || factor == BlendFactor::OneMinusDstAlpha ||
           factor == BlendFactor::SrcAlphaSaturate;
}

bool usesAlpha(const Pass& pass) {
    return pass.write.alpha || pass.texture == MaskTexture::Alpha ||
           (pass.blend.enabled && (readsAlpha(pass.blend.source) || readsAlpha(pass.blend.destination)));
}

bool usesStencil(const Pass& pass) {
    return pass.stencil.enabled || pass.clearsStencil;
}

}  // namespace

FreeChannels freeChannels(const Plan& plan, const Profile& profile, const BufferFormat& buffers) {
    const bool hasAlpha = profile.alphaBits > 0 && buffers.alpha > 0;
    const bool hasStencil = profile.stencilBits > 0 && buffers.stencil > 0;
    return {hasAlpha && std::none_of(plan.passes.begin(), plan.passes.end(), usesAlpha),
            hasStencil && std::none_of(plan.passes.begin(), plan.passes.end(), usesStencil)};
}

}  // namespace gnomon
