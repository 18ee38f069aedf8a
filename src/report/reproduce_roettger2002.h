#pragma once

#include <string>
#include <vector>

#include "matrix/cell.h"
#include "report/listings.h"

namespace gnomon {

/// One figure of a paper beside the same figure of ours.
struct Comparison {
    std::string buffer{}, shade{};  ///< "alpha", "attenuated"
    bool maximum = false;           ///< with the maximum blend equation: the figures in brackets
    int publishedScene = 0, publishedRectangles = 0;
    Axes axes{};
    PassCounts counted{}, planned{};  ///< at the capability layer; the plan's length

    bool agrees() const;
};

/// The rows of Table 1 of Roettger et al. 2002, without our figures: passes that draw the scene, and
/// rectangles over the whole window.
std::vector<Comparison> roettgerTable1();

std::string showComparisons(const std::vector<Comparison>& rows, Format format);

}  // namespace gnomon
