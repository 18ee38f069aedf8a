#include "cost/traffic.h"

#include <algorithm>

#include "gl/buffer_format.h"

namespace gnomon {
namespace {

bool readsDestination(BlendFactor source) {
    using enum BlendFactor;
    return source == DstColor || source == OneMinusDstColor || source == DstAlpha ||
           source == OneMinusDstAlpha || source == SrcAlphaSaturate;
}

/// Whether some byte of a pixel keeps a part of its bits: a memory writes whole bytes.
bool splitsAByte(const ColourWrite& write, const BufferFormat& format) {
    struct Channel {
        bool isWritten;
        int bits;
    };
    const Channel channels[]{{write.red, format.red},
                             {write.green, format.green},
                             {write.blue, format.blue},
                             {write.alpha, format.alpha}};
    const auto isThere = [](const Channel& c) { return c.bits > 0; };
    const auto isKept = [&](const Channel& c) { return isThere(c) && !c.isWritten; };
    const auto isWhole = [&](const Channel& c) { return !isThere(c) || c.bits == 8; };
    return std::any_of(std::begin(channels), std::end(channels), isKept) &&
           !std::all_of(std::begin(channels), std::end(channels), isWhole);
}

bool readsColour(const Pass& pass, const BufferFormat& format) {
    if (pass.logicInvert || splitsAByte(pass.write, format)) return true;
    if (!pass.blend.enabled) return false;
    const BlendEquation e = pass.blend.equation;
    return e == BlendEquation::Min || e == BlendEquation::Max ||
           pass.blend.destination != BlendFactor::Zero || readsDestination(pass.blend.source);
}

bool writesColour(const Pass& pass, const BufferFormat& format) {
    const ColourWrite& w = pass.write;
    return w.red || w.green || w.blue || (w.alpha && format.alpha > 0);
}

PassTraffic cleared(const Pass& pass, const BufferFormat& format, const PixelBytes& pixel,
                    std::int64_t pixels) {
    PassTraffic out{.fragments = pixels, .passed = pixels};
    if (pass.clearsDepth || pass.clearsStencil) out.depthWritten = pixels * pixel.depth;
    if (!writesColour(pass, format)) return out;
    out.colourWritten = pixels * pixel.colour;
    if (splitsAByte(pass.write, format)) out.colourRead = out.colourWritten;
    return out;
}

/// A mask in one channel becomes a texture of one byte.
int texelBytes(const Pass& pass, const PixelBytes& pixel) {
    const bool isOneChannel = pass.texture == MaskTexture::Intensity || pass.texture == MaskTexture::Alpha;
    return isOneChannel && !pass.frameTexture ? 1 : pixel.colour;
}

PassTraffic copied(const Pass& pass, const Profile& profile, const PixelBytes& pixel, std::int64_t texels) {
    const int texel = texelBytes(pass, pixel);
    switch (profile.frameTexture) {
        case FrameTexture::Copy:
            return {
                .fragments = texels, .colourRead = texels * pixel.colour, .textureWritten = texels * texel};
        case FrameTexture::Host:
            return {.busBytes = texels * (pixel.colour + texel)};
        case FrameTexture::None:
        case FrameTexture::Direct:
            break;
    }
    return {};
}

PassTraffic drawn(const Pass& pass, const BufferFormat& format, const PixelBytes& pixel,
                  const DrawnAmount& amount, std::optional<std::int64_t> counted) {
    const std::int64_t all = amount.pixels.total();
    PassTraffic out{.fragments = all, .passed = std::min(all, counted.value_or(all))};
    out.triangles = pass.kind == PassKind::Rectangle ? 2 : amount.vertices / 3;

    // The depth word, with the stencil in it.
    const bool comparesDepth = pass.depthTest && pass.depthFunction != Compare::Always;
    const auto changes = [&](StencilOp StencilSide::*when) {
        return pass.stencil.enabled && pass.stencil.writeMask != 0 &&
               (pass.stencil.front.*when != StencilOp::Keep || pass.stencil.back.*when != StencilOp::Keep);
    };
    if (comparesDepth || pass.stencil.enabled) out.depthRead = all * pixel.depth;
    if ((pass.depthTest && pass.depthWrite) || changes(&StencilSide::onPass))
        out.depthWritten += out.passed * pixel.depth;
    if (changes(&StencilSide::onDepthFail)) out.depthWritten += (all - out.passed) * pixel.depth;

    if (!writesColour(pass, format)) return out;
    out.colourWritten = out.passed * pixel.colour;
    if (readsColour(pass, format)) out.colourRead = out.colourWritten;
    return out;
}

}  // namespace

PassTraffic trafficOf(const Pass& pass, const Profile& profile, const DrawnAmount& amount,
                      std::optional<std::int64_t> passed) {
    const BufferFormat format = bufferFormatOf(profile);
    const PixelBytes pixel = pixelBytes(profile);
    switch (pass.kind) {
        case PassKind::Clear:
            return cleared(pass, format, pixel, amount.pixels.clear);
        case PassKind::Copy:
            return copied(pass, profile, pixel, amount.pixels.copy);
        case PassKind::Scene:
        case PassKind::Volume:
        case PassKind::Rectangle:
            break;
    }
    return drawn(pass, format, pixel, amount, passed);
}

}  // namespace gnomon
