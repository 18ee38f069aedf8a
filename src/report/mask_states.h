#pragma once

#include <string>
#include <vector>

#include "matrix/cell.h"
#include "profile/prove.h"
#include "report/run_pictures.h"

namespace gnomon {

/// A value of the mask that crossings can come to, from the start on.
struct MaskState {
    int code = 0;
    bool isStart = false;
    bool isLit = false, isShadow = false;  ///< both: a value that tells nothing
};

/// What a front or back face makes of a value.
struct MaskStep {
    int from = 0, to = 0;
    bool isFront = true;
    bool operator==(const MaskStep&) const = default;
};

/// The states of a mask and how crossings move between them (figures 2 and 5 of Roettger et al. 2002).
struct MaskStates {
    std::string profile{}, method{};
    MaskArithmetic arithmetic = MaskArithmetic::Double;
    std::string title{};  ///< the channel and the order of faces
    std::vector<MaskState> states{};
    std::vector<MaskStep> steps{};
};

/// "start", "lit", "in shadow", "lit or in shadow".
std::string meaning(const MaskState& state);
/// "front face doubles", "back face halves", or the other way round.
std::string meaning(const MaskStep& step, const MaskStates& graph);

/// All that @p claim reaches from @p start, fronts before backs of one volume after the other, with up to @p
/// open volumes open at one time.
/// @pre the channel can draw the claim and has no dither matrix
MaskStates maskStates(const MaskClaim& claim, const MaskChoice& choice, int open);

/// The graphs of the methods of a run that double or halve in colour or alpha, each once: with the first chip
/// and method that has it.
std::vector<MaskStates> statesOf(const std::vector<Cell>& cells, const RunSources& sources);

}  // namespace gnomon
