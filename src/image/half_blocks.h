#pragma once

#include <string>

#include "image/image.h"

namespace gnomon {

/// @p image for a terminal with colours of 24 bits: a character for every two pixels, one above the other, as
/// an upper half block in the colour of the first on the colour of the second. Each line ends in the
/// terminal's own colours; the lower half of a last odd row has its background.
/// @pre one or at least three channels; one is taken for grey, alpha is left out
std::string halfBlocks(const Image& image);

/// @p image for a page of dark letters on a light ground: a letter for every two pixels, the denser the
/// darker, spread over what light the picture has. Blanks at line ends are left out.
/// @pre as for halfBlocks()
std::string letterPicture(const Image& image);

}  // namespace gnomon
