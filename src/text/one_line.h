#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// Whether @p text can stand in a line, a message or a table: no control character but tabs.
bool isOneLine(std::string_view text);

/// @p text with a blank for every character that keeps it from being one.
std::string oneLine(std::string text);

}  // namespace gnomon
