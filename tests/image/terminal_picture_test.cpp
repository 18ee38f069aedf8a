// Pictures in characters and sixels, read back by decoders that share nothing with the encoders.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "image/half_blocks.h"
#include "image/scale.h"
#include "image/sixel.h"

namespace gnomon {
namespace terminal_picture_test {

using testing::ElementsAre;
using testing::StartsWith;

Image noise(int width, int height, int channels, unsigned colours = 256) {
    std::mt19937 random(7);
    Image image{width, height, channels, {}};
    for (int i = 0; i < width * height * channels; ++i)
        image.data.push_back(std::uint8_t(random() % colours * (255 / (colours - 1))));
    return image;
}

/// A terminal that knows SGR colours of 24 bits, upper half blocks and line ends: its cells are two pixels
/// high. A colour that was not set is -1.
struct HalfBlockScreen {
    std::vector<std::vector<std::array<int, 6>>> lines{{}};

    explicit HalfBlockScreen(const std::string& text) {
        std::array<int, 3> front{-1, -1, -1}, back{-1, -1, -1};
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text.compare(i, 2, "\x1b[") == 0) {
                int plane = 0, r = -1, g = -1, b = -1;
                if (text.compare(i, 4, "\x1b[0m") == 0)
                    front = back = {-1, -1, -1};
                else if (std::sscanf(text.c_str() + i, "\x1b[%d;2;%d;%d;%dm", &plane, &r, &g, &b) == 4)
                    (plane == 38 ? front : back) = {r, g, b};
                else
                    ADD_FAILURE() << "sequence at " << i;
                i = text.find('m', i);
            } else if (text[i] == '\n') {
                lines.emplace_back();
            } else if (text.compare(i, 3, "\xe2\x96\x80") == 0) {
                lines.back().push_back({front[0], front[1], front[2], back[0], back[1], back[2]});
                i += 2;
            } else {
                ADD_FAILURE() << "character at " << i;
            }
        }
        EXPECT_TRUE(lines.back().empty()) << "the last line has its end";
        EXPECT_EQ(front[0], -1) << "the colours are the terminal's own in the end";
        lines.pop_back();
    }

    std::array<int, 3> pixel(int x, int y) const {
        const auto& cell = lines.at(y / 2).at(x);
        return y % 2 == 0 ? std::array{cell[0], cell[1], cell[2]} : std::array{cell[3], cell[4], cell[5]};
    }
};

TEST(HalfBlocks, HoldEveryPixel) {
    for (const int height : {1, 2, 7, 8}) {
        const Image image = noise(5, height, 3, 2);
        const HalfBlockScreen screen(halfBlocks(image));
        ASSERT_EQ(screen.lines.size(), std::size_t(height + 1) / 2);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < 5; ++x)
                for (int c = 0; c < 3; ++c)
                    EXPECT_EQ(screen.pixel(x, y)[c], image.data[(y * 5 + x) * 3 + c]) << x << " " << y;
    }
}

TEST(HalfBlocks, LeaveTheGroundBelowALastOddRow) {
    EXPECT_EQ(HalfBlockScreen(halfBlocks(noise(2, 3, 3))).pixel(0, 3), (std::array{-1, -1, -1}));
}

TEST(HalfBlocks, TakeGreyAndLeaveAlphaOut) {
    EXPECT_EQ(HalfBlockScreen(halfBlocks({1, 1, 1, {9}})).pixel(0, 0), (std::array{9, 9, 9}));
    EXPECT_EQ(HalfBlockScreen(halfBlocks({1, 1, 4, {1, 2, 3, 4}})).pixel(0, 0), (std::array{1, 2, 3}));
}

TEST(HalfBlocks, SetNoColourTwice) {
    EXPECT_EQ(halfBlocks({3, 2, 1, {1, 1, 1, 2, 2, 2}}),
              "\x1b[38;2;1;1;1m\x1b[48;2;2;2;2m\u2580\u2580\u2580\x1b[0m\n");
}

TEST(LetterPicture, IsDenserTheDarker) {
    EXPECT_EQ(letterPicture({3, 1, 1, {0, 128, 255}}), "@=\n");
    EXPECT_EQ(letterPicture({1, 2, 1, {0, 255}}), "=\n") << "a letter is the mean of two pixels";
    EXPECT_EQ(letterPicture({3, 1, 1, {100, 110, 120}}), "@=\n") << "all letters for what light there is";
}

TEST(ScaledDown, IsTheMeanOfWhatAPixelCovers) {
    EXPECT_THAT(scaledDown({4, 1, 1, {0, 10, 20, 40}}, 2, 1).data, ElementsAre(5, 30));
    // Of three pixels in two, the middle one counts half for each.
    EXPECT_THAT(scaledDown({3, 1, 1, {30, 60, 90}}, 2, 1).data, ElementsAre(40, 80));
    EXPECT_THAT(scaledDown({1, 2, 3, {0, 1, 2, 10, 11, 12}}, 1, 1).data, ElementsAre(5, 6, 7));
}

TEST(ScaledDown, KeepsAnImageOfOneColourAndOfItsOwnSize) {
    const Image grey{13, 7, 1, std::vector<std::uint8_t>(91, 77)};
    for (int width = 1; width <= 13; ++width)
        EXPECT_EQ(scaledDown(grey, width, 3).data, std::vector<std::uint8_t>(width * 3, 77));
    EXPECT_EQ(scaledDown(noise(6, 5, 3), 6, 5), noise(6, 5, 3));
}

