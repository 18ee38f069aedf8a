#include "method/count_step.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "profile/frame_channel.h"

namespace gnomon {
namespace {

constexpr int kMostDoublings = 16;

/// Doublings of @p code until it is the largest, on the chip's own unit; nothing if it never is.
std::optional<int> doublingsOf(BlendUnit unit, int bits, int code) {
    for (int n = 0; n <= kMostDoublings; ++n) {
        if (code == largestCode(bits)) return n;
        const auto twice = apply({.unit = unit, .bits = bits}, MaskOperation::Double, code);
        if (!twice) return std::nullopt;
        code = *twice;
    }
    return std::nullopt;
}

std::vector<BlendUnit> unitsOf(const Profile& profile) {
    return profile.blendUnits.empty() ? std::vector{profile.blendUnit()} : profile.blendUnits;
}

/// Codes of a step that each of the profile's units doubles to the largest code; 1 if there is none.
int doubledCodes(const Profile& profile, int bits) {
    const std::vector<BlendUnit> units = unitsOf(profile);
    for (const int codes : {1, 2})
        if (std::all_of(units.begin(), units.end(),
                        [&](BlendUnit unit) { return doublingsOf(unit, bits, codes).has_value(); }))
            return codes;
    return 1;
}

}  // namespace

CountStep countStep(const Profile& profile, int bits, bool wraps, bool doubled) {
    const int one = 1 << (8 - bits);
    // Forced blending has a weight of 31/32 for the source.
    if (wraps && profile.blendUnit() == BlendUnit::Rdp)
        return bits == 5 ? CountStep{17, 248, 2} : CountStep{10, 255, 9};
    const int codes = doubled && bits > 1 ? doubledCodes(profile, bits) : 1;
    if (wraps && codes > 1) return {codes * one, 256 - codes * one, codes};
    // 255 is -1 in 8 bits, and -1 code in fewer once the low bits are cut.
    return wraps ? CountStep{one, 255, 1} : CountStep{codes * one, codes * one, codes};
}

int countDoublings(const Profile& profile, int bits) {
    if (bits == 0) return 0;  // the chip is refused, but its plan is made
    int most = bits;
    for (const BlendUnit unit : unitsOf(profile))
        most = std::max(most, doublingsOf(unit, bits, doubledCodes(profile, bits)).value_or(0));
    return most;
}

bool countWraps(const Axes& axes, const Profile& profile) {
    if (axes.overflow != Overflow::Either) return axes.overflow == Overflow::Wrap;
    if (axes.store == Store::Stencil) return profile.stencilWrap || axes.count == Count::AtomicZp;
    return axes.start == Start::Zero && profile.blendEquations.contains(BlendEquation::AddWrap);
}

CountRange countRange(const Axes& axes, const Profile& profile, bool doubled) {
    const bool stencil = axes.store == Store::Stencil;
    int bits = stencil ? profile.stencilBits : profile.alphaBits;
    if (axes.store == Store::Screen && !profile.colourFormats.empty()) {
        const ColourFormat& f = profile.colourFormats.front();
        bits = std::min({f.red, f.green, f.blue});
    }
    const bool wraps = countWraps(axes, profile);
    const int largest = largestCode(std::max(bits, 1));
    return {.largest = largest,
            .start = axes.start == Start::Middle ? (largest + 1) / 2 : 0,
            .step = stencil ? 1 : countStep(profile, std::max(bits, 1), wraps, doubled).codes,
            .wraps = wraps};
}

bool countsAsShadow(int entries, int exits, const CountRange& range) {
    const int up = range.step * entries, down = range.step * exits;
    if (range.wraps) return (up - down) % (range.largest + 1) != 0;
    return std::max(std::min(range.start + up, range.largest) - down, 0) != range.start;
}

}  // namespace gnomon
