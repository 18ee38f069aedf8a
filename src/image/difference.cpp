#include "image/difference.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

namespace gnomon {

double meanSquaredDifference(const Image& picture, const Image& reference, const std::vector<bool>& leftOut) {
    assert(picture.width == reference.width && picture.height == reference.height);
    assert(picture.channels == reference.channels);
    const auto channels = std::size_t(picture.channels);
    std::uint64_t squares = 0;
    for (std::size_t i = 0; i < picture.data.size(); ++i) {
        if (!leftOut.empty() && leftOut[i / channels]) continue;
        const int difference = picture.data[i] - reference.data[i];
        squares += std::uint64_t(difference * difference);
    }
    return double(squares) / double(picture.data.size());
}

double psnrOf(double meanSquare) {
    if (meanSquare == 0) return std::numeric_limits<double>::infinity();
    return 10 * std::log10(255.0 * 255.0 / meanSquare);
}

}  // namespace gnomon
