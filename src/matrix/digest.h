#pragma once

#include <string>

#include "gl/renderer.h"

namespace gnomon {

/// Over the masks and the image of a frame: 16 hexadecimal digits (FNV-1a of 64 bits).
std::string digestOf(const Rendered& rendered);

}  // namespace gnomon
