#pragma once

#include <limits>

namespace gnomon {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace gnomon
