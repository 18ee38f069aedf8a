#pragma once

#include <cstddef>
#include <functional>

namespace gnomon {

/// How far a run is, in its own unit: cells, methods, frames.
struct Progress {
    std::size_t done = 0, all = 0;
    std::size_t failures = 0;  ///< of those done

    bool operator==(const Progress&) const = default;
};

/// Is told of each step, the start included.
using ProgressListener = std::function<void(const Progress&)>;

}  // namespace gnomon
