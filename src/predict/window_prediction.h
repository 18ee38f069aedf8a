#pragma once

#include <cstdint>
#include <vector>

#include "predict/mask_prediction.h"

namespace gnomon {

/// A predicted mask as the window shows it: pixel by pixel, or stretched as a texture over it.
class WindowPrediction {
  public:
    /// @param mask        must outlive this
    /// @param shownBits   of the window's channel through which a stretched mask is read
    WindowPrediction(const Plan& plan, MaskPrediction& mask, int shownBits);

    /// Rows from the top, by pixel of the window: the mask is a shadow, in exact arithmetic.
    bool shadow(std::size_t pixel) const { return m_shadow[pixel]; }

    /// Whether the mask may be shown as @p value: a stencil value, a count of 16 bits, or 8 bits of colour or
    /// alpha.
    bool allows(std::size_t pixel, int value) const;

    /// The pixel of the mask at which the window's pixel lies.
    glm::ivec2 maskPixel(std::size_t pixel) const;

  private:
    struct Range {
        float low = 0, high = 0;  ///< 8 bits
    };
    void stretch(bool nearest, double rounding);

    const Plan& m_plan;
    MaskPrediction& m_mask;
    std::vector<bool> m_shadow{};
    std::vector<Range> m_ranges{};  ///< of a stretched mask
};

}  // namespace gnomon
