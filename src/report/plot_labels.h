#pragma once

#include <vector>

namespace gnomon {

/// An upright rectangle, y downwards.
struct PlotBox {
    double x = 0, y = 0, width = 0, height = 0;

    double overlap(const PlotBox& other) const;  ///< area
};

/// A text that wants to stand beside a point.
struct PlotLabel {
    double x = 0, y = 0;  ///< of the point
    double width = 0, height = 0;
};

/// Where each label stands: as near to its point as leaves it free of @p obstacles, of the labels before it
/// and of the outside of @p within. Where no place is free, the one with the least overlap.
std::vector<PlotBox> placeLabels(const std::vector<PlotLabel>& labels, std::vector<PlotBox> obstacles,
                                 const PlotBox& within);

}  // namespace gnomon
