#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cost/touched.h"
#include "needs/minimal_plan.h"
#include "plan/plan.h"
#include "report/cost_notes.h"
#include "report/page.h"

namespace gnomon {

/// Volume passes beyond these are folded in texts: a level has thousands.
constexpr std::size_t kShownVolumes = 8;

/// What stands behind a minimal plan: why its parts are there or left out, and the full plan beside it.
struct PlanNotes {
    std::vector<EffectNote> effects{};
    std::vector<DrawnAmount> amounts{};  ///< of each pass of the minimal plan
    Plan full{};
    DrawnAmount fullAmount{};
    std::optional<CostNotes> cost{};  ///< by the model, of both plans
    std::string
        drawnAs{};  ///< method id of MinimalPlan::axes, if it is not the one that was asked for; or ""
};

/// The fact that calls for pass @p index of @p plan, in one phrase: what it does for the picture, how many
/// volumes reach what is seen and where, and the notes on effects that it is there for.
std::string reasonFor(const Plan& plan, std::size_t index, const std::vector<EffectNote>& effects);

/// "183x122 at 60,40", or "no pixel".
std::string rectText(const WindowRect& rect);

/// "0.43"; "-" where there is nothing to compare with.
std::string ratioText(std::int64_t part, std::int64_t whole);

/// For people: the effects that a plan leaves out, has since the frame calls for them, and has since they
/// were asked for; each with its fact, under heads.
std::string effectsText(const std::vector<EffectNote>& effects, std::size_t width = kPageColumns);

/// For people, beneath the passes of @p plan: what is left out and why, what was asked for, passes, vertices
/// and touched pixels of the minimal and the full plan side by side, and what the model makes of them.
std::string notesText(const Plan& plan, const PlanNotes& notes, std::size_t width = kPageColumns);

}  // namespace gnomon
