#include "image/half_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon {
namespace {

using Levels = std::array<int, 3>;

Levels colourAt(const Image& image, int x, int y) {
    assert(image.channels == 1 || image.channels >= 3);
    const std::uint8_t* pixel = &image.data[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) *
                                            std::size_t(image.channels)];
    return image.channels == 1 ? Levels{pixel[0], pixel[0], pixel[0]} : Levels{pixel[0], pixel[1], pixel[2]};
}

/// 0 to 255, with the weights of ITU-R BT.601 in thousandths.
int luma(const Levels& c) {
    return (299 * c[0] + 587 * c[1] + 114 * c[2] + 500) / 1000;
}

}  // namespace

std::string halfBlocks(const Image& image) {
    std::string text;
    for (int y = 0; y < image.height; y += 2) {
        // What is set is not set again.
        std::optional<Levels> front, back;
        for (int x = 0; x < image.width; ++x) {
            const Levels above = colourAt(image, x, y);
            if (front != above) text += fmt::format("\x1b[38;2;{};{};{}m", above[0], above[1], above[2]);
            front = above;
            if (y + 1 < image.height) {
                const Levels below = colourAt(image, x, y + 1);
                if (back != below) text += fmt::format("\x1b[48;2;{};{};{}m", below[0], below[1], below[2]);
                back = below;
            }
            text += "\u2580";
        }
        text += "\x1b[0m\n";
    }
    return text;
}

std::string letterPicture(const Image& image) {
    // From light to dark.
    constexpr std::string_view kLetters = " .:-=+*#%@";
    std::vector<int> means;
    for (int y = 0; y < image.height; y += 2)
        for (int x = 0; x < image.width; ++x) {
            const int above = luma(colourAt(image, x, y));
            means.push_back(y + 1 < image.height ? (above + luma(colourAt(image, x, y + 1)) + 1) / 2 : above);
        }
    if (means.empty()) return {};
    // What the picture has of light and dark is spread over all letters; one shade stays what it is.
    const auto [low, high] = std::minmax_element(means.begin(), means.end());
    const int dark = *low < *high ? *low : 0, light = *low < *high ? *high : 255;

    std::string text;
    for (std::size_t at = 0; at < means.size();) {
        std::string line;
        for (int x = 0; x < image.width; ++x, ++at)
            line +=
                kLetters[std::size_t(light - means[at]) * kLetters.size() / std::size_t(light - dark + 1)];
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

}  // namespace gnomon
