#pragma once

#include <optional>
#include <string>

#include "matrix/progress.h"

namespace gnomon {

/// What a progress bar tells.
struct ProgressState {
    Progress progress{};
    double perSecond = 0;                 ///< steps; 0 while none is done
    std::optional<double> secondsLeft{};  ///< none while no step is done
};

/// To the left edge of a terminal, and erase what is there (ECMA-48's EL).
constexpr const char* kClearLine = "\r\x1b[K";

/// One line for a terminal of @p columns, all but the last of which it may fill: a bar and the figures,
/// without line end. Where that is too wide the bar is left out, then the rate, then the time.
///
/// @param unit  of a step, in the plural: "cells"
std::string progressLine(const ProgressState& state, const std::string& unit, std::size_t columns);

/// What to write to a terminal as a run goes on, and when. It knows neither: time and width come from the
/// caller, so that a test can give them.
class ProgressBar {
  public:
    /// @param unit  of a step, in the plural: "cells"
    explicit ProgressBar(std::string unit) : m_unit(std::move(unit)) {}

    /// The state after @p progress, @p seconds after any fixed time. The rate is that since the first call.
    ProgressState state(const Progress& progress, double seconds);

    /// The text that draws the bar anew in its line; nothing within a tenth of a second after the last one.
    /// @param columns  of the terminal, asked anew each time: it may have been resized
    std::optional<std::string> draw(const Progress& progress, double seconds, std::size_t columns);

    /// The text that takes the bar away; empty if none was drawn.
    std::string clear();

  private:
    std::string m_unit{};
    std::optional<Progress> m_first{};
    double m_firstSeconds = 0;
    std::optional<double> m_drawnAt{};
};

}  // namespace gnomon
