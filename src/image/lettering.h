#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "image/image.h"

namespace gnomon {

using Rgb = std::array<std::uint8_t, 3>;

constexpr int kLetterWidth = 6, kLetterHeight = 9;  ///< of one letter with the space around it, pixels

/// Writes @p text into a picture of three channels, its upper left corner at (x, y). What lies outside of the
/// picture is left out; a letter that the alphabet lacks (it has a to z, digits, space, hyphen, comma, point)
/// is a box.
void writeText(Image& picture, int x, int y, const std::string& text, const Rgb& colour);

/// Fills a rectangle of a picture of three channels; what lies outside is left out.
void fillRectangle(Image& picture, int x, int y, int width, int height, const Rgb& colour);

}  // namespace gnomon
