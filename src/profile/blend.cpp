#include "profile/blend.h"

#include <algorithm>
#include <cstdlib>

namespace gnomon {
namespace {

using Kind = Weight::Kind;
using enum BlendOperation;

/// value * weight.numerator / weight.denominator.
struct Ratio {
    std::int64_t numerator = 0, denominator = 1;
};

Ratio ratioOf(const Weight& weight) {
    switch (weight.kind) {
        case Kind::Zero:
            return {0, 1};
        case Kind::One:
            return {1, 1};
        case Kind::Value:
            return {weight.value, weight.unit};
        case Kind::Complement:
            return {weight.unit - weight.value, weight.unit};
    }
    return {};
}

std::int64_t floorOf(std::int64_t numerator, std::int64_t denominator) {
    const std::int64_t quotient = numerator / denominator;
    return numerator % denominator < 0 ? quotient - 1 : quotient;
}

std::int64_t rounded(std::int64_t numerator, std::int64_t denominator, bool nearest) {
    return nearest ? floorOf(2 * numerator + denominator, 2 * denominator) : floorOf(numerator, denominator);
}

template <class Number>
Number combined(BlendOperation operation, Number s, Number d) {
    switch (operation) {
        case Subtract:
            return s - d;
        case ReverseSubtract:
            return d - s;
        default:
            return s + d;
    }
}

int blendIdeal(const ChannelBlend& c, bool nearest, bool eachProduct) {
    const Ratio f = ratioOf(c.sourceWeight), g = ratioOf(c.destinationWeight);
    std::int64_t result = 0;
    if (eachProduct) {
        result = combined(c.operation, rounded(c.source * f.numerator, f.denominator, nearest),
                          rounded(c.destination * g.numerator, g.denominator, nearest));
    } else {
        const std::int64_t sum = combined(c.operation, c.source * f.numerator * g.denominator,
                                          c.destination * g.numerator * f.denominator);
        result = rounded(sum, f.denominator * g.denominator, nearest);
    }
    return static_cast<int>(result);
}

/// What the chip multiplies by: @p one for 1, @p value(v) for a value, @p complement(v) for 1 - v.
template <class Value, class Complement>
int factorOf(const Weight& weight, int one, Value value, Complement complement) {
    switch (weight.kind) {
        case Kind::Zero:
            return 0;
        case Kind::One:
            return one;
        case Kind::Value:
            return value(weight.value);
        case Kind::Complement:
            return complement(weight.value);
    }
    return 0;
}

int blendVoodooMame(const ChannelBlend& c) {
    const auto factor = [](const Weight& weight) {
        return factorOf(
            weight, 256, [](int v) { return v + 1; }, [](int v) { return 256 - v; });
    };
    return (c.source * factor(c.sourceWeight) + c.destination * factor(c.destinationWeight)) >> 8;
}

int blendVoodoo86Box(const ChannelBlend& c) {
    const auto factor = [](const Weight& weight) {
        return factorOf(
            weight, 255, [](int v) { return v; }, [](int v) { return 255 - v; });
    };
    return c.source * factor(c.sourceWeight) / 255 + c.destination * factor(c.destinationWeight) / 255;
}

/// Dreamcast's and Flipper's: 255 counts as 256 in a factor.
int blendPowerVr(const ChannelBlend& c) {
    const auto widened = [](int v) { return v + (v >> 7); };
    const auto factor = [&](const Weight& weight) {
        return factorOf(weight, 256, widened, [&](int v) { return widened(255 - v); });
    };
    return (c.source * factor(c.sourceWeight) + c.destination * factor(c.destinationWeight)) >> 8;
}

int blendGe(const ChannelBlend& c) {
    const auto product = [](int colour, const Weight& weight) {
        const int factor = factorOf(
            weight, 255, [](int v) { return v; }, [](int v) { return 255 - v; });
        const int size = ((2 * colour + 1) * (2 * std::abs(factor) + 1)) >> 10;
        return factor < 0 ? -size : size;
    };
    return combined(c.operation, product(c.source, c.sourceWeight),
                    product(c.destination, c.destinationWeight));
}

int blendNv2a(const ChannelBlend& c) {
    const int asSigned = c.source < 128 ? c.source : c.source - 256;
    if (c.operation == SignedAdd) return c.destination + asSigned;
    if (c.operation == SignedReverseSubtract) return c.destination - asSigned;
    return blendIdeal(c, true, false);
}

/// What the PS2 multiplies an input by: ofCoefficient * C + ofOne.
struct GsShare {
    int ofCoefficient = 0, ofOne = 0;
    bool operator==(const GsShare&) const = default;
};

GsShare shareOf(const Weight& weight, int sign) {
    switch (weight.kind) {
        case Kind::Zero:
            return {};
        case Kind::One:
            return {0, sign};
        case Kind::Value:
            return {sign, 0};
        case Kind::Complement:
            return {-sign, sign};
    }
    return {};
}

/// The first setting of the PS2 that is what OpenGL asks for; all such settings have one value. None if it
/// needs two coefficients, or an input more often than A, B and D hold it.
std::optional<GsBlend> settingOf(const ChannelBlend& c) {
    using enum GsInput;
    const auto varies = [](const Weight& w) { return w.kind == Kind::Value || w.kind == Kind::Complement; };
    const Weight& varying = varies(c.sourceWeight) ? c.sourceWeight : c.destinationWeight;
    if (varies(c.sourceWeight) && varies(c.destinationWeight) &&
        (c.sourceWeight.value != c.destinationWeight.value ||
         c.sourceWeight.unit != c.destinationWeight.unit))
        return {};
    const int coefficient =
        varies(varying) ? (2 * varying.value * 128 + varying.unit) / (2 * varying.unit) : 128;
    const GsShare source = shareOf(c.sourceWeight, c.operation == ReverseSubtract ? -1 : 1);
    const GsShare destination = shareOf(c.destinationWeight, c.operation == Subtract ? -1 : 1);
    for (const GsInput a : {Source, Destination, Zero})
        for (const GsInput b : {Source, Destination, Zero})
            for (const GsInput d : {Source, Destination, Zero}) {
                const auto shareIn = [&](GsInput input) {
                    const int times = int(a == input) - int(b == input), once = int(d == input);
                    // A fixed coefficient of 1 is as good as no coefficient.
                    return varies(varying) ? GsShare{times, once} : GsShare{0, times + once};
                };
                if (shareIn(Source) == source && shareIn(Destination) == destination)
                    return GsBlend{a, b, coefficient, d};
            }
    return {};
}

bool isAlphaAndComplement(const ChannelBlend& c) {
    return c.sourceWeight.kind == Kind::Value && c.destinationWeight.kind == Kind::Complement &&
           c.sourceWeight.value == c.destinationWeight.value;
}

bool isOneAndOne(const ChannelBlend& c) {
    return c.sourceWeight.kind == Kind::One && c.destinationWeight.kind == Kind::One;
}

/// The chips with fixed multiplexers, as far as OpenGL can name their settings.
std::optional<int> blendFixed(BlendUnit unit, const ChannelBlend& c) {
    const int alpha = c.sourceWeight.value;
    switch (unit) {
        case BlendUnit::Gs:
        case BlendUnit::GsWrap: {
            const auto setting = settingOf(c);
            if (!setting) return {};
            return sumGs(*setting, c.source, c.destination);
        }
        case BlendUnit::Virge:
            if (!isAlphaAndComplement(c)) return {};
            return (c.source * alpha + c.destination * (255 - alpha)) / 255;
        case BlendUnit::Rdp:
            if (c.operation == AddWrap && isOneAndOne(c)) return blendRdp(c.source, 31, c.destination, 31);
            if (!isAlphaAndComplement(c)) return {};
            return blendRdp(c.source, alpha >> 3, c.destination, 31 - (alpha >> 3));
        case BlendUnit::Nv3:
            if (isOneAndOne(c)) return addNv3(c.source >> 3, c.destination >> 3) << 3;
            if (!isAlphaAndComplement(c)) return {};
            return blendNv3(c.source >> 3, c.destination >> 3, alpha >> 3) << 3;
        case BlendUnit::Ds:
            if (!isAlphaAndComplement(c)) return {};
            return blendDs(c.source >> 2, c.destination >> 2, alpha >> 3) << 2;
        case BlendUnit::Psx:
            if (!isOneAndOne(c)) return {};
            return blendPsx(c.operation == Add ? PsxBlend::Add : PsxBlend::Subtract, c.source >> 3,
                            c.destination >> 3)
                   << 3;
        default:
            return {};
    }
}

}  // namespace

BlendOperation operationOf(BlendEquation equation) {
    switch (equation) {
        case BlendEquation::Add:
            return Add;
        case BlendEquation::Subtract:
            return Subtract;
        case BlendEquation::ReverseSubtract:
            return ReverseSubtract;
        case BlendEquation::Min:
            return Min;
        case BlendEquation::Max:
            return Max;
        case BlendEquation::AddWrap:
            return AddWrap;
        case BlendEquation::SignedAdd:
            return SignedAdd;
        case BlendEquation::SignedReverseSubtract:
            return SignedReverseSubtract;
    }
    return Add;
}

bool hasOperation(BlendUnit unit, BlendOperation operation) {
    switch (unit) {
        case BlendUnit::IdealRound:
        case BlendUnit::IdealFloor:
            return operation <= Max || operation == AddWrap;
        case BlendUnit::ProductsRound:
        case BlendUnit::ProductsFloor:
            return operation <= Max;
        case BlendUnit::Nv2a:
            return operation <= SignedReverseSubtract;
        case BlendUnit::Ge:
            return operation <= Max || operation == AbsoluteDifference;
        case BlendUnit::Gs:
        case BlendUnit::GsWrap:
            return operation <= ReverseSubtract || operation == AddWrap;
        case BlendUnit::Rdp:
            return operation == Add || operation == AddWrap;
        case BlendUnit::Flipper:
        case BlendUnit::Psx:
            return operation == Add || operation == ReverseSubtract;
        default:
            return operation == Add;
    }
}

bool isConstant(BlendFactor factor) {
    return factor >= BlendFactor::ConstantColor && factor <= BlendFactor::OneMinusConstantAlpha;
}

bool isBeyondGs(BlendFactor factor) {
    switch (factor) {
        case BlendFactor::SrcColor:
        case BlendFactor::OneMinusSrcColor:
        case BlendFactor::DstColor:
        case BlendFactor::OneMinusDstColor:
        case BlendFactor::SrcAlphaSaturate:
        case BlendFactor::ConstantColor:
        case BlendFactor::OneMinusConstantColor:
            return true;
        default:
            return false;
    }
}

std::optional<int> blend(BlendUnit unit, const ChannelBlend& c) {
    const auto sum = blendUnclamped(unit, c);
    if (!sum) return {};
    return finished(unit, c.operation, *sum, c.most);
}

int finished(BlendUnit unit, BlendOperation operation, int sum, int most) {
    const bool wraps = operation == AddWrap || unit == BlendUnit::GsWrap;
    return wraps ? sum & most : std::clamp(sum, 0, most);
}

std::optional<int> blendUnclamped(BlendUnit unit, const ChannelBlend& c) {
    if (!hasOperation(unit, c.operation)) return {};
    if (c.operation == Min) return std::min(c.source, c.destination);
    if (c.operation == Max) return std::max(c.source, c.destination);
    if (c.operation == AbsoluteDifference) return std::abs(c.source - c.destination);
    switch (unit) {
        case BlendUnit::IdealRound:
        case BlendUnit::IdealFloor:
            return blendIdeal(c, unit == BlendUnit::IdealRound, false);
        case BlendUnit::ProductsRound:
        case BlendUnit::ProductsFloor:
            return blendIdeal(c, unit == BlendUnit::ProductsRound, true);
        case BlendUnit::VoodooMame:
            return blendVoodooMame(c);
        case BlendUnit::Voodoo86Box:
            return blendVoodoo86Box(c);
        case BlendUnit::Flipper:
            if (c.operation == ReverseSubtract) return c.destination - c.source;
            return blendPowerVr(c);
        case BlendUnit::PowerVr:
            return blendPowerVr(c);
        case BlendUnit::Ge:
            return blendGe(c);
        case BlendUnit::Nv2a:
            return blendNv2a(c);
        default:
            return blendFixed(unit, c);
    }
}

Weight weightOf(BlendUnit unit, BlendFactor factor, const Rgba& source, const Rgba& destination,
                const Rgba& constant, int channelIndex) {
    const auto channel = static_cast<std::size_t>(channelIndex);
    using enum BlendFactor;
    constexpr std::size_t kAlpha = 3;
    const int alphaUnit = isGs(unit) ? 128 : 255;
    switch (factor) {
        case Zero:
            return Weight::zero();
        case One:
            return Weight::one();
        case SrcColor:
            return Weight::of(source[channel]);
        case OneMinusSrcColor:
            return Weight::complement(source[channel]);
        case DstColor:
            return Weight::of(destination[channel]);
        case OneMinusDstColor:
            return Weight::complement(destination[channel]);
        case SrcAlpha:
            return Weight::of(source[kAlpha], alphaUnit);
        case OneMinusSrcAlpha:
            return Weight::complement(source[kAlpha], alphaUnit);
        case DstAlpha:
            return Weight::of(destination[kAlpha], alphaUnit);
        case OneMinusDstAlpha:
            return Weight::complement(destination[kAlpha], alphaUnit);
        case SrcAlphaSaturate: {
            if (channel == kAlpha) return Weight::one();
            const int whole = unit == BlendUnit::VoodooMame ? 256 : 255;
            return Weight::of(std::min(source[kAlpha], whole - destination[kAlpha]));
        }
        case ConstantColor:
            return Weight::of(constant[channel]);
        case OneMinusConstantColor:
            return Weight::complement(constant[channel]);
        case ConstantAlpha:
            return Weight::of(constant[kAlpha], alphaUnit);
        case OneMinusConstantAlpha:
            return Weight::complement(constant[kAlpha], alphaUnit);
    }
    return {};
}

std::optional<Rgba> blendPixelUnclamped(BlendUnit unit, const BlendState& state, const Rgba& source,
                                        const Rgba& destination) {
    if (isGs(unit) && (isBeyondGs(state.source) || isBeyondGs(state.destination))) return {};
    Rgba out{};
    for (std::size_t c = 0; c < out.size(); ++c) {
        const auto weight = [&](BlendFactor factor) {
            return weightOf(unit, factor, source, destination, state.constant, static_cast<int>(c));
        };
        const std::optional<int> value = blendUnclamped(unit, {.source = source[c],
                                                               .destination = destination[c],
                                                               .sourceWeight = weight(state.source),
                                                               .destinationWeight = weight(state.destination),
                                                               .operation = state.operation});
        if (!value) return {};
        out[c] = *value;
    }
    return out;
}

std::optional<Rgba> blendPixel(BlendUnit unit, const BlendState& state, const Rgba& source,
                               const Rgba& destination) {
    auto out = blendPixelUnclamped(unit, state, source, destination);
    if (out)
        for (int& value : *out) value = finished(unit, state.operation, value);
    return out;
}

int sumGs(const GsBlend& setting, int source, int destination) {
    const std::array inputs{source, destination, 0};
    const auto valueOf = [&](GsInput input) { return inputs[static_cast<std::size_t>(input)]; };
    return ((valueOf(setting.a) - valueOf(setting.b)) * setting.coefficient >> 7) + valueOf(setting.d);
}

int blendGs(const GsBlend& setting, int source, int destination, bool clamps) {
    const int sum = sumGs(setting, source, destination);
    return clamps ? std::clamp(sum, 0, 255) : sum & 255;
}

int modulateGs(int texel, int fragment) {
    return std::min(texel * fragment >> 7, 255);
}

int blendRdp(int p, int a, int m, int b) {
    return ((p * a + m * (b + 1)) >> 5) & 255;
}

int blendNv3(int source, int destination, int beta, bool sourceZero, bool destinationZero) {
    const int s = sourceZero ? 0 : source, d = destinationZero ? 0 : destination, f = beta >> 1;
    if (f == 15) return s;
    if (f == 0) return d;
    return (d * (16 - f) + s * f) >> 4;
}

int addNv3(int source, int destination) {
    return std::min(source + destination, 31);
}

int blendDs(int source, int destination, int alpha, bool drawn) {
    return drawn ? (source * (alpha + 1) + destination * (31 - alpha)) >> 5 : source;
}

int blendPsx(PsxBlend mode, int source, int destination) {
    switch (mode) {
        case PsxBlend::Average:
            return (destination + source) >> 1;
        case PsxBlend::Add:
            return std::min(destination + source, 31);
        case PsxBlend::Subtract:
            return std::max(destination - source, 0);
        case PsxBlend::AddQuarter:
            return std::min(destination + source / 4, 31);
    }
    return 0;
}

}  // namespace gnomon
