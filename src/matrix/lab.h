#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cost/model.h"
#include "cost/touched.h"
#include "gl/chip_arithmetic.h"
#include "gl/renderer.h"
#include "matrix/cell.h"
#include "matrix/frame_predictor.h"
#include "matrix/frame_time.h"
#include "matrix/judge.h"
#include "matrix/progress.h"
#include "needs/minimal_plan.h"
#include "predict/causes.h"
#include "scene/scene.h"
#include "truth/truth.h"

namespace gnomon {

/// The stage in which a frame's truth is found, for all its cells: Lab::onStage().
constexpr const char* kTruthStage = "truth";

/// The pictures of one cell.
struct Pictures {
    Image image{};
    Image mask{};                            ///< shadowPicture(); of several lights the average
    Image truth{};                           ///< the same from the tracer
    std::vector<std::vector<bool>> masks{};  ///< Rendered::masks: by light; empty of one that was left out
    Judgement judgement{};
    // By light that was drawn; of several, a light that was left out has no entry.
    std::vector<Judgement> judgements{};
    std::vector<std::shared_ptr<const Truth>> truths{};  ///< what they are held against
    std::vector<Cause> causes{};  ///< by pixel: why it is wrong; of several lights the first that is
};

/// Draws and judges the cells of one scene. Keeps what cells share: truth, surfaces and
/// volumes of the frame that was asked for last, OpenGL contexts, and results of cells that look alike to the
/// plan, the buffers and the chip's arithmetic, which are drawn once.
class Lab {
  public:
    explicit Lab(Scene scene);
    ~Lab();
    Lab(const Lab&) = delete;
    Lab& operator=(const Lab&) = delete;

    const Scene& scene() const;

    /// Whose arithmetic cells are drawn with from now on; at first OpenGL's.
    void use(const FidelityChoice& choice);

    /// What cells are drawn on from now on; at first the default device.
    void drawOn(Device device);

    /// What cells are drawn with from now on, besides what their frames call for. Without a choice, as at
    /// first, named methods are drawn as they are published, with everything, and automatic ones with what
    /// their frames call for.
    void simulate(const std::optional<Effects>& effects);
    const std::optional<Effects>& simulated() const;

    /// @p listener is told of each stage of a cell as it begins: "pass 3 of 7: fronts", "truth".
    void onStage(std::function<void(const std::string& stage)> listener);

    /// @p listener is given each cell that is drawn, and not taken from one before it, with its pictures;
    /// what it throws is the cell's failure.
    void onDrawn(std::function<void(const Cell&, const Pictures&)> listener);

    /// @param pictures   filled in if given; then nothing is taken from a cell that was drawn before
    /// @param afterPass  called with the surface after each pass
    /// A capability violation or OpenGL error makes the cell failed; nothing is thrown for it.
    /// Automatic axes are chosen first (choice.h); the cell says which they are.
    Cell run(const Profile& profile, const Axes& axes, int width, int height, int frame,
             Pictures* pictures = nullptr,
             const std::function<void(Surface&, std::size_t pass)>& afterPass = {});

    /// What a frame takes, drawn in several ways in turn: by @p ways, of each @p repeats times after one that
    /// is not counted. Nothing is judged, and nothing that was built before is used, but the scene's edges.
    /// @param byPass    waits after each pass, for FrameTime::maskMs
    /// @param progress  in drawn frames, before each
    std::vector<std::vector<FrameTime>> frameTimes(std::span<const TimedWay> ways, int width, int height,
                                                   int frame, int repeats, bool byPass = false,
                                                   const ProgressListener& progress = {});

    /// The full plan of a cell.
    Plan plan(const Profile& profile, const Axes& axes, int width, int height, int frame);

    /// The plan of a cell with what its frame calls for, and why.
    MinimalPlan minimalPlan(const Profile& profile, const Axes& axes, int width, int height, int frame);

    /// How deep the volumes of any light may nest in the method's mask.
    Nesting nesting(const Axes& axes, int width, int height, int frame);

    /// Untied pixels in which the masks of a minimal plan will be wrong, in exact arithmetic; of several
    /// lights the sum.
    /// @pre axes count by volumes, and the chip lacks nothing
    int wrongPixels(const Profile& profile, const MinimalPlan& minimal, int width, int height, int frame);

    /// What each pass of a minimal plan draws.
    std::vector<DrawnAmount> amounts(const Profile& profile, const MinimalPlan& minimal, int width,
                                     int height, int frame);
    /// The same of the full plan of @p axes.
    std::vector<DrawnAmount> fullAmounts(const Profile& profile, const Axes& axes, int width, int height,
                                         int frame);

    /// What a minimal plan would take on the chip, by the model. It is drawn once, for the fragments that
    /// pass.
    /// @param hostMs  as frameCost() takes it
    /// @pre the chip lacks nothing for it
    FrameCost cost(const Profile& profile, const MinimalPlan& minimal, int width, int height, int frame,
                   double hostMs = 0);
    /// The same of what run() draws of @p axes: see simulate().
    /// @pre they aren't automatic
    FrameCost drawnCost(const Profile& profile, const Axes& axes, int width, int height, int frame,
                        double hostMs = 0);
    /// The same of the full plan of @p axes.
    FrameCost fullCost(const Profile& profile, const Axes& axes, int width, int height, int frame,
                       double hostMs = 0);

    /// What @p profile lacks for the plan of a cell, and what the silhouette's builder can't take of the
    /// scene.
    std::vector<Missing> missingFor(const Profile& profile, const Axes& axes, const Plan& plan);

    /// One step on the way to a chip's path.
    struct Candidate {
        Axes axes{};
        std::vector<Missing> missing{};
    };
    /// The candidates for @p profile in the order in which they are tried, up to and including the first that
    /// the chip can run; none can if the last one's missing isn't empty. Stencil counting gets a near cap
    /// where the eye is inside a volume.
    std::vector<Candidate> path(const Profile& profile, int width, int height, int frame);

  private:
    Cell runChosen(const Profile& profile, const Axes& given, int width, int height, int frame,
                   Pictures* pictures, const std::function<void(Surface&, std::size_t)>& afterPass);

    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace gnomon
