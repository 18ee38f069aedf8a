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
        case IncrementWrap:
        case DecrementWrap:
            c.source = operation == IncrementWrap ? 1 : most;
            c.operation = BlendOperation::AddWrap;
            break;
        case InvertBits:
            return {};
    }
    return blend(channel.unit, c);
}

/// A value of 8 bits before its clamp, and whether it wraps instead.
struct Sum {
    int value = 0;
    bool wraps = false;
};

/// Units that take any factor, on 8 bits.
std::optional<Sum> applyByFactors(const FrameChannel& channel, MaskOperation operation, int value, int half) {
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
        case IncrementWrap:
        case DecrementWrap:
        case InvertBits:
            return {};
    }
    const auto sum = blendUnclamped(channel.unit, c);
    if (!sum) return {};
    return Sum{*sum};
}

/// Section 2(a), row of the PS2; the source colour is constant.
std::optional<Sum> applyGs(const FrameChannel& channel, MaskOperation operation, int value) {
    using enum GsInput;
    const int step = 1 << (8 - channel.bits);
    switch (operation) {
        case Double:
            return Sum{sumGs({Destination, Zero, 0x80, Destination}, 0, value)};
        case Halve:
            return Sum{sumGs({Destination, Zero, 0x40, Zero}, 0, value)};
        case Invert:
            return Sum{sumGs({Source, Destination, 0x80, Zero}, 255, value)};
        case Increment:
            return Sum{sumGs({Source, Zero, 0x80, Destination}, step, value)};
        case Decrement:
            return Sum{sumGs({Zero, Source, 0x80, Destination}, step, value)};
        case IncrementWrap:
            return Sum{sumGs({Source, Zero, 0x80, Destination}, step, value), true};
        case DecrementWrap:
            return Sum{sumGs({Source, Zero, 0x80, Destination}, 256 - step, value), true};
        case InvertBits:
            return {};
    }
    return {};
}

/// Section 4.3: in 5 bits blend colours 17 and 255 count by two codes up and down, modulo 32.
std::optional<Sum> applyRdp(const FrameChannel& channel, MaskOperation operation, int value) {
    switch (operation) {
        case Double:
            return Sum{blendRdp(value, 31, value, 31)};
        case Halve:
            return Sum{blendRdp(0, 16, value, 15)};
        case Increment:
        case IncrementWrap:
            if (channel.bits != 5) return {};
            return Sum{blendRdp(17, 31, value, 31)};
        case Decrement:
        case DecrementWrap:
            if (channel.bits != 5) return {};
            return Sum{blendRdp(255, 31, value, 31)};
        case Invert:
        case InvertBits:
            return {};
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
        case Increment:
            return blendPsx(PsxBlend::Add, 1, code);
        case Decrement:
            return blendPsx(PsxBlend::Subtract, 1, code);
        default:
            return {};
    }
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
        dithers(channel.dither, channel.bits) &&
        (channel.dither == DitherMode::Matrix4x4Subtract || channel.dither == DitherMode::Matrix2x2Subtract);
    return replicated(code, channel.bits) + (subtracts ? ditherSubtraction(channel.bits, channel.cell) : 0);
}

int enteringSource(const FrameChannel& channel, int value) {
    if (channel.unit == BlendUnit::Nv2a) return shifted(truncated(value, channel.bits), channel.bits);
    if (channel.dither == DitherMode::Psx && dithers(channel.dither, channel.bits))
        return shifted(signedDithered(value, channel.bits, channel.cell), channel.bits);
    return value;
}

