#include "report/json_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

std::string fieldText(const Json& value) {
    if (value.is_null()) return "";
    if (value.is_string()) return value.get<std::string>();
    if (value.is_object()) return fieldText(value.at("what"));
    if (!value.is_array()) return value.dump();
    std::string text;
    for (const Json& entry : value) text += fmt::format("{}{}", text.empty() ? "" : "; ", fieldText(entry));
    return text;
}

/// Adds the fields of @p object to @p fields, and their names to @p names where they are new.
void flatten(const Json& object, const std::string& before, std::vector<std::string>& names,
             std::map<std::string, std::string>& fields) {
    for (const auto& [key, value] : object.items()) {
        const std::string name = before.empty() ? key : fmt::format("{}_{}", before, key);
        if (value.is_object()) {
            flatten(value, name, names, fields);
            continue;
        }
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        fields[name] = fieldText(value);
    }
}

}  // namespace

std::string csvOf(const Json& rows) {
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> lines;
    for (const Json& row : rows) flatten(row, "", names, lines.emplace_back());
    std::string text = csvLine(names);
    for (auto& line : lines) {
        std::vector<std::string> fields;
        for (const std::string& name : names) fields.push_back(line[name]);
        text += csvLine(fields);
    }
    return text;
}

}  // namespace gnomon
