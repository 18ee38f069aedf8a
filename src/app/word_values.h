#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/options.h"
#include "method/from_words.h"

namespace gnomon {

/// The value of an enumeration of @p count values that is called @p word.
/// @throws UsageError  "flag: what", with the words that there are
template <class Enum>
Enum wordOf(const std::string& flag, const std::string& word, int count) {
    if (const auto value = fromWord<Enum>(word, count)) return *value;
    std::vector<std::string> known;
    for (int i = 0; i < count; ++i) known.push_back(name(Enum(i)));
    throw UsageError(fmt::format("{}: no such value '{}' (known: {})", flag, word, fmt::join(known, ", ")));
}

/// Those of @p words, each once.
template <class Enum>
std::vector<Enum> wordsOf(const std::string& flag, const std::vector<std::string>& words, int count) {
    std::vector<Enum> values;
    for (const std::string& word : words) {
        const Enum value = wordOf<Enum>(flag, word, count);
        if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    }
    return values;
}

/// The words of an enumeration, for help texts.
template <class Enum>
std::string listOf(int count) {
    std::vector<std::string> known;
    for (int i = 0; i < count; ++i) known.push_back(name(Enum(i)));
    return fmt::format("{}", fmt::join(known, ", "));
}

}  // namespace gnomon
