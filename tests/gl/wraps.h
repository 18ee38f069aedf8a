#pragma once

#include <stdexcept>
#include <utility>

#include "gl/renderer.h"

namespace gnomon {

/// Whether render() draws sums that wrap. No driver knows them; chip emulation does, where it is.
inline bool drawsSumsThatWrap() {
    static const bool draws = [] {
        Surface surface({}, 4, 4);
        Profile profile;
        profile.colourFormats = {{"8888", 8, 8, 8, 8}};
        profile.sourceFactors = profile.destinationFactors = {BlendFactor::One};
        profile.blendEquations = {BlendEquation::Add, BlendEquation::AddWrap};
        const Pass pass{.kind = PassKind::Rectangle,
                        .blend = {.enabled = true,
                                  .source = BlendFactor::One,
                                  .destination = BlendFactor::One,
                                  .equation = BlendEquation::AddWrap}};
        const Plan plan{.passes = {pass}, .width = 4, .height = 4, .maskWidth = 4, .maskHeight = 4};
        try {
            render(surface, profile, plan, {}, {});
        } catch (const std::runtime_error&) {
            return false;
        }
        return true;
    }();
    return draws;
}

/// @p profile as far as render() can draw it: without sums that wrap where it doesn't.
inline Profile drawable(Profile profile) {
    if (!drawsSumsThatWrap()) profile.blendEquations.erase(BlendEquation::AddWrap);
    return profile;
}

}  // namespace gnomon
