#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "image/image.h"

namespace gnomon {

/// At most @p most colours for the pixels of @p image: all of them where they are no more, else those of a
/// median cut (Heckbert, Color image quantization for frame buffer display, SIGGRAPH 1982). The same for the
/// same image.
/// @pre one or at least three channels; one is taken for grey, alpha is left out
std::vector<std::array<std::uint8_t, 3>> paletteOf(const Image& image, std::size_t most = 256);

/// @p image as sixel graphics of at most 256 colours, a device control string of DEC terminals (DEC,
/// VT330/VT340 Programmer Reference Manual, volume 2, chapter 14). Colours are whole percents.
/// @pre as for paletteOf()
std::string sixel(const Image& image);

}  // namespace gnomon
