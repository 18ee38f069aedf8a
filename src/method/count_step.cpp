#include "method/count_step.h"

#include <algorithm>

namespace gnomon {

CountStep countStep(const Profile& profile, int bits, bool wraps) {
    const int step = 1 << (8 - bits);
    if (!wraps) return {step, step, 1};
    // Forced blending has a weight of 31/32 for the source.
    if (profile.blendUnit() == BlendUnit::Rdp)
        return bits == 5 ? CountStep{17, 248, 2} : CountStep{10, 255, 9};
    // 255 is -1 in 8 bits, and -1 code in fewer once the low bits are cut.
    return {step, 255, 1};
}

bool countWraps(const Axes& axes, const Profile& profile) {
    if (axes.overflow != Overflow::Either) return axes.overflow == Overflow::Wrap;
    if (axes.store == Store::Stencil) return profile.stencilWrap || axes.count == Count::AtomicZp;
    return axes.start == Start::Zero && profile.blendEquations.contains(BlendEquation::AddWrap);
}

CountRange countRange(const Axes& axes, const Profile& profile) {
    const bool stencil = axes.store == Store::Stencil;
    int bits = stencil ? profile.stencilBits : profile.alphaBits;
    if (axes.store == Store::Screen && !profile.colourFormats.empty()) {
        const ColourFormat& f = profile.colourFormats.front();
        bits = std::min({f.red, f.green, f.blue});
    }
    const bool wraps = countWraps(axes, profile);
    const int codes = stencil ? 1 : countStep(profile, bits, wraps).codes;
    // An odd step visits every code, one of two every other.
    const int values = (1 << bits) / (codes % 2 == 0 ? codes : 1);
    return {values, axes.start == Start::Middle ? values / 2 : 0, wraps};
}

bool countsAsShadow(int entries, int exits, const CountRange& range) {
    if (range.wraps) return (entries - exits) % range.values != 0;
    const int kept = std::min(range.start + entries, range.values - 1);
    return std::max(kept - exits, 0) != range.start;
}

}  // namespace gnomon
