#include "profile/frame_channel.h"

namespace gnomon {
namespace {

using enum MaskOperation;

/// On codes, whatever their width.
std::optional<int> applyIdeal(const FrameChannel& channel, MaskOperation operation, int code) {
    const int most = largestCode(channel.bits);
    ChannelBlend c{.source = most, .destination = code, .most = most};
    switch (operation) {
        case Double:
            c.sourceWeight = Weight::of(code, most);
            break;
        case Halve:
            c.sourceWeight = Weight::zero();
            c.destinationWeight = Weight::of(1, 2);
            break;
        case Invert:
            c.sourceWeight = Weight::complement(code, most);
            c.destinationWeight = Weight::zero();
            break;
        case Increment:
        case Decrement:
            c.source = 1;
            if (operation == Decrement) c.operation = BlendOperation::ReverseSubtract;
            break;
    }
    return blend(channel.unit, c);
}

/// Units that take any factor, on 8 bits.
std::optional<int> applyByFactors(const FrameChannel& channel, MaskOperation operation, int value, int half) {
    const int one = enteringSource(channel, 255);
    ChannelBlend c{.source = one, .destination = value};
    switch (operation) {
        case Double:
            c.sourceWeight = Weight::of(value);
            break;
        case Halve:
            c.source = enteringSource(channel, half);
            c.sourceWeight = Weight::of(value);
            c.destinationWeight = Weight::zero();
            break;
        case Invert:
            c.sourceWeight = Weight::complement(value);
            c.destinationWeight = Weight::zero();
            break;
        case Increment:
        case Decrement:
            c.source = 1 << (8 - channel.bits);
            if (operation == Decrement) c.operation = BlendOperation::ReverseSubtract;
            break;
    }
    return blend(channel.unit, c);
}

/// Section 2(a), row of the PS2; the source colour is constant.
int applyGs(const FrameChannel& channel, MaskOperation operation, int value) {
    using enum GsInput;
    const int step = 1 << (8 - channel.bits);
    const bool clamps = channel.unit == BlendUnit::Gs;
    switch (operation) {
        case Double:
            return blendGs({Destination, Zero, 0x80, Destination}, 0, value, clamps);
        case Halve:
            return blendGs({Destination, Zero, 0x40, Zero}, 0, value, clamps);
        case Invert:
            return blendGs({Source, Destination, 0x80, Zero}, 255, value, clamps);
        case Increment:
            return blendGs({Source, Zero, 0x80, Destination}, step, value, clamps);
        case Decrement:
            return blendGs({Zero, Source, 0x80, Destination}, step, value, clamps);
    }
    return value;
}

/// Section 4.3: in 5 bits blend colours 17 and 255 count by two codes up and down, modulo 32.
std::optional<int> applyRdp(const FrameChannel& channel, MaskOperation operation, int value) {
    switch (operation) {
        case Double:
            return blendRdp(value, 31, value, 31);
        case Halve:
            return blendRdp(0, 16, value, 15);
        case Invert:
            return {};
        case Increment:
            if (channel.bits != 5) return {};
            return blendRdp(17, 31, value, 31);
        case Decrement:
            if (channel.bits != 5) return {};
            return blendRdp(255, 31, value, 31);
    }
    return {};
}

std::optional<int> applyNv3(MaskOperation operation, int code) {
    if (operation == Halve) return blendNv3(0, code, 16);
    if (operation == Increment) return addNv3(1, code);
    return {};
}

std::optional<int> applyPsx(MaskOperation operation, int code) {
    switch (operation) {
        case Double:
            return blendPsx(PsxBlend::Add, code, code);
        case Halve:
            return blendPsx(PsxBlend::Average, 0, code);
        case Invert:
            return {};
        case Increment:
            return blendPsx(PsxBlend::Add, 1, code);
        case Decrement:
            return blendPsx(PsxBlend::Subtract, 1, code);
    }
    return {};
}

}  // namespace

int readBack(const FrameChannel& channel, int code) {
    switch (channel.unit) {
        case BlendUnit::Gs:
        case BlendUnit::GsWrap:
        case BlendUnit::Rdp:
        case BlendUnit::Nv2a:
            return shifted(code, channel.bits);
        default:
            break;
    }
    const bool subtracts =
        channel.dither == DitherMode::Matrix4x4Subtract || channel.dither == DitherMode::Matrix2x2Subtract;
    return replicated(code, channel.bits) + (subtracts ? ditherSubtraction(channel.bits, channel.cell) : 0);
}

int enteringSource(const FrameChannel& channel, int value) {
    if (channel.unit != BlendUnit::Nv2a) return value;
    return shifted(truncated(value, channel.bits), channel.bits);
}

int stored(const FrameChannel& channel, int value) {
    if (channel.dither != DitherMode::Off) return voodooDithered(value, channel.bits, channel.cell);
    return truncated(value, channel.bits);
}

std::optional<Rgba> blendInto(const FrameState& frame, const BlendState& state, const Rgba& source,
                              const Rgba& codes) {
    constexpr int kAlpha = 3;
    const ColourFormat& f = frame.format;
    const std::array bits{f.red, f.green, f.blue};
    const auto channelOf = [&](int c) {
        return FrameChannel{frame.unit, bits[static_cast<std::size_t>(c)], frame.dither,
                            voodooCell(frame.dither, frame.x, frame.y)};
    };
    const auto index = [](int c) { return static_cast<std::size_t>(c); };

    const bool isGs = frame.unit == BlendUnit::Gs || frame.unit == BlendUnit::GsWrap;

    // Read
    Rgba entering = source, destination{};
    for (int c = 0; c < kAlpha; ++c) {
        entering[index(c)] = enteringSource(channelOf(c), source[index(c)]);
        destination[index(c)] = readBack(channelOf(c), codes[index(c)]);
    }
    if (isGs)
        destination[kAlpha] = f.alpha == 0 ? 0x80 : shifted(codes[kAlpha], f.alpha);
    else
        destination[kAlpha] = f.alpha == 0 ? 255 : replicated(codes[kAlpha], f.alpha);

    // Blend
    std::optional<Rgba> result = blendPixel(frame.unit, state, entering, destination);
    if (!result) return {};
    if (isGs) (*result)[kAlpha] = source[kAlpha];

    // Store
    Rgba out{};
    for (int c = 0; c < kAlpha; ++c) out[index(c)] = stored(channelOf(c), (*result)[index(c)]);
    out[kAlpha] = f.alpha == 0 ? 0 : truncated((*result)[kAlpha], f.alpha);
    if (frame.unit == BlendUnit::Ge) out[kAlpha] = codes[kAlpha];
    return out;
}

std::optional<int> apply(const FrameChannel& channel, MaskOperation operation, int code, int half) {
    const int value = readBack(channel, code);
    std::optional<int> result;
    switch (channel.unit) {
        case BlendUnit::IdealRound:
        case BlendUnit::IdealFloor:
            return applyIdeal(channel, operation, code);
        case BlendUnit::Nv3:
            if (channel.bits != 5) return {};
            return applyNv3(operation, code);
        case BlendUnit::Psx:
            if (channel.bits != 5) return {};
            return applyPsx(operation, code);
        case BlendUnit::Ds:
            if (operation != Halve || channel.bits != 6) return {};
            return blendDs(0, code, 15);
        case BlendUnit::Gs:
        case BlendUnit::GsWrap:
            result = applyGs(channel, operation, value);
            break;
        case BlendUnit::Rdp:
            result = applyRdp(channel, operation, value);
            break;
        case BlendUnit::Virge:
            if (operation != Halve) return {};
            result = blend(channel.unit, {.destination = value,
                                          .sourceWeight = Weight::of(255 - half),
                                          .destinationWeight = Weight::complement(255 - half)});
            break;
        default:
            result = applyByFactors(channel, operation, value, half);
            break;
    }
    if (!result) return {};
    return stored(channel, *result);
}

bool takesHalfConstant(BlendUnit unit) {
    switch (unit) {
        case BlendUnit::ProductsRound:
        case BlendUnit::ProductsFloor:
        case BlendUnit::VoodooMame:
        case BlendUnit::Voodoo86Box:
        case BlendUnit::PowerVr:
        case BlendUnit::Flipper:
        case BlendUnit::Ge:
        case BlendUnit::Virge:
        case BlendUnit::Nv2a:
            return true;
        default:
            return false;
    }
}

}  // namespace gnomon
