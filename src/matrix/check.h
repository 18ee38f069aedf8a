#pragma once

#include <string>
#include <vector>

#include "matrix/expectations.h"

namespace gnomon {

/// A cell held against what was expected of it.
enum class CheckClass {
    Expected,
    Unexpected,  ///< worse than expected, or otherwise wrong
    Improved,    ///< fewer wrong pixels than expected, or none
    Missing,     ///< expected, but not in the run
    Flaky,       ///< not the same in all repetitions: always a defect, since results are deterministic
};
constexpr int kCheckClasses = 5;

const std::string& name(CheckClass);

struct CheckedCell {
    CheckClass what{};
    std::string place{};  ///< placeOf()
    std::string expected{}, found{};
    std::string why{};  ///< the reason that stands in the file; "" without one
    Cell cell{};        ///< of the first repetition; blank if Missing
};

struct CheckResult {
    std::vector<CheckedCell> cells{};  ///< in the run's order, then those that are missing
    std::size_t outside = 0;           ///< lines of the file that are not in this choice

    std::size_t count(CheckClass) const;
    /// Whether every cell is as expected.
    bool isGood() const;
};

/// @param runs     repetitions of one run
/// @param isWhole  the run is the file's own choice, so that each of its lines must be there
CheckResult checkCells(const Expectations& expectations, const std::vector<std::vector<Cell>>& runs,
                       bool isWhole);

}  // namespace gnomon
