#include "gl/darkened.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace gnomon {
namespace {

using Word = std::uint32_t;  ///< red, green, blue and alpha as they lie in memory
constexpr int kStripPixels = 16 * 1024;

/// All bits of the channels that go into the texture.
Word channelsOf(MaskTexture texture) {
    const auto all = [](bool red, bool green, bool blue, bool alpha) {
        const auto byte = [](bool is) { return std::uint8_t(is ? 255 : 0); };
        return std::bit_cast<Word>(std::array{byte(red), byte(green), byte(blue), byte(alpha)});
    };
    if (texture == MaskTexture::Alpha) return all(false, false, false, true);
    return texture == MaskTexture::Intensity ? all(true, false, false, false) : all(true, true, true, false);
}

/// Around the texels that are not one. Read in strips, which stay in the processor's cache.
WindowRect darkTexels(const GlTable& gl, int width, int height, Word channels) {
    const auto isDark = [channels](Word pixel) { return (pixel & channels) != channels; };
    const int rows = std::clamp(kStripPixels / width, 1, height);
    std::vector<Word> strip(std::size_t(rows) * std::size_t(width));
    int left = width, right = -1, bottom = height, top = -1;
    for (int y = 0; y < height; ++y) {
        if (y % rows == 0)
            gl.ReadPixels(0, y, width, std::min(rows, height - y), GL_RGBA, GL_UNSIGNED_BYTE, strip.data());
        const Word* row = strip.data() + std::size_t(y % rows) * std::size_t(width);
        Word common = ~Word{0};
        for (int x = 0; x < width; ++x) common &= row[x];
        if (!isDark(common)) continue;
        left = std::min(left, int(std::find_if(row, row + width, isDark) - row));
        for (int x = width - 1; x > right; --x)
            if (isDark(row[x])) right = x;
        bottom = std::min(bottom, y);
        top = y;
    }
    if (right < 0) return {};
    return {left, bottom, right - left + 1, top - bottom + 1};
}

/// The window's pixels, along one axis, whose filter meets a texel of [first, end); two more on either side
/// make up for the rounding of coordinates.
std::pair<int, int> stretched(int first, int end, int texels, int pixels) {
    const auto pixelAt = [&](int halfTexels) {
        return int(std::int64_t(halfTexels) * pixels / (2 * texels));
    };
    return {std::max(0, pixelAt(2 * first - 1) - 2), std::min(pixels, pixelAt(2 * end + 1) + 2)};
}

}  // namespace

WindowRect darkenedPart(const GlTable& gl, const Plan& plan, MaskTexture texture) {
    const WindowRect dark = darkTexels(gl, plan.maskWidth, plan.maskHeight, channelsOf(texture));
    if (dark.empty()) return {};
    const auto [left, right] = stretched(dark.x, dark.x + dark.width, plan.maskWidth, plan.width);
    const auto [bottom, top] = stretched(dark.y, dark.y + dark.height, plan.maskHeight, plan.height);
    return {left, bottom, right - left, top - bottom};
}

bool multipliesByMask(const Pass& pass) {
    return pass.kind == PassKind::Rectangle && pass.texture != MaskTexture::None && !pass.frameTexture &&
           pass.extent == Extent::Whole && !pass.alphaTest.enabled && !pass.stencil.enabled &&
           !pass.logicInvert && pass.blend.enabled && pass.blend.equation == BlendEquation::Add &&
           pass.blend.source == BlendFactor::Zero &&
           (pass.blend.destination == BlendFactor::SrcColor ||
            pass.blend.destination == BlendFactor::SrcAlpha) &&
           pass.write == kWriteColour;
}

}  // namespace gnomon
