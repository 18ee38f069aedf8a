#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gnomon {

/// The objects of a JSON array as CSV, with all that they hold, a line each. A column for each key that any
/// of them has, in the order in which they come; keys of nested objects follow on theirs: "wrong_edge". A
/// list has its entries with "; " between, of objects the entry "what"; null and missing keys are empty
/// fields.
/// @pre each entry of @p rows is an object
std::string csvOf(const nlohmann::ordered_json& rows);

}  // namespace gnomon
