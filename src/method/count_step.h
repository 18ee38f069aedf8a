#pragma once

#include "method/method.h"

namespace gnomon {

/// What one face adds to a channel that counts, and takes from it: source values of 8 bits.
struct CountStep {
    int up = 1;
    int down = 1;   ///< subtracted; where the sum wraps, added
    int codes = 1;  ///< of the frame buffer that a step is
    bool operator==(const CountStep&) const = default;
};

/// The smallest step of a channel of @p bits on @p profile that goes up and down by the same codes whatever
/// the channel holds: one code, but two in 5 bits of the N64 and nine in 8, where a step of one down is
/// beyond the blend unit.
///
/// @param doubled  the count will be doubled to 0 or 1: two codes where one would stay one (GameCube: 2v - 1)
///
/// Source: hardware.md 4.3 (PS2: PS2TEK; GameCube: DOLPHIN; N64: ANGRY), by enumeration; the N64's 8 bits
/// enumerated here, from the formula of 2.10. For the N64's step down any of 248..255 will do; 248 is two
/// codes to a blender that rounds as well.
CountStep countStep(const Profile& profile, int bits, bool wraps, bool doubled);

/// How often a step must be doubled until it is the largest code of @p bits, whichever of the profile's blend
/// units it is, and for OpenGL's blending: at least @p bits times.
int countDoublings(const Profile& profile, int bits);

/// Whether a count wraps, rather than clamps. Where the overflow is either, it wraps if the chip can: then
/// only a net depth of a multiple of the channel's values fools it, in whatever order volumes come; clamping
/// loses counts as soon as more fronts than that lie on one ray. In a colour or alpha buffer one that starts
/// in the middle is there to clamp.
bool countWraps(const Axes& axes, const Profile& profile);

/// How far a count goes before it clamps or wraps, in codes.
struct CountRange {
    int largest = 255;
    int start = 0;
    int step = 1;
    bool wraps = false;
};

/// The range of a count in stencil, colour or alpha.
/// @param doubled  as in countStep()
/// @pre axes.arithmetic is Count and the store is one of these
CountRange countRange(const Axes& axes, const Profile& profile, bool doubled);

/// Whether a pixel with so many entries, and then so many exits, ends where it did not start.
bool countsAsShadow(int entries, int exits, const CountRange& range);

}  // namespace gnomon
