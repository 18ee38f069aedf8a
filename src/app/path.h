#pragma once

#include <string>

#include "matrix/lab.h"

namespace gnomon {

/// The path that a chip takes when no method is named, in words: which, and why the ones before it fell out.
/// @return the axes of the path; nothing if the chip can run none, then @p words says why
std::optional<Axes> choosePath(Lab& lab, const Profile& profile, Shade shade, int width, int height,
                               int frame, std::string& words);

}  // namespace gnomon
