#pragma once

#include <string>
#include <vector>

#include "report/page.h"

namespace gnomon {

/// Columns that @p text takes on a terminal: code points, which is enough for the texts that gnomon prints;
/// escape sequences of colours take none.
std::size_t textWidth(const std::string& text);

/// Lines up columns of text: the first column to the left, widths from the longest entry, two blanks between.
/// The first row is the head and is underlined.
///
/// A table that is wider than @p width goes on in further lines within its long entries where they have words
/// to break between; else in further blocks, each after the first @p keys columns again. Where rows can't be
/// told apart by these, blocks are held together by a column of row numbers instead.
std::string alignColumns(const std::vector<std::vector<std::string>>& rows, std::size_t width = kPageColumns,
                         std::size_t keys = 1);

/// One line of CSV (RFC 4180), with its line end.
std::string csvLine(const std::vector<std::string>& fields);

/// Breaks @p text at blanks so that no line is longer than @p width, each further line indented by @p indent
/// blanks.
std::string wrapText(const std::string& text, std::size_t indent, std::size_t width = kPageColumns);

}  // namespace gnomon
