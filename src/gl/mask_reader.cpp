#include "gl/mask_reader.h"

#include <algorithm>
#include <cassert>

#include "gl/renderer.h"

namespace gnomon {
namespace {

MaskValues channelOf(const Image& image, int channel) {
    MaskValues values(std::size_t(image.width) * image.height);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = image.data[i * image.channels + channel];
    return values;
}

/// Red and green hold a count of 16 bits.
MaskValues countsOf(const Image& image) {
    MaskValues values(std::size_t(image.width) * image.height);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = std::uint16_t(image.data[i * image.channels] + 256 * image.data[i * image.channels + 1]);
    return values;
}

/// The mask as it went over the scene: its texture over the whole window, by itself. The window's colours
/// wait in another texture meanwhile.
MaskValues readMaskTexture(Surface& surface, const Plan& plan, PassRunner& runner) {
    const GlTable& gl = surface.driver();
    runner.defaultState();
    resetState(gl);
    gl.Viewport(0, 0, plan.width, plan.height);
    CopiedTexture kept;
    gl.GenTextures(1, &kept.name);
    gl.BindTexture(GL_TEXTURE_2D, kept.name);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.CopyTexImage2D(GL_TEXTURE_2D, 0, surface.format().alpha ? GL_RGBA : GL_RGB, 0, 0, plan.width,
                      plan.height, 0);
    fillWith(gl, runner.mask());
    const bool inAlpha = std::any_of(plan.passes.begin(), plan.passes.end(), [](const Pass& pass) {
        return pass.kind == PassKind::Copy && pass.texture == MaskTexture::Alpha;
    });
    MaskValues values = channelOf(readColour(surface, inAlpha), inAlpha ? 3 : 0);
    fillWith(gl, kept);
    gl.DeleteTextures(1, &kept.name);
    return values;
}

/// The mask as it stands in its buffer, or as its texture goes over the scene.
MaskValues readDrawnMask(Surface& surface, const Plan& plan, const MaskTap& tap, PassRunner& runner) {
    switch (tap.place) {
        case MaskPlace::Stencil:
            return channelOf(readStencil(surface), 0);
        case MaskPlace::Colour:
            return channelOf(readColour(surface), 0);
        case MaskPlace::Alpha:
            return channelOf(readColour(surface, true), 3);
        case MaskPlace::Counter:
            return countsOf(readColour(surface));
        case MaskPlace::Texture:
            return readMaskTexture(surface, plan, runner);
        case MaskPlace::None:
            break;
    }
    return MaskValues(std::size_t(plan.width) * plan.height);
}

}  // namespace

MaskValues readMask(Surface& surface, const Plan& plan, const MaskTap& tap, PassRunner& runner) {
    MaskValues values = readDrawnMask(surface, plan, tap, runner);
    if (tap.outside < 0) return values;
    const WindowRect& drawn = plan.windows[std::size_t(tap.light)].all;
    // Pixels of the mask are the window's, unless none is drawn.
    assert(drawn.empty() || (plan.maskWidth == plan.width && plan.maskHeight == plan.height));
    for (int y = 0; y < plan.height; ++y)
        for (int x = 0; x < plan.width; ++x)
            if (!drawn.holds(x, plan.height - 1 - y))
                values[std::size_t(y) * std::size_t(plan.width) + std::size_t(x)] =
                    std::uint16_t(tap.outside);
    return values;
}

}  // namespace gnomon
