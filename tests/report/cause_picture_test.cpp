#include "report/cause_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "image/lettering.h"

namespace gnomon {
namespace cause_picture_test {

Rgb colourAt(const Image& picture, int x, int y) {
    const auto* p = picture.data.data() + 3 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x));
    return {p[0], p[1], p[2]};
}

TEST(CausePicture, ShowsEachWrongPixelInTheColourOfItsLegend) {
    const Image mask{40, 30, 1, std::vector<std::uint8_t>(40 * 30, 255)};
    std::vector<Cause> causes(40 * 30, Cause::None);
    std::set<Rgb> colours;
    for (int c = 1; c < kCauses; ++c) {
        causes.assign(causes.size(), Cause::None);
        causes[7 * 40 + 11] = Cause(c);
        const Image picture = causePicture(mask, causes);
        const Rgb colour = colourAt(picture, 11, 7);
        EXPECT_NE(colour, colourAt(picture, 12, 7));
        EXPECT_EQ(colour, colourAt(picture, 5, 30 + 4 + 3)) << "swatch of " << name(Cause(c));
        EXPECT_NE(colour[0] == colour[1] && colour[1] == colour[2], true) << "a grey of the mask";
        colours.insert(colour);
    }
    EXPECT_EQ(colours.size(), std::size_t(kCauses - 1)) << "two causes have one colour";
}

TEST(CausePicture, NamesTheMostFrequentCauseFirst) {
    const Image mask{40, 30, 1, std::vector<std::uint8_t>(40 * 30, 0)};
    std::vector<Cause> causes(40 * 30, Cause::None);
    causes[0] = Cause::MaskClamps;
    const int one = causePicture(mask, causes).height;
    causes[1] = causes[2] = Cause::MaskWraps;
    const Image picture = causePicture(mask, causes);
    EXPECT_GT(picture.height, one);
    EXPECT_EQ(colourAt(picture, 5, 37), colourAt(picture, 1, 0));
}

TEST(Lettering, HasALetterForEachNameOfACause) {
    const auto written = [](const std::string& text) {
        Image picture{200, 9, 3, std::vector<std::uint8_t>(200 * 9 * 3, 255)};
        writeText(picture, 0, 0, text, {0, 0, 0});
        return picture.data;
    };
    for (int c = 1; c < kCauses; ++c)
        for (const char letter : name(Cause(c)))
            EXPECT_NE(written({letter}), written("\n")) << letter << " is a box";
    EXPECT_NE(written("a"), written("b"));
}

}  // namespace cause_picture_test
}  // namespace gnomon
