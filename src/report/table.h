#pragma once

#include <string>
#include <vector>

namespace gnomon {

/// Lines up columns of text: the first column to the left, widths from the longest entry, two blanks between.
/// The first row is the head and is underlined.
std::string alignColumns(const std::vector<std::vector<std::string>>& rows);

/// One line of CSV (RFC 4180), with its line end.
std::string csvLine(const std::vector<std::string>& fields);

/// Breaks @p text at blanks so that no line is longer than @p width, each further line indented by @p indent
/// blanks.
std::string wrapText(const std::string& text, std::size_t indent, std::size_t width = 100);

}  // namespace gnomon
