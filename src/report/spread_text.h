#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cost/spread.h"

namespace gnomon {

/// "1.83 (1.80 to 1.86)": the median, and the quartiles; to three digits.
std::string spreadText(const Spread& spread);

/// {"median":1.83,"low":1.80,"high":1.86}
nlohmann::ordered_json spreadJson(const Spread& spread);

}  // namespace gnomon
