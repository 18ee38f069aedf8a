#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "matrix/cell.h"

namespace gnomon {

/// The JSON object of a cell. Numbers and lists are there even when they are empty; "error" is there for a
/// failed cell only.
nlohmann::ordered_json toJson(const Cell& cell);

/// The same without its times, and by whose clock they are: what two runs must have in common.
nlohmann::ordered_json withoutTimes(const Cell& cell);

/// Over withoutTimes(): equal where two runs say the same of a cell.
std::uint64_t contentDigest(const Cell& cell);

/// Inverse of toJson().
/// @throws nlohmann::json::exception if @p json isn't such an object
Cell cellFromJson(const nlohmann::ordered_json& json);

}  // namespace gnomon
