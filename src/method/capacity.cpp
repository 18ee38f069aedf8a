#include "method/capacity.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "method/count_step.h"

namespace gnomon {
namespace {

const char* placeOf(Store store) {
    return store == Store::Stencil ? "stencil" : store == Store::Alpha ? "alpha" : "colour buffer";
}

int maskBits(const Axes& axes, const Profile& profile) {
    if (axes.store == Store::Alpha || profile.colourFormats.empty()) return profile.alphaBits;
    const ColourFormat& f = profile.colourFormats.front();
    return std::min({f.red, f.green, f.blue});
}

Capacity ofCount(const Axes& axes, const Profile& profile, bool doubled) {
    using enum Capacity::Of;
    if (axes.store == Store::Counter) return {Overlap, (1 << 16) - 1, "counts 65535 in 16 bits and wraps"};
    const CountRange range = countRange(axes, profile, doubled);
    const char* place = placeOf(axes.store);
    if (range.wraps) {
        const int values = range.largest + 1;
        const int most = values / std::gcd(values, range.step) - 1;
        return {Overlap, most, fmt::format("counts {} in the {} and wraps", most, place)};
    }
    const int most = (range.largest - range.start) / range.step;
    return {Fronts, most, fmt::format("counts {} in the {} and saturates", most, place)};
}

std::string levels(int count) {
    return fmt::format("{} level{}", count, count == 1 ? "" : "s");
}

}  // namespace

Capacity capacity(const Axes& axes, const Profile& profile, bool doubled) {
    using enum Capacity::Of;
    if (axes.store == Store::None || axes.store == Store::DepthMap) return {};
    switch (axes.arithmetic) {
        case Arithmetic::Count:
            return ofCount(axes, profile, doubled);
        case Arithmetic::Double:
            return {Levels, axes.levels, fmt::format("resolves {}", levels(axes.levels))};
        case Arithmetic::Halve: {
            const int bits = maskBits(axes, profile);
            return {Levels, bits, fmt::format("resolves {} in {} bits", levels(bits), bits)};
        }
        case Arithmetic::Parity:
            if (axes.store == Store::Stencil) return {};
            return {Overlap, 1, "tells one volume from none"};
    }
    return {};
}

CountedFrom countedFrom(const Axes& axes) {
    return axes.count == Count::Zfail ? CountedFrom::Infinity : CountedFrom::Eye;
}

std::optional<std::string> nestingWarning(const Capacity& capacity, const Nesting& nesting) {
    using enum Capacity::Of;
    const int deepest = capacity.of == Fronts    ? nesting.fronts
                        : capacity.of == Overlap ? nesting.overlap
                        : capacity.of == Levels  ? nesting.levels
                                                 : 0;
    if (capacity.of == Nothing || deepest <= capacity.most) return std::nullopt;
    const char* what = capacity.of == Fronts    ? "fronts may lie on an eye ray"
                       : capacity.of == Overlap ? "volumes may overlap"
                                                : "volumes or fronts may nest";
    return fmt::format("{}; up to {} {}", capacity.phrase, deepest, what);
}

}  // namespace gnomon
