#pragma once

#include <glm/glm.hpp>
#include <span>

#include "scene/view.h"
#include "volume/volume.h"

namespace gnomon {

/// From which end of the eye ray a method counts.
enum class CountedFrom {
    Eye,       ///< fronts enter: sides, far cap and near cap, as with zpass-cap
    Infinity,  ///< backs enter: sides, far cap and light cap, as with zfail
};

/// How deep the volumes of one light can nest along the eye ray of any pixel: upper bounds, whatever surface
/// the ray ends at. Whether a method's count holds what the frame needs is a matter of these.
struct Nesting {
    int fronts = 0;     ///< faces of all volumes through which one ray enters
    int backs = 0;      ///< through which it leaves
    int ownFronts = 0;  ///< entries into one and the same volume
    int overlap = 0;    ///< volumes around one point; one that is folded over itself counts as often as it is
    /// The running count of a pixel while volumes are drawn one after another, entries before exits: those
    /// before it that hold the visible point, and all entries of the volume itself. What Roettger et al. 2002
    /// (section 4.2) must resolve.
    int levels = 0;
    bool operator==(const Nesting&) const = default;
};

/// The larger of each.
Nesting deepest(const Nesting& a, const Nesting& b);

/// Bounds for the volumes of @p lit in the window of @p view.
///
/// Never too small: the faces are those that are drawn, cut and rounded in the same way, and each counts for
/// all pixel centres within 1/256 pixel of it, which is as far as a rasteriser rounds its corners. (That a
/// sliver thinner than that can turn its back when it is rounded is left out.) Fronts, backs and ownFronts
/// are exact but for that margin: only where the outline of a volume passes within it of a centre can they be
/// too large. For overlap and levels, an exit counts only where it lies behind an entry for certain; they are
/// never more than fronts. A frame with more than some million crossings is not looked at that closely, and
/// both are its fronts.
///
/// @param lit     as of frameVolumes(), in drawing order
/// @param offset  as of CutStyle
Nesting nesting(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light, const View& view,
                CountedFrom from = CountedFrom::Eye, float offset = 0);

}  // namespace gnomon
