#pragma once

#include <string>
#include <vector>

#include "matrix/lab.h"

namespace gnomon {

/// A method that may be chosen for a frame, and what its minimal plan costs.
struct Option {
    std::string method{};            ///< named row
    Axes axes{};                     ///< of the row; doubling has the levels that the frame calls for
    std::vector<Missing> missing{};  ///< what the chip lacks; then there is no more
    MinimalPlan plan{};
    DrawnAmount amount{};  ///< of the minimal plan
    FrameCost cost{};      ///< of it, by the model; no passes where the chip has not the rates
};

/// All named methods but none, in one shade, cheapest first: by the model's time where the chip has the rates
/// (hasModelRates()), then by touched pixels, vertices, passes, and the order of the table. Those that the
/// chip can't run come last.
std::vector<Option> options(Lab& lab, const Profile& profile, Shade shade, int width, int height, int frame);

struct Choice {
    Option option{};  ///< of Refused: the first of the table
    Proof proof = Proof::Refused;
    int wrong = 0;  ///< None: untied pixels
};

/// The cheapest of @p options (sorted, as options() gives them) that is exact in this frame.
Choice choose(Lab& lab, const Profile& profile, const std::vector<Option>& options, int width, int height,
              int frame);

/// @p axes themselves, or those that automatic ones take in this frame.
Axes chosenAxes(Lab& lab, const Profile& profile, const Axes& axes, int width, int height, int frame);

}  // namespace gnomon
