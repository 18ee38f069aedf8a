#pragma once

#include <optional>
#include <string>
#include <vector>

#include "profile/frame_channel.h"

namespace gnomon {

/// How a crossing changes a mask: front faces (D) and back faces (H) of closed volumes, seen along one ray.
enum class MaskArithmetic : std::uint8_t {
    Double,  ///< D doubles, H halves; a shadow is brighter than the start (Roettger et al. 2002, 4.2)
    Halve,   ///< D halves, H doubles; a shadow is darker (4.4)
    Parity,  ///< both invert; a shadow is darker
    Count,   ///< D adds one step, H takes it away; a shadow is brighter
};

/// By what a chip draws it.
enum class MaskMeans : std::uint8_t {
    Blend,    ///< blending that clamps; to count, add and reverse_subtract
    AddWrap,  ///< count: two sums that wrap
    LogicOp,  ///< parity: the logic operation Invert
};

/// The order in which the crossings of one pixel are drawn. An eye inside a volume changes nothing: its near
/// cap (zpass-cap) or the faces behind the surface (zfail, where D is a back face) make the same sequences.
enum class DrawOrder : std::uint8_t {
    Volume,  ///< volume by volume, each convex, fronts before backs: DH, or D where the surface lies inside
    FrontsFirst,  ///< all fronts, then all backs; also one volume that isn't convex
    PerTriangle,  ///< any order
    NearerOnly,  ///< volume by volume, by zfail without a farther test: all faces, then the nearer ones taken
                 ///< back. DH, DHHD, or DHD where the surface lies inside
};

/// "double", "halve", "parity", "count"; "blend", "add_wrap", "logic_op"; "volume", "fronts-first",
/// "per-triangle", "nearer-only".
const std::string& name(MaskArithmetic);
const std::string& name(MaskMeans);
const std::string& name(DrawOrder);
constexpr int kMaskArithmetics = 4, kMaskMeans = 3, kDrawOrders = 4;

/// A claim to explore: one channel, over all cells of its dither matrix.
struct MaskClaim {
    FrameChannel channel{};  ///< its cell doesn't matter
    MaskArithmetic arithmetic = MaskArithmetic::Double;
    DrawOrder order = DrawOrder::Volume;
    MaskMeans means = MaskMeans::Blend;
    auto operator<=>(const MaskClaim&) const = default;
};

/// What a mask is set up with. Codes below the threshold are lit with double and count, shadow with halve and
/// parity.
struct MaskChoice {
    int start = 0;
    int half = 128;  ///< 127 or 128; of no effect where takesHalfConstant() is false
    int threshold = 0;
};

/// A pixel that is classified wrong: its crossings and the codes from the start on, one more than crossings.
struct Counterexample {
    std::string crossings{};  ///< "DDDHH"
    std::vector<int> codes{};
    int cell = 0;  ///< of the dither matrix
};

/// What holds for every sequence of crossings that the order allows.
struct MaskProof {
    MaskChoice choice{};
    /// The largest number of volumes open at one time with which every pixel is right, however many volumes
    /// there are; none: any.
    std::optional<int> depth = 0;
    /// The largest number of volumes on a ray with which every pixel is right, however they overlap; none:
    /// any.
    std::optional<int> volumes = 0;
    std::optional<Counterexample> counterexample{};  ///< a shortest; none if there is no wrong pixel
    /// If the code depends on the number of open volumes alone, whatever the order and however many were
    /// closed before: so many open ones make the start's code again. None if it doesn't.
    std::optional<int> period{};
    /// The best depth and number of volumes with the other constant for 1/2, whatever its start and
    /// threshold, if it reaches less; bestProof() only.
    struct Reach {
        std::optional<int> depth{}, volumes{};
    };
    std::optional<Reach> otherHalf{};
    /// Of the pixels within depth (or within volumes, if the depth is 0): what normalisation leaves, in
    /// codes, of light where there is shadow, and of darkness where there is none. None if the chip or the
    /// arithmetic has no normalisation by blending.
    std::optional<int> lightInShadow{}, darknessOutside{};
    /// The least and greatest code of a lit pixel after so many volumes one after the other, less the start.
    struct Drift {
        int volumes = 0, lowest = 0, highest = 0;
    };
    std::vector<Drift> drift{};
};

/// The most volumes that may be open at one time in the search: beyond any channel of 8 bits.
constexpr int kMostNesting = 260;

/// Whether the channel can draw @p arithmetic at all.
bool canDraw(const FrameChannel& channel, MaskArithmetic arithmetic, MaskMeans means = MaskMeans::Blend);

/// Whether a constant for 1/2 is part of the choice.
bool usesHalfConstant(const MaskClaim& claim);

/// Whether a shadow is at or above the threshold, and not below it.
bool shadowIsBright(MaskArithmetic arithmetic);

/// Codes that are good to start @p claim from, the cheapest first: with @p levels those next to 2^-levels
/// (double only), else all that could do.
std::vector<int> startsOf(const MaskClaim& claim, std::optional<int> levels);

/// Explores every reachable code exhaustively, breadth first over codes and open volumes.
/// @pre canDraw; the threshold is at most one above the largest code
MaskProof prove(const MaskClaim& claim, const MaskChoice& choice);

/// The best proof over @p starts, both constants for 1/2 and all thresholds: the largest depth, then the most
/// volumes, then the least residue. Of equal ones 128, the earliest start, and the middle threshold.
/// @pre canDraw; starts isn't empty
MaskProof bestProof(const MaskClaim& claim, const std::vector<int>& starts);

}  // namespace gnomon
