#include "matrix/film_strip.h"

#include <algorithm>
#include <array>
#include <utility>

#include "gl/renderer.h"

namespace gnomon {
namespace {

Image alphaOf(Surface& surface) {
    const Image colour = readColour(surface, true);
    Image alpha{colour.width, colour.height, 1, {}};
    alpha.data.reserve(colour.data.size() / 4);
    for (std::size_t i = 3; i < colour.data.size(); i += 4) alpha.data.push_back(colour.data[i]);
    return alpha;
}

}  // namespace

const std::string& name(MaskBuffer buffer) {
    static const std::array<std::string, 3> names{"", "stencil", "alpha"};
    return names[std::size_t(buffer)];
}

Plan drawnPlan(Lab& lab, const Profile& profile, const Axes& axes, int width, int height, int frame) {
    const auto& effects = lab.simulated();
    if (!effects || *effects == Effects::all()) return lab.plan(profile, axes, width, height, frame);
    return lab.minimalPlan(profile, axes, width, height, frame).plan;
}

std::vector<std::size_t> stripPasses(const Plan& plan, std::size_t mostVolumes) {
    std::vector<std::size_t> passes;
    std::size_t volumes = 0;
    for (std::size_t i = 0; i < plan.passes.size(); ++i)
        if (plan.passes[i].kind != PassKind::Volume || ++volumes <= mostVolumes) passes.push_back(i);
    return passes;
}

MaskBuffer maskBufferOf(const Plan& plan) {
    switch (plan.maskPlace()) {
        case MaskPlace::Stencil:
            return MaskBuffer::Stencil;
        case MaskPlace::Alpha:
            return MaskBuffer::Alpha;
        default:
            return MaskBuffer::None;
    }
}

std::function<void(Surface&, std::size_t)> stripReader(std::vector<std::size_t> passes, MaskBuffer buffer,
                                                       std::function<void(StripPicture)> take) {
    return [passes = std::move(passes), buffer, take = std::move(take)](Surface& surface, std::size_t pass) {
        if (!std::binary_search(passes.begin(), passes.end(), pass)) return;
        StripPicture picture{.pass = pass, .colour = readColour(surface)};
        if (buffer == MaskBuffer::Stencil) picture.mask = readStencil(surface);
        if (buffer == MaskBuffer::Alpha) picture.mask = alphaOf(surface);
        take(std::move(picture));
    };
}

}  // namespace gnomon
