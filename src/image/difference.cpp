#include "image/difference.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace gnomon {

double meanSquaredDifference(const Image& picture, const Image& reference, const std::vector<bool>& leftOut) {
    assert(picture.width == reference.width && picture.height == reference.height);
    assert(picture.channels == reference.channels);
    Image held = picture;
    const auto channels = std::size_t(picture.channels);
    for (std::size_t i = 0; i < leftOut.size(); ++i)
        if (leftOut[i])
            std::copy_n(reference.data.begin() + std::ptrdiff_t(i * channels), channels,
                        held.data.begin() + std::ptrdiff_t(i * channels));

    const OIIO::ImageSpec spec(held.width, held.height, held.channels, OIIO::TypeDesc::UINT8);
    const auto bufferOf = [&](const Image& image) {
        return OIIO::ImageBuf(spec, const_cast<std::uint8_t*>(image.data.data()));
    };
    // One thread: the order of the sum stays the same.
    const auto compared =
        OIIO::ImageBufAlgo::compare(bufferOf(held), bufferOf(reference), 0, 0, OIIO::ROI::All(), 1);
    return compared.rms_error * compared.rms_error * 255 * 255;
}

double psnrOf(double meanSquare) {
    if (meanSquare == 0) return std::numeric_limits<double>::infinity();
    return 10 * std::log10(255.0 * 255.0 / meanSquare);
}

}  // namespace gnomon
