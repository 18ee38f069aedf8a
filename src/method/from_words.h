#pragma once

#include <map>
#include <optional>
#include <string>

#include "method/method.h"

namespace gnomon {

/// The value of an enumeration of @p count values that is called @p word.
template <class Enum>
std::optional<Enum> fromWord(const std::string& word, int count) {
    for (int i = 0; i < count; ++i)
        if (name(Enum(i)) == word) return Enum(i);
    return std::nullopt;
}

/// "1" and "1/2" or "0.5" and the like: 1, 2, 4.
std::optional<int> maskDivisorOf(const std::string& word);

/// What a store is used with where nothing else is said.
Axes defaultsOf(Store store);

/// A named method with some of its axes changed, as the command line's flags would.
/// @param options  flag without dashes -> value, such as "levels" -> "4"
/// @throws std::runtime_error of one line for an unknown word, a value out of range, or a contradiction
Axes axesFromWords(const std::string& method, const std::map<std::string, std::string>& options);

}  // namespace gnomon
