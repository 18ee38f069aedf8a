#include "image/sixel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <set>

namespace gnomon {
namespace {

using Colour = std::array<std::uint8_t, 3>;

std::vector<Colour> coloursOf(const Image& image) {
    assert(image.channels == 1 || image.channels >= 3);
    std::vector<Colour> colours;
    for (std::size_t i = 0; i + image.channels <= image.data.size(); i += std::size_t(image.channels)) {
        const std::uint8_t* p = &image.data[i];
        colours.push_back(image.channels == 1 ? Colour{p[0], p[0], p[0]} : Colour{p[0], p[1], p[2]});
    }
    return colours;
}

struct Counted {
    Colour colour{};
    long long pixels = 0;
};

/// Some of the colours, to be one in the palette.
struct Box {
    std::vector<Counted> colours{};

    /// The channel in which its colours lie farthest apart, and how far.
    std::pair<int, std::size_t> widest() const {
        std::pair<int, std::size_t> best{-1, 0};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto [low, high] = std::minmax_element(
                colours.begin(), colours.end(),
                [&](const Counted& a, const Counted& b) { return a.colour[c] < b.colour[c]; });
            best = std::max(best, {high->colour[c] - low->colour[c], 2 - c});
        }
        return {best.first, 2 - best.second};
    }

    long long pixels() const {
        long long sum = 0;
        for (const Counted& c : colours) sum += c.pixels;
        return sum;
    }

    Colour mean() const {
        Colour mean{};
        const long long all = pixels();
        for (std::size_t c = 0; c < 3; ++c) {
            long long sum = 0;
            for (const Counted& one : colours) sum += one.pixels * one.colour[c];
            mean[c] = std::uint8_t((sum + all / 2) / all);
        }
        return mean;
    }

    /// Takes the half of its pixels away that is higher in the widest channel.
    Box split() {
        const std::size_t channel = widest().second;
        std::sort(colours.begin(), colours.end(), [&](const Counted& a, const Counted& b) {
            return std::pair(a.colour[channel], a.colour) < std::pair(b.colour[channel], b.colour);
        });
        const long long half = pixels() / 2;
        std::size_t at = 1;
        for (long long sum = colours[0].pixels; at + 1 < colours.size() && sum < half; ++at)
            sum += colours[at].pixels;
        Box upper;
        upper.colours.assign(colours.begin() + std::ptrdiff_t(at), colours.end());
        colours.resize(at);
        return upper;
    }
};

std::size_t nearest(const std::vector<Colour>& palette, const Colour& colour) {
    std::size_t best = 0;
    int least = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < palette.size(); ++i) {
        int distance = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const int apart = int(palette[i][c]) - colour[c];
            distance += apart * apart;
        }
        if (distance < least) least = distance, best = i;
    }
    return best;
}

int percentOf(std::uint8_t value) {
    return (value * 100 + 127) / 255;
}

/// @p count times the six pixels of @p bits.
std::string run(int count, int bits) {
    const char letter = char('?' + bits);
    return count > 3 ? fmt::format("!{}{}", count, letter) : std::string(std::size_t(count), letter);
}

}  // namespace

std::vector<Colour> paletteOf(const Image& image, std::size_t most) {
    std::map<Colour, long long> counts;
    for (const Colour& colour : coloursOf(image)) ++counts[colour];
    std::vector<Colour> palette;
    if (counts.size() <= most) {
        for (const auto& [colour, pixels] : counts) palette.push_back(colour);
        return palette;
    }
    std::vector<Box> boxes(1);
    for (const auto& [colour, pixels] : counts) boxes[0].colours.push_back({colour, pixels});
    while (boxes.size() < most) {
        const auto box = std::max_element(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
            const auto worth = [](const Box& one) { return one.pixels() * one.widest().first; };
            return worth(a) < worth(b);
        });
        if (box->colours.size() < 2) break;
        Box upper = box->split();
        boxes.push_back(std::move(upper));
    }
    for (const Box& box : boxes) palette.push_back(box.mean());
    std::sort(palette.begin(), palette.end());
    palette.erase(std::unique(palette.begin(), palette.end()), palette.end());
    return palette;
}

std::string sixel(const Image& image) {
    const std::vector<Colour> palette = paletteOf(image), colours = coloursOf(image);
    std::map<Colour, std::size_t> known;
    std::vector<std::size_t> pixels;
    for (const Colour& colour : colours) {
        auto at = known.find(colour);
        if (at == known.end()) at = known.emplace(colour, nearest(palette, colour)).first;
        pixels.push_back(at->second);
    }

    // Square pixels, pixels that are not drawn keep what is there.
    std::string text = fmt::format("\x1bP0;1q\"1;1;{};{}", image.width, image.height);
    for (std::size_t i = 0; i < palette.size(); ++i)
        text += fmt::format("#{};2;{};{};{}", i, percentOf(palette[i][0]), percentOf(palette[i][1]),
                            percentOf(palette[i][2]));
    for (int top = 0; top < image.height; top += 6) {
        const int rows = std::min(6, image.height - top);
        const auto at = [&](int x, int row) {
            return pixels[std::size_t(top + row) * std::size_t(image.width) + std::size_t(x)];
        };
        std::set<std::size_t> used;
        for (int row = 0; row < rows; ++row)
            for (int x = 0; x < image.width; ++x) used.insert(at(x, row));
        if (top > 0) text += "-";
        for (const std::size_t colour : used) {
            text += fmt::format("{}#{}", colour == *used.begin() ? "" : "$", colour);
            int count = 0, last = 0;
            for (int x = 0; x < image.width; ++x) {
                int bits = 0;
                for (int row = 0; row < rows; ++row) bits |= int(at(x, row) == colour) << row;
                if (count > 0 && bits != last) {
                    text += run(count, last);
                    count = 0;
                }
                last = bits;
                ++count;
            }
            if (last != 0) text += run(count, last);
        }
    }
    return text + "\x1b\\";
}

}  // namespace gnomon
