#include "predict/window_prediction.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

WindowPrediction::WindowPrediction(const Plan& plan, MaskPrediction& mask, int shownBits)
    : m_plan(plan), m_mask(mask) {
    if (plan.width == mask.width() && plan.height == mask.height()) return;
    m_nearest = std::any_of(plan.passes.begin(), plan.passes.end(), [](const Pass& pass) {
        return pass.kind == PassKind::Copy && pass.nearest && !pass.frameTexture;
    });
    // A filter's weights have 8 bits, and so has what it gives; then the window's channel rounds.
    m_rounding = 2 + 255.0 / ((1 << shownBits) - 1);
    readTexels();
}

void WindowPrediction::readTexels() {
    for (int y = 0; y < m_mask.height(); ++y) {
        for (int x = 0; x < m_mask.width(); ++x) {
            const auto values = m_mask.values(x, y);
            const double exact = m_mask.shown(m_mask.value(x, y));
            m_texels.push_back({exact, values.empty() ? exact : m_mask.shown(values.front()),
                                values.empty() ? exact : m_mask.shown(values.back())});
        }
    }
}

WindowPrediction::Texel WindowPrediction::filtered(std::size_t pixel) const {
    const int width = m_mask.width(), height = m_mask.height();
    // Rows from the bottom, as the texture has them.
    const int column = int(pixel % std::size_t(m_plan.width)),
              row = m_plan.height - 1 - int(pixel / std::size_t(m_plan.width));
    const double s = (column + 0.5) / m_plan.width * width - 0.5,
                 t = (row + 0.5) / m_plan.height * height - 0.5;
    const double left = m_nearest ? std::round(s) : std::floor(s),
                 below = m_nearest ? std::round(t) : std::floor(t);
    Texel sum;
    for (const int v : {0, 1}) {
        for (const int u : {0, 1}) {
            const double weightX = m_nearest ? 1 - u : u ? s - left : 1 - (s - left);
            const double weightY = m_nearest ? 1 - v : v ? t - below : 1 - (t - below);
            const int x = std::clamp(int(left) + u, 0, width - 1),
                      y = height - 1 - std::clamp(int(below) + v, 0, height - 1);
            const Texel& texel = m_texels[std::size_t(y) * std::size_t(width) + std::size_t(x)];
            const double weight = weightX * weightY;
            sum.exact += weight * texel.exact, sum.low += weight * texel.low, sum.high += weight * texel.high;
        }
    }
    return sum;
}

bool WindowPrediction::shadow(std::size_t pixel) const {
    if (!m_texels.empty()) return m_mask.isShadowShown(filtered(pixel).exact);
    const glm::ivec2 at = maskPixel(pixel);
    return m_mask.isShadow(m_mask.value(at.x, at.y));
}

bool WindowPrediction::allows(std::size_t pixel, int value) const {
    if (!m_texels.empty()) {
        const Texel sum = filtered(pixel);
        return value >= sum.low - m_rounding && value <= sum.high + m_rounding;
    }
    const glm::ivec2 at = maskPixel(pixel);
    const auto values = m_mask.values(at.x, at.y);
    return std::any_of(values.begin(), values.end(),
                       [&](int code) { return m_mask.isShownAs(at.x, at.y, code, value); });
}

glm::ivec2 WindowPrediction::maskPixel(std::size_t pixel) const {
    const int x = int(pixel % std::size_t(m_plan.width)), y = int(pixel / std::size_t(m_plan.width));
    return {x * m_mask.width() / m_plan.width, y * m_mask.height() / m_plan.height};
}

}  // namespace gnomon
