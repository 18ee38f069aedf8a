#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "plan/plan.h"
#include "predict/crossings.h"
#include "predict/mask_channel.h"

namespace gnomon {

constexpr int kLeftOut = -2;

/// What a plan's mask of one light is predicted from.
struct MaskInputs {
    const Plan& plan;
    int light = 0;
    const Crossings& crossings;  ///< of a view as large as the plan's mask
    MaskChannel arithmetic{};
    /// By volume of the predictor: its index among the plan's volumes; -1 if no pass draws it, since it is
    /// outside of the window; kLeftOut if the plan left it out on purpose, and it counts as if it were not
    /// there. Empty: plans that draw all volumes at once don't ask.
    std::span<const int> planVolumes{};
    int holdingEye = 0;      ///< volumes that hold the eye, where the plan counts them by itself
    bool eyeOnFace = false;  ///< then that count is not one for all pixels, and nothing is predicted
};

/// The mask of one light as the plan's passes must make it: in each pixel the crossings of the eye ray, pass
/// by pass, in the chip's own arithmetic.
///
/// Values are codes of the mask's channel, stencil values, or counts of 16 bits. A pixel has one exact value,
/// and all those that a rasteriser may come to which rounds corners and depths.
class MaskPrediction {
  public:
    /// @pre the plan has a mask of @p in.light, and not one from a depth map
    explicit MaskPrediction(const MaskInputs& in);
    ~MaskPrediction();
    MaskPrediction(MaskPrediction&&) noexcept;

    /// Of the mask, pixels; rows from the top.
    int width() const;
    int height() const;

    /// In exact arithmetic.
    int value(int x, int y) const;
    /// Whether the finished mask may hold @p value there.
    bool allows(int x, int y, int value) const;
    /// All that it may hold, ascending. Empty where the plan leaves out a volume that is there.
    std::span<const std::uint16_t> values(int x, int y) const;

    /// Whether a value of the finished mask is a shadow.
    bool isShadow(int value) const { return isShadowShown(shown(value)); }
    /// The same of 8 bits where values are codes of a channel.
    bool isShadowShown(double value) const;
    /// A value as it is read from the buffer: codes of a channel in 8 bits, all others as they are.
    double shown(int value) const;
    /// Whether a value of the mask is read from the window's pixel as @p shown.
    bool isShownAs(int x, int y, int value, int shown) const;
    /// Inverse of shown(), for what buffers give.
    int codeOf(int shown) const;

    /// What the same passes would count beyond what a lit pixel holds, had the mask no limits and did all
    /// depths and borders fall as in exact arithmetic: a shadow where it is not 0.
    int unlimitedCount(int x, int y) const;
    /// The least and the most of that, where depths and borders may fall otherwise.
    std::pair<int, int> unlimitedCounts(int x, int y) const;

    /// Whether some face leaves the mask's value as it is, though it should change: the value is at its
    /// limit, and an entry or an exit is lost.
    bool isStuck(int x, int y) const;

    /// Whether the plan counts from the eye on, so that what holds the near plane must be added.
    bool countsFromEye() const;
    /// Whether it starts from what hides the eye, counted by itself.
    bool startsAtEye() const;
    /// Whether it counts up and down in steps that wrap.
    bool wraps() const;
    bool isStencil() const;
    /// Whether its values are codes of a colour or alpha channel.
    bool hasCodes() const;
    /// Volumes that hold the near plane's point of the pixel, if no pass of the plan counts them.
    int uncountedNearCaps(int x, int y) const;

    /// Whether some face is so near to the visible surface, or so near to passing beside the ray, that the
    /// mask may become another; Own if all of these hang from the seen triangle.
    enum class Doubt { None, Own, Others };
    Doubt doubt(int x, int y) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace gnomon
