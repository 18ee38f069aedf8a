#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cost/model.h"
#include "cost/spread.h"
#include "cost/touched.h"
#include "matrix/cost_setting.h"
#include "matrix/lab.h"
#include "plan/plan.h"

namespace gnomon {

/// What one setting gets wrong in all frames of a study.
struct ErrorSum {
    int edge = 0, interior = 0;  ///< wrong untied pixels: at the true boundary of a shadow, and away from it
    int tied = 0;                ///< excused pixels
    /// Of wrong pixels, light by light, to the nearest pixel of the other class of truth, centre to centre:
    /// 1 is the pixel beside the boundary. Those of a frame that is all of one class are not in it.
    int measured = 0;
    double distanceSum = 0, largestDistance = 0;  ///< pixels
    std::vector<double> squares{};  ///< by frame: mean squared difference of the image, of levels 0..255

    int wrong() const { return edge + interior; }
    double meanDistance() const { return measured ? distanceSum / measured : 0; }
    /// Over all frames; nothing where no frame could be compared.
    std::optional<double> rms() const;   ///< levels 0..255
    std::optional<double> psnr() const;  ///< dB, infinite of 0
};

/// What one setting takes on the chip in all frames of a study, by the model (cost/model.h).
struct ModelSum {
    std::int64_t bytes = 0, busBytes = 0;  ///< in the frame buffer's memory; to the host and back
    double fillMs = 0, bandwidthMs = 0, triangleMs = 0, busMs = 0;
    double ms = 0;                       ///< of what the profile has the rate for
    std::optional<Resource> limit{};     ///< of the frame that takes longest
    double longestMs = 0;                ///< that frame
    std::vector<std::string> missing{};  ///< FrameCost::missing

    void add(const FrameCost& frame);
};

/// One setting of a study.
struct CostRow {
    CostSetting setting{};
    std::string drawnBy{};           ///< automatic: the methods that were chosen, each once
    std::vector<Missing> missing{};  ///< what the chip lacks for it; then it is not drawn
    std::string failure{};           ///< how it failed; then it is not drawn
    ErrorSum error{};
    PassCounts passes{};  ///< in all frames, and so are the next two
    DrawnAmount amount{};
    ModelSum model{};
    /// By frame and round: its time to that of the unshadowed frame. See CostRequest::repeats.
    std::vector<double> ratios{};
    Spread ratio{};               ///< of them
    std::vector<double> times{};  ///< by frame and round: the frame itself, milliseconds of CostStudy::clock
    Spread ms{};                  ///< of them
    bool onTimeFrontier = false;  ///< no other is as exact in less time, or more exact in as much
    bool onTouchedFrontier = false;  ///< the same of touched pixels
    bool onModelFrontier = false;    ///< the same of the model's time; of none where the profile lacks rates

    bool isDrawn() const { return missing.empty() && failure.empty(); }
};

constexpr int kDrawingsPerRound = 8;

/// What a study is made of.
struct CostRequest {
    Profile profile{};
    /// Draws the image that truth would give: a chip that lacks nothing.
    Profile reference{};
    std::vector<CostSetting> settings{};
    int width = 320, height = 240;
    std::vector<int> frames{0};
    /// Rounds of timing. In each, all settings are drawn in turn kDrawingsPerRound times, unshadowed frames
    /// before each; the best of a setting's drawings counts, and of the unshadowed ones the median over all
    /// settings of the best before each: what else the machine does only ever adds to a time.
    int repeats = 9;
};

/// Rounds for each of @p frames frames: as many in all as one frame has, and one at least.
int defaultRepeats(std::size_t frames);

struct CostStudy {
    std::string profile{}, scene{};
    int width = 0, height = 0, repeats = 0;
    std::vector<int> frames{};
    double unshadowedMs = 0;        ///< median, by the clock: the frame that ratios are to
    std::string device = "osmesa";  ///< gl/device.h
    std::string clock = "thread";   ///< whose time that is: DrawClock
    bool hasModelRates = false;     ///< of the profile
    int framesCompared = 0;       ///< in which a reference method was exact, so that images could be compared
    std::vector<CostRow> rows{};  ///< exact ones first, fewest wrong pixels first; the same: quickest first
};

/// Draws and judges each setting in each frame, and times all of a frame in turn.
/// The image that truth would give is that of carmack, or of counter, on the reference chip in the profile's
/// frame-buffer format, in frames where it has no wrong pixel; tied pixels of either are left out.
/// @param progress  called with done and all steps as they come
CostStudy costStudy(Lab& lab, const CostRequest& request,
                    const std::function<void(std::size_t done, std::size_t all)>& progress = {});

/// An error and a cost; less is better.
struct Bargain {
    double error = 0, cost = 0;
};

/// By entry: no other has less of one and no more of the other.
std::vector<bool> onFrontier(std::span<const Bargain> all);

}  // namespace gnomon