int stored(const FrameChannel& channel, int value, bool wraps) {
    const BlendOperation operation = wraps ? BlendOperation::AddWrap : BlendOperation::Add;
    const DitherMode mode = dithers(channel.dither, channel.bits) ? channel.dither : DitherMode::Off;
    const bool cellComesFirst = mode == DitherMode::Gs || mode == DitherMode::Ge;
    const int whole = finished(channel.unit, operation, cellComesFirst ? value + channel.cell : value);
    switch (mode) {
        case DitherMode::Virge:
            return virgeDithered(whole, channel.cell);
        case DitherMode::RdpMagic:
        case DitherMode::RdpBayer:
            return truncated(rdpDithered(whole, channel.cell), channel.bits);
        case DitherMode::Off:
        case DitherMode::Gs:
        case DitherMode::Ge:
        case DitherMode::Psx:
            return truncated(whole, channel.bits);
        default:
            return voodooDithered(whole, channel.bits, channel.cell);
    }
}

std::optional<Rgba> blendInto(const FrameState& frame, const BlendState& state, const Rgba& source,
                              const Rgba& codes) {
    constexpr int kAlpha = 3;
    const ColourFormat& f = frame.format;
    const std::array bits{f.red, f.green, f.blue};
    const auto channelOf = [&](int c) {
        return FrameChannel{frame.unit, bits[static_cast<std::size_t>(c)], frame.dither,
                            ditherCell(frame.dither, frame.x, frame.y)};
    };
    const auto index = [](int c) { return static_cast<std::size_t>(c); };

    const bool gs = isGs(frame.unit);

    // Read
    Rgba entering = source, destination{};
    for (int c = 0; c < kAlpha; ++c) {
        entering[index(c)] = enteringSource(channelOf(c), source[index(c)]);
        destination[index(c)] = readBack(channelOf(c), codes[index(c)]);
    }
    if (gs)
        destination[kAlpha] = f.alpha == 0 ? 0x80 : shifted(codes[kAlpha], f.alpha);
    else
        destination[kAlpha] = f.alpha == 0 ? 255 : replicated(codes[kAlpha], f.alpha);

    // Blend
    std::optional<Rgba> result = blendPixelUnclamped(frame.unit, state, entering, destination);
    if (!result) return {};
    const bool wraps = state.operation == BlendOperation::AddWrap;
    (*result)[kAlpha] = finished(frame.unit, state.operation, (*result)[kAlpha]);
    if (gs) {
        if (!gsDatePasses(frame.gs, codes[kAlpha], f.alpha)) return codes;
        if (!gsBlends(frame.gs.pabe, source[kAlpha])) result = entering;
        (*result)[kAlpha] = gsAlpha(frame.gs.fba, source[kAlpha]);
    }

    // Store
    Rgba out{};
    for (int c = 0; c < kAlpha; ++c) out[index(c)] = stored(channelOf(c), (*result)[index(c)], wraps);
    out[kAlpha] = f.alpha == 0 ? 0 : truncated((*result)[kAlpha], f.alpha);
    if (frame.unit == BlendUnit::Ge) out[kAlpha] = codes[kAlpha];
    if (gs) {
        const std::array widths{f.red, f.green, f.blue, f.alpha};
        for (std::size_t c = 0; c < out.size(); ++c)
            if (widths[c] > 0) out[c] = gsMasked(out[c], codes[c], truncated(frame.gs.mask[c], widths[c]));
    }
    return out;
}

std::optional<int> apply(const FrameChannel& channel, MaskOperation operation, int code, int half) {
    if (operation == InvertBits) return code ^ largestCode(channel.bits);
    const int value = readBack(channel, code);
    std::optional<Sum> sum;
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
            sum = applyGs(channel, operation, value);
            break;
        case BlendUnit::Rdp:
            sum = applyRdp(channel, operation, value);
            break;
        case BlendUnit::Virge:
            if (operation != Halve) return {};
            sum = Sum{*blend(channel.unit, {.destination = value,
                                            .sourceWeight = Weight::of(255 - half),
                                            .destinationWeight = Weight::complement(255 - half)})};
            break;
        default:
            sum = applyByFactors(channel, operation, value, half);
            break;
    }
    if (!sum) return {};
    return stored(channel, sum->value, sum->wraps);
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
