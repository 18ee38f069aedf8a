#pragma once

#include <cstdint>
#include <vector>

namespace gnomon {

constexpr std::int64_t kNoDistance = INT64_MAX;

/// By pixel of a picture: the squared Euclidean distance, in pixels, from its centre to the nearest centre of
/// the pixels that @p isIn holds; 0 for these themselves, kNoDistance everywhere if there are none. Exact.
///
/// @pre isIn has width * height entries, row by row; sides are at most 2^20
///
/// Source: Meijster, Roerdink, Hesselink 2000, A General Algorithm for Computing Distance Transforms in
/// Linear Time (columns first; then in each row the lower envelope of one parabola per column).
std::vector<std::int64_t> squaredDistances(const std::vector<bool>& isIn, int width, int height);

}  // namespace gnomon
