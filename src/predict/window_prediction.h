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
    bool shadow(std::size_t pixel) const;

    /// Whether the mask may be shown as @p value: a stencil value, a count of 16 bits, or 8 bits of colour or
    /// alpha.
    bool allows(std::size_t pixel, int value) const;

    /// The pixel of the mask at which the window's pixel lies.
    glm::ivec2 maskPixel(std::size_t pixel) const;

  private:
    /// What a mask that is stretched holds, 8 bits.
    struct Texel {
        double exact = 0, low = 0, high = 0;
    };
    void readTexels();
    Texel filtered(std::size_t pixel) const;

    const Plan& m_plan;
    MaskPrediction& m_mask;
    std::vector<Texel> m_texels{};  ///< of a stretched mask, rows from the top
    bool m_nearest = false;
    double m_rounding = 0;
};

}  // namespace gnomon
