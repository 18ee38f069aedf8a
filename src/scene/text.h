#pragma once

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/load.h"

namespace gnomon {

/// @p text with everything that would break a one-line message replaced, and cut to a readable length.
std::string printable(std::string_view text);

[[noreturn]] void fail(const std::filesystem::path& file, std::string_view what);
[[noreturn]] void fail(const std::filesystem::path& file, std::size_t line, std::string_view what);

/// All bytes of a regular file.
/// @throws SceneError if it is none, has more than @p most bytes, or can't be read
std::string readWhole(const std::filesystem::path& file, std::uint64_t most);

/// The lines of a text, "\n" or "\r\n", numbered from 1.
class Lines {
  public:
    explicit Lines(std::string_view text) : m_rest(text) {}

    /// Goes on to the next line; false at the end.
    bool next();
    std::string_view line() const { return m_line; }
    std::size_t number() const { return m_number; }

    /// What follows the line.
    std::string_view rest() const { return m_rest; }

  private:
    std::string_view m_rest;
    std::string_view m_line{};
    std::size_t m_number = 0;
};

/// Words between blanks, without copies; @p words is reused.
void splitWords(std::string_view line, std::vector<std::string_view>& words);

/// The whole of @p word as a number; infinite or NaN where it says so or where it doesn't fit.
std::optional<double> parseNumber(std::string_view word);

template <typename Integer>
std::optional<Integer> parseInteger(std::string_view word) {
    Integer value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return {};
    return value;
}

/// Why a coordinate can't be used; empty if it can.
std::string coordinateFault(double value);

}  // namespace gnomon
