#pragma once

#include <optional>

#include "gl/chip_arithmetic.h"
#include "matrix/drawing.h"
#include "matrix/frame_predictor.h"
#include "matrix/frame_scene.h"
#include "matrix/needs_finder.h"
#include "needs/minimal_plan.h"

namespace gnomon {

/// Finds the least plan that shows what a method's full plan shows in a frame. Keeps what methods share.
class MinimalPlanner {
  public:
    /// @param frame  must outlive it
    explicit MinimalPlanner(FrameScene& frame) : m_frame(frame) {}

    /// To be called when another frame was selected.
    void select();

    /// @param wanted  drawn although nothing calls for it
    MinimalPlan plan(const Profile& profile, const Axes& axes, const FidelityChoice& fidelity,
                     const Effects& wanted);

    /// Untied pixels in which the masks of @p drawing will be wrong, in exact arithmetic; of several lights
    /// the sum.
    int wrongPixels(const Profile& profile, const Drawing& drawing, const FidelityChoice& fidelity);

    FramePredictor& predictor();

  private:
    FrameScene& m_frame;
    std::optional<NeedsFinder> m_needs{};
    std::optional<FramePredictor> m_predictor{};

    /// A chip and the arithmetic that it is drawn with.
    struct On {
        const Profile& profile;
        BufferFormat format{};
        ChipArithmetic chip{};
    };
    static On onOf(const Profile& profile, const FidelityChoice& fidelity) {
        return {profile, bufferFormatOf(profile), arithmeticOf(profile, fidelity)};
    }

    NeedsFinder& needsFinder();
    FrameNeeds needsOf(const On& on, const Axes& axes);
    MinimalPlan leastPlan(const On& on, const Axes& axes, const Effects& wanted);
    std::int64_t touched(const Profile& profile, const MinimalPlan& plan);
    bool areSame(const On& on, const Drawing& a, const Drawing& b);
    template <class Use>
    auto withPlanned(const On& on, const Drawing& drawing, int index, int colour, const Use& use);
};

}  // namespace gnomon
