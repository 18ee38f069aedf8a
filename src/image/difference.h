#pragma once

#include <vector>

#include "image/image.h"

namespace gnomon {

/// Mean squared difference of all channels of two pictures, of values 0..255.
/// @param leftOut  by pixel: counts as the same; empty: none is left out
/// @pre the same width, height and channels
double meanSquaredDifference(const Image& picture, const Image& reference,
                             const std::vector<bool>& leftOut = {});

/// Peak signal-to-noise ratio, dB, of that mean: 10 log10(255^2 / mean); infinite for 0.
double psnrOf(double meanSquare);

}  // namespace gnomon
