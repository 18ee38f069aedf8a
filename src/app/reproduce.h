#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/listings.h"

namespace gnomon {

/// What `gnomon reproduce` was asked for, besides the paper.
struct ReproduceOptions {
    std::optional<int> table{};  ///< none: all of the paper's
    Format format = Format::Text;
    bool measures = false;  ///< time what is only modelled on this machine too

    bool wants(int number) const { return !table || *table == number; }
};

/// A paper whose figures are reproduced.
struct ReproducedPaper {
    std::string id{};           ///< "roettger2002"
    std::vector<int> tables{};  ///< numbers in the paper; empty: it is taken as a whole
    /// Prints the figures, published beside ours.
    /// @return the exit status: 1 if a figure that must agree differs
    int (*run)(const ReproduceOptions&) = nullptr;
};

// Each in a file of its own, src/app/reproduce_<paper>.cpp.
int reproduceRoettger2002(const ReproduceOptions& options);

}  // namespace gnomon
