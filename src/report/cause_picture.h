#pragma once

#include <vector>

#include "image/image.h"
#include "predict/causes.h"

namespace gnomon {

/// The shadows that a frame shows, in pale greys, with every wrong pixel in the colour of its cause, and
/// below it a legend: colour, name and pixels of each cause, the most frequent first. Three channels; as wide
/// as the mask, or as the legend where that is wider.
///
/// @param mask    one channel; white lit, black in shadow
/// @param causes  by pixel of @p mask
Image causePicture(const Image& mask, const std::vector<Cause>& causes);

}  // namespace gnomon
