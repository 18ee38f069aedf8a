#include "gl/buffer_format.h"

namespace gnomon {

BufferFormat bufferFormatOf(const Profile& profile) {
    const ColourFormat& c = profile.colourFormats.front();
    BufferFormat format{.red = c.red, .green = c.green, .blue = c.blue, .alpha = c.alpha};
    if (profile.alphaExcludesDepth) format.alpha = 0;
    format.depth = profile.depthBits.empty() ? 0 : profile.depthBits.front();
    format.stencil = profile.stencilBits;
    return format;
}

}  // namespace gnomon