TEST(Fitted, ScalesOnlyWhatIsTooWide) {
    EXPECT_EQ(fitted(noise(6, 5, 3), 6), noise(6, 5, 3));
    const Image half = fitted(noise(320, 240, 3), 80);
    EXPECT_EQ(half.width, 80);
    EXPECT_EQ(half.height, 60);
    EXPECT_EQ(fitted(noise(40, 1, 1), 3).height, 1);
}

TEST(Beside, HoldsBothAndBlackBetween) {
    const Image both = beside({1, 2, 1, {10, 20}}, {1, 1, 3, {1, 2, 3}}, 1);
    EXPECT_EQ(both.width, 3);
    EXPECT_THAT(both.data, ElementsAre(10, 10, 10, 0, 0, 0, 1, 2, 3, 20, 20, 20, 0, 0, 0, 0, 0, 0));
}

/// A sixel terminal: the picture in percents, -1 where nothing was drawn.
struct SixelScreen {
    int width = 0, height = 0;
    std::vector<std::array<int, 3>> pixels{};

    explicit SixelScreen(const std::string& text) {
        int aspect = 0, shown = 0, used = 0;
        EXPECT_EQ(
            std::sscanf(text.c_str(), "\x1bP0;1q\"%d;%d;%d;%d%n", &aspect, &shown, &width, &height, &used),
            4);
        EXPECT_EQ(aspect, 1);
        EXPECT_EQ(shown, 1);
        EXPECT_EQ(text.substr(text.size() - 2), "\x1b\\");
        pixels.assign(std::size_t(width * height), {-1, -1, -1});
        std::map<int, std::array<int, 3>> colours;
        int colour = 0, x = 0, band = 0, repeat = 1;
        for (std::size_t i = used; i + 2 < text.size();) {
            int n = 0, r = 0, g = 0, b = 0, length = 0;
            const char c = text[i];
            if (c == '#') {
                if (std::sscanf(text.c_str() + i, "#%d;2;%d;%d;%d%n", &n, &r, &g, &b, &length) == 4)
                    colours[n] = {r, g, b};
                else
                    std::sscanf(text.c_str() + i, "#%d%n", &n, &length);
                colour = n;
                i += length;
            } else if (c == '!') {
                std::sscanf(text.c_str() + i, "!%d%n", &repeat, &length);
                i += length;
            } else if (c == '$' || c == '-') {
                x = 0;
                band += c == '-';
                ++i;
            } else {
                EXPECT_TRUE(c >= '?' && c <= '~') << int(c);
                EXPECT_TRUE(colours.contains(colour));
                for (; repeat > 0; --repeat, ++x)
                    for (int bit = 0; bit < 6; ++bit)
                        if ((c - '?') >> bit & 1) pixels.at((band * 6 + bit) * width + x) = colours[colour];
                repeat = 1;
                ++i;
            }
        }
        EXPECT_LE(colours.size(), 256u);
    }
};

TEST(Sixel, HoldsEveryPixelOfFewColoursToThePercent) {
    for (const int height : {1, 5, 6, 13}) {
        const Image image = noise(17, height, 3, 4);
        const SixelScreen screen(sixel(image));
        ASSERT_EQ(screen.width, 17);
        ASSERT_EQ(screen.height, height);
        for (std::size_t i = 0; i < screen.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(screen.pixels[i][c], image.data[i * 3 + c] / 2.55, 0.5) << i;
    }
}

TEST(Sixel, RunsOfOneColourAreShort) {
    EXPECT_EQ(sixel({100, 6, 1, std::vector<std::uint8_t>(600, 255)}),
              "\x1bP0;1q\"1;1;100;6#0;2;100;100;100#0!100~\x1b\\");
}

TEST(Sixel, ManyColoursAreNearTheirOwn) {
    // A ramp in two channels: 64 x 64 colours.
    Image image{64, 64, 3, {}};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            image.data.insert(image.data.end(), {std::uint8_t(x * 4), std::uint8_t(y * 4), 0});
    const SixelScreen screen(sixel(image));
    double worst = 0;
    for (std::size_t i = 0; i < screen.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(screen.pixels[i][c] * 2.55 - image.data[i * 3 + c]));
    // 256 boxes of 4096 colours, 4 x 4 of them each, steps of 4: 8 from the middle to a corner at best. Twice
    // that for boxes that are not square, and the percent.
    EXPECT_LE(worst, 18);
}

TEST(PaletteOf, IsThatOfTheImageWhereItHasFewColours) {
    EXPECT_THAT(paletteOf({3, 1, 3, {5, 6, 7, 1, 2, 3, 5, 6, 7}}),
                ElementsAre(std::array<std::uint8_t, 3>{1, 2, 3}, std::array<std::uint8_t, 3>{5, 6, 7}));
}

TEST(PaletteOf, NeverHasMoreThanAsked) {
    const Image image = noise(64, 64, 3);
    for (const std::size_t most : {1u, 2u, 16u, 256u}) {
        const auto palette = paletteOf(image, most);
        EXPECT_LE(palette.size(), most);
        EXPECT_GE(palette.size(), most * 9 / 10);
    }
    EXPECT_EQ(sixel(image), sixel(image));
}

}  // namespace terminal_picture_test
}  // namespace gnomon
