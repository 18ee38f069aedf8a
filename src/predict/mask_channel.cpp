#include "predict/mask_channel.h"

#include <algorithm>
#include <cstddef>

namespace gnomon {
namespace {

FrameChannel channelAt(const MaskChannel& mask, int x, int y) {
    const DitherMode dither = mask.channel < 3 ? mask.dither : DitherMode::Off;
    return {mask.unit, mask.bits(), dither, ditherCell(dither, x, y)};
}

/// 8 bits, as OpenGL makes them of a colour.
int byteOf(float value) {
    return int(value * 255 + 0.5f);
}

bool compared(Compare function, int a, int b) {
    return passes(function, float(a), float(b));
}

std::optional<int> byOpenGl(const MaskChannel& mask, const Blend& b, int grey, int code) {
    const int bits = mask.bits();
    // OpenGL has no sum that wraps: of one and one it is that of the codes.
    if (b.equation == BlendEquation::AddWrap) return (code + rounded(grey, bits)) & largestCode(bits);
    const int value = replicated(code, bits), constant = byteOf(b.constant);
    const auto blended = blendInto(
        {BlendUnit::IdealRound, {"", 8, 8, 8, 8}},
        {b.source, b.destination, operationOf(b.equation), {constant, constant, constant, constant}},
        {grey, grey, grey, grey}, {value, value, value, value});
    if (!blended) return {};
    return rounded((*blended)[std::size_t(mask.channel)], bits);
}

std::optional<int> byChip(const FrameChannel& channel, const Blend& b, int grey, int code) {
    using enum BlendFactor;
    const auto is = [&](BlendFactor source, BlendFactor destination) {
        return b.equation == BlendEquation::Add && b.source == source && b.destination == destination;
    };
    if (is(DstColor, One)) return apply(channel, MaskOperation::Double, code);
    if (is(DstColor, Zero)) return apply(channel, MaskOperation::Halve, code, grey);
    if (is(OneMinusDstColor, Zero)) return apply(channel, MaskOperation::Invert, code);
    const int source = enteringSource(channel, grey), destination = readBack(channel, code);
    if (b.equation == BlendEquation::Max) return stored(channel, std::max(source, destination));
    if (b.equation == BlendEquation::Min) return stored(channel, std::min(source, destination));
    if (b.source != One || b.destination != One) return {};
    const auto sum = blendUnclamped(
        channel.unit, {.source = source, .destination = destination, .operation = operationOf(b.equation)});
    if (!sum) return {};
    return stored(channel, *sum, b.equation == BlendEquation::AddWrap);
}

}  // namespace

int MaskChannel::bits() const {
    const int widths[4] = {format.red, format.green, format.blue, format.alpha};
    return widths[channel];
}

int clearedTo(const MaskChannel& mask, int x, int y, float value) {
    if (mask.openGl) return rounded(byteOf(value), mask.bits());
    const FrameChannel channel = channelAt(mask, x, y);
    return stored(channel, enteringSource(channel, byteOf(value)));
}

std::optional<int> blendedCode(const MaskChannel& mask, int x, int y, const Pass& pass, int code) {
    if (pass.logicInvert) return code ^ largestCode(mask.bits());
    const int grey = byteOf(mask.channel == 3 ? pass.colour.a : pass.colour.r);
    if (!pass.blend.enabled) return clearedTo(mask, x, y, float(grey) / 255);
    return mask.openGl ? byOpenGl(mask, pass.blend, grey, code)
                       : byChip(channelAt(mask, x, y), pass.blend, grey, code);
}

int stencilled(const Stencil& test, bool front, bool depthPasses, int value) {
    const auto masked = [&](int v) { return int(unsigned(v) & test.readMask & 0xffu); };
    if (!compared(test.function, masked(test.reference), masked(value))) return value;
    const StencilSide& side = front ? test.front : test.back;
    int result = value;
    switch (depthPasses ? side.onPass : side.onDepthFail) {
        case StencilOp::Keep:
            break;
        case StencilOp::Zero:
            result = 0;
            break;
        case StencilOp::Replace:
            result = test.reference;
            break;
        case StencilOp::Incr:
            result = std::min(value + 1, 255);
            break;
        case StencilOp::Decr:
            result = std::max(value - 1, 0);
            break;
        case StencilOp::IncrWrap:
            result = (value + 1) & 0xff;
            break;
        case StencilOp::DecrWrap:
            result = (value - 1) & 0xff;
            break;
        case StencilOp::Invert:
            result = ~value & 0xff;
            break;
    }
    const int write = int(test.writeMask & 0xffu);
    return (result & write) | (value & ~write);
}

bool passesDepth(const Pass& pass, bool nearer, bool equal) {
    return !pass.depthTest || passes(pass.depthFunction, nearer ? 0.0f : equal ? 1.0f : 2.0f, 1.0f);
}

}  // namespace gnomon
