#pragma once

#include <optional>
#include <string>

#include "method/method.h"
#include "volume/nesting.h"

namespace gnomon {

/// How deep volumes may nest before a method's count is no longer to be trusted.
struct Capacity {
    /// What of Nesting mustn't exceed it.
    enum class Of { Nothing, Fronts, Overlap, Levels };
    Of of = Of::Nothing;   ///< Nothing: no nesting is too deep
    int most = 0;          ///< that it still holds
    std::string phrase{};  ///< "resolves 2 levels"
};

/// The capacity of @p axes on @p profile, by what its store does beyond its range:
///
///   a count that saturates        fronts: entries are counted before exits, and what is cut off is lost
///   a count that wraps            overlap: only a net count of a multiple of its values reads as none
///   Double, Halve                 levels: volumes are drawn one at a time, and the running count is clamped
///   Parity in colour or alpha     overlap: a stencil keeps volumes apart from each other
///
/// A count that starts above 0 (Bias, ++zp, atomiczp) is taken as one with a near cap.
///
/// @param doubled  as in countStep()
Capacity capacity(const Axes& axes, const Profile& profile, bool doubled);

/// From which end of the eye ray the method counts.
CountedFrom countedFrom(const Axes& axes);

/// What to warn of where volumes may nest deeper than a method holds: "resolves 2 levels; up to 4 volumes or
/// fronts may nest". Nothing where they can't.
std::optional<std::string> nestingWarning(const Capacity& capacity, const Nesting& nesting);

}  // namespace gnomon
