#pragma once

#include <string>
#include <vector>

#include "matrix/frontier.h"
#include "report/page.h"
#include "report/plot.h"

namespace gnomon {

/// The settings of a study with error and cost, exact ones first, then what was refused and why. JSON is one
/// object per setting.
std::string showCost(const CostStudy& study, const Page& page);

/// Error against time, and below it error against touched pixels, with their frontiers.
/// @pre some setting was drawn
std::vector<Plot> costPlots(const CostStudy& study);

}  // namespace gnomon
