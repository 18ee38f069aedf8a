#include "report/cause_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "image/lettering.h"

namespace gnomon {
namespace {

constexpr int kLegendMargin = 4, kSwatch = 7, kLine = kLetterHeight + 2;
constexpr Rgb kLegendPaper{255, 255, 255}, kLegendInk{0, 0, 0};

}  // namespace

std::array<std::uint8_t, 3> colourOf(Cause cause) {
    static constexpr Rgb kColours[kCauses] = {
        {255, 255, 255},                                                   // none
        {70, 70, 160},                                                     // no shadow is drawn
        {230, 25, 75},   {245, 130, 48}, {170, 110, 40}, {220, 0, 0},      // clamps ... saturates
        {145, 30, 180},  {240, 50, 230}, {255, 165, 0},  {255, 215, 0},    // wraps ... dither drift
        {0, 130, 200},   {0, 90, 255},   {70, 200, 240}, {0, 60, 120},     // eye ... far plane
        {60, 180, 75},   {0, 120, 60},   {150, 210, 60}, {0, 160, 160},    // open ... background
        {128, 0, 0},     {190, 90, 90},  {0, 0, 255},    {200, 120, 200},  // depth ... map resolution
        {110, 60, 140},  {255, 0, 255},
    };
    return kColours[std::size_t(cause)];
}

Image causePicture(const Image& mask, const std::vector<Cause>& causes) {
    std::map<Cause, int> counts;
    for (const Cause cause : causes)
        if (cause != Cause::None) ++counts[cause];
    std::vector<std::pair<Cause, int>> rows(counts.begin(), counts.end());
    std::stable_sort(rows.begin(), rows.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });

    std::vector<std::string> lines;
    for (const auto& [cause, pixels] : rows) lines.push_back(fmt::format("{} {}", name(cause), pixels));
    if (lines.empty()) lines.push_back("no wrong pixel");
    std::size_t longest = 0;
    for (const std::string& line : lines) longest = std::max(longest, line.size());
    const int legendWidth = 3 * kLegendMargin + kSwatch + int(longest) * kLetterWidth;

    Image picture{std::max(mask.width, legendWidth),
                  mask.height + 2 * kLegendMargin + int(lines.size()) * kLine,
                  3,
                  {}};
    picture.data.resize(std::size_t(picture.width) * std::size_t(picture.height) * 3);
    fillRectangle(picture, 0, 0, picture.width, picture.height, kLegendPaper);
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            const auto i = std::size_t(y) * std::size_t(mask.width) + std::size_t(x);
            const auto grey = std::uint8_t(150 + mask.data[i] * 90 / 255);
            const bool isWrong = i < causes.size() && causes[i] != Cause::None;
            fillRectangle(picture, x, y, 1, 1, isWrong ? colourOf(causes[i]) : Rgb{grey, grey, grey});
        }
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const int y = mask.height + kLegendMargin + int(i) * kLine;
        if (i < rows.size())
            fillRectangle(picture, kLegendMargin, y + 1, kSwatch, kSwatch, colourOf(rows[i].first));
        writeText(picture, 2 * kLegendMargin + kSwatch, y, lines[i], kLegendInk);
    }
    return picture;
}

}  // namespace gnomon
