#pragma once

#include <compare>

#include "profile/profile.h"

namespace gnomon {

/// The buffers of a drawing surface, in bits; a chip's own formats, nothing that it lacks.
struct BufferFormat {
    int red = 8, green = 8, blue = 8, alpha = 8;
    int depth = 24;
    int stencil = 8;
    auto operator<=>(const BufferFormat&) const = default;
};

/// The buffers that @p profile gets: its first colour format and depth; destination alpha only where it does
/// not exclude depth.
BufferFormat bufferFormatOf(const Profile& profile);

}  // namespace gnomon
