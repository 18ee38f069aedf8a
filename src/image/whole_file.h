#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace gnomon {

/// Makes @p file appear whole or not at all: @p write writes it beside its place under another name of the
/// same ending, and it is renamed. A link stays, and what it leads to is written. An interrupt waits for it.
/// @throws std::runtime_error  "file: what", in one line, of what @p write throws or if it can't be renamed;
/// then nothing is left of it
void writeWhole(const std::filesystem::path& file,
                const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same of a text.
void writeWhole(const std::filesystem::path& file, std::string_view text);

/// Tries whether writeWhole() could write there, and leaves nothing.
/// @throws std::runtime_error  "file: what", in one line
void tryWhole(const std::filesystem::path& file);

}  // namespace gnomon
