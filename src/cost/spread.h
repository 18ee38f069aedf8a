#pragma once

#include <span>
#include <vector>

namespace gnomon {

/// What is said of a figure that was measured several times.
struct Spread {
    double median = 0;
    double low = 0, high = 0;  ///< quartiles
};

/// All 0 of no figures. Between two of them quartiles and medians are interpolated.
Spread spreadOf(std::vector<double> figures);

/// By repetition: @p part / @p whole, both measured in the same round.
/// @pre as many of both
std::vector<double> ratios(std::span<const double> part, std::span<const double> whole);

}  // namespace gnomon
