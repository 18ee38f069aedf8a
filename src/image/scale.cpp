#include "image/scale.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace gnomon {
namespace {

/// Which old pixels a new one covers, and how much of each: the axis is cut into @p from * @p to parts, of
/// which an old pixel has @p to and a new one @p from.
struct Cover {
    int first = 0, last = 0;

    static std::int64_t part(int old, int at, int from, int to) {
        const std::int64_t begin = std::max(std::int64_t(old) * to, std::int64_t(at) * from);
        const std::int64_t end = std::min(std::int64_t(old + 1) * to, std::int64_t(at + 1) * from);
        return end - begin;
    }
};

Cover coverOf(int at, int from, int to) {
    return {int(std::int64_t(at) * from / to), int((std::int64_t(at + 1) * from - 1) / to)};
}

/// Puts @p image into a picture of three channels, its upper left corner at (x, 0).
void paste(Image& picture, const Image& image, int x) {
    assert(image.channels == 1 || image.channels >= 3);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const std::size_t from = (std::size_t(row) * image.width + column) * image.channels;
            const std::size_t to = (std::size_t(row) * picture.width + x + column) * 3;
            for (int c = 0; c < 3; ++c)
                picture.data[to + c] = image.data[from + (image.channels == 1 ? 0 : c)];
        }
}

}  // namespace

Image scaledDown(const Image& image, int width, int height) {
    assert(width >= 1 && height >= 1 && width <= image.width && height <= image.height);
    Image small{width, height, image.channels, {}};
    small.data.reserve(std::size_t(width) * height * image.channels);
    const std::int64_t all = std::int64_t(image.width) * image.height;
    for (int y = 0; y < height; ++y) {
        const Cover rows = coverOf(y, image.height, height);
        for (int x = 0; x < width; ++x) {
            const Cover columns = coverOf(x, image.width, width);
            for (int c = 0; c < image.channels; ++c) {
                std::int64_t sum = 0;
                for (int j = rows.first; j <= rows.last; ++j) {
                    const std::int64_t high = Cover::part(j, y, image.height, height);
                    for (int i = columns.first; i <= columns.last; ++i)
                        sum += high * Cover::part(i, x, image.width, width) *
                               image.data[(std::size_t(j) * image.width + i) * image.channels + c];
                }
                small.data.push_back(std::uint8_t((sum + all / 2) / all));
            }
        }
    }
    return small;
}

Image fitted(const Image& image, int width) {
    assert(width >= 1);
    if (image.width <= width) return image;
    const std::int64_t height = (std::int64_t(image.height) * width + image.width / 2) / image.width;
    return scaledDown(image, width, int(std::max<std::int64_t>(1, height)));
}

Image beside(const Image& left, const Image& right, int gap) {
    Image both{left.width + gap + right.width, std::max(left.height, right.height), 3, {}};
    both.data.resize(std::size_t(both.width) * both.height * 3);
    paste(both, left, 0);
    paste(both, right, left.width + gap);
    return both;
}

}  // namespace gnomon
