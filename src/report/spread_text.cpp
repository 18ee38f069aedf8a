#include "report/spread_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace gnomon {
namespace {

/// To three digits, without an exponent.
std::string digits(double value) {
    const double size = std::abs(value);
    return fmt::format("{:.{}f}", value, size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 || size == 0 ? 2 : 3);
}

}  // namespace

std::string spreadText(const Spread& spread) {
    return fmt::format("{} ({} to {})", digits(spread.median), digits(spread.low), digits(spread.high));
}

nlohmann::ordered_json spreadJson(const Spread& spread) {
    return {{"median", spread.median}, {"low", spread.low}, {"high", spread.high}};
}

}  // namespace gnomon
