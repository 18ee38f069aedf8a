#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "image/image.h"
#include "predict/causes.h"

namespace gnomon {

/// Far from that of every other cause, and from the greys of the mask.
std::array<std::uint8_t, 3> colourOf(Cause cause);

/// The shadows that a frame shows, in pale greys, with every wrong pixel in the colour of its cause, and
/// below it a legend: colour, name and pixels of each cause, the most frequent first. Three channels; as wide
/// as the mask, or as the legend where that is wider.
///
/// @param mask    one channel; white lit, black in shadow
/// @param causes  by pixel of @p mask
Image causePicture(const Image& mask, const std::vector<Cause>& causes);

}  // namespace gnomon
