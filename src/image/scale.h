#pragma once

#include "image/image.h"

namespace gnomon {

/// @p image with every new pixel the mean of the area that it covers, in whole numbers, rounded to the
/// nearest. Values are averaged as they are, without regard to gamma.
/// @pre 1 <= width <= image.width, 1 <= height <= image.height
Image scaledDown(const Image& image, int width, int height);

/// @p image if it is at most @p width wide, else scaled down to that width with its aspect kept.
/// @pre width >= 1
Image fitted(const Image& image, int width);

/// Both images side by side in three channels, @p right at the right with @p gap black columns between them,
/// the shorter one with black below.
/// @pre one or at least three channels each; one is taken for grey, alpha is left out
Image beside(const Image& left, const Image& right, int gap = 0);

}  // namespace gnomon
