#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gl/buffer_format.h"
#include "gl/chip_arithmetic.h"
#include "matrix/judge.h"
#include "method/method.h"
#include "predict/causes.h"
#include "scene/scene.h"
#include "scene/view.h"

namespace gnomon {

/// A rendered mask of one light, and what it was drawn from and with.
struct RenderedMask {
    const Plan& plan;
    const Axes& axes;
    const BufferFormat& format;
    const ChipArithmetic& chip;
    int light = 0;
    const Truth& truth;
    const Judgement& judgement;
    /// Per pixel of the window, rows from the top; Rendered::values.
    std::span<const std::uint16_t> values;
    /// The drawn volumes' places among all; FrameVolumes::ordinals. Empty where the plan draws none by
    /// number.
    std::span<const std::uint32_t> ordinals{};
    bool leavesOut = false;  ///< the others that are in the window were left out on purpose
};

/// The arithmetic of the buffer that holds the masks of @p axes.
MaskChannel maskChannel(const BufferFormat& format, const ChipArithmetic& chip, const Axes& axes);

/// What became of a mask.
struct Explained {
    int unpredicted = 0;          ///< untied pixels that hold what the predictor does not allow
    std::vector<Cause> causes{};  ///< by pixel; None where it is right or tied. Empty if all are
};

/// A mask that has not been drawn.
struct PlannedMask {
    const Plan& plan;
    const Axes& axes;
    const BufferFormat& format;
    const ChipArithmetic& chip;
    int light = 0;
    std::span<const std::uint32_t> ordinals{};  ///< as of RenderedMask
    bool leavesOut = false;                     ///< likewise
    int colour = 0;  ///< of a mask in the colour buffer: which of its channels, 0 to 2
};

/// Holds rendered masks against their prediction, and says why wrong pixels are wrong. Keeps what the masks
/// of one frame share.
class FramePredictor {
  public:
    /// @p scene must outlive it
    explicit FramePredictor(const Scene& scene);
    ~FramePredictor();

    /// The frame that is asked about from now on.
    void select(const View& view);

    Explained explain(const RenderedMask& mask);

    /// Untied pixels in which the mask will be wrong, in exact arithmetic. A rasteriser that rounds can turn
    /// none but tied ones.
    /// @pre the mask is counted by volumes
    int wrongPixels(const PlannedMask& mask, const Truth& truth);

    /// Whether two plans make the same mask of a light in exact arithmetic, and a rasteriser that rounds
    /// makes nothing by @p b that it may not make by @p a.
    /// @pre both are counted by volumes, from as many pixels
    bool areSame(const PlannedMask& a, const PlannedMask& b);

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace gnomon
