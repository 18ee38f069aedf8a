#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cost/touched.h"
#include "matrix/cell.h"
#include "matrix/lab.h"
#include "matrix/progress.h"
#include "needs/minimal_plan.h"

namespace gnomon {

/// One method on one chip in one frame: its minimal plan, what it costs, and what comes of it.
struct AdviceRow {
    std::string method{};      ///< id of the method that was asked for
    MinimalPlan minimal{};     ///< its axes are those that are drawn
    DrawnAmount amount{};      ///< what the minimal plan draws
    DrawnAmount fullAmount{};  ///< what the full plan draws
    FrameCost cost{};  ///< of the minimal plan, by the model; no passes where the chip has not the rates
    /// Verdict, wrong pixels, causes, ties and what the chip lacks, of the minimal plan.
    Cell cell{};
    /// Why it must be exact, without drawing it: "volumes nest up to 2 deep, 3 can be counted"; empty if
    /// nothing proves it.
    std::string proof{};
    std::vector<std::string> chipTerms{};  ///< of each pass of the minimal plan (chip_terms.h)

    int wrong() const { return cell.wrongEdge + cell.wrongInterior; }  ///< pixels
    bool isDrawn() const { return cell.verdict != Verdict::Refused && cell.verdict != Verdict::Failed; }
};

/// What a chip should do about the shadows of one frame.
struct Advice {
    std::string profile{}, scene{};
    int width = 0, height = 0, frame = 0;
    std::string fidelity = "gl", device = "osmesa";
    std::vector<std::string> rates{};     ///< modelRates() of the chip
    std::vector<AdviceRow> rows{};        ///< as ranked() has them
    std::optional<std::size_t> chosen{};  ///< the cheapest exact row; of proved ones if there are any

    /// Of the rows before the chosen one the nearest that is not exact: what a little less would have cost.
    /// None if nothing that the chip can draw is cheaper and wrong.
    const AdviceRow* nextCheaper() const;
    /// The rows before the chosen one that are exact in this frame too, though nothing proves it.
    std::vector<const AdviceRow*> cheaperUnproved() const;
    /// Of the rows that are drawn, the one with the fewest wrong pixels, of these the cheapest. None if none
    /// is drawn.
    const AdviceRow* leastWrong() const;
};

/// @p advice with its rows cheapest first, and the cheapest exact one chosen: the cheapest proved one where
/// any is. Cost is the model's time where the chip has the rates, then touched pixels, then vertices, then
/// passes; what is refused or failed comes last. Rows that cost the same keep their order.
Advice ranked(Advice advice);

/// Draws and judges the minimal plan of every named method.
/// @param progress  in methods
Advice advise(Lab& lab, const Profile& profile, int width, int height, int frame,
              const ProgressListener& progress = {});

}  // namespace gnomon
