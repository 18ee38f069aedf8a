#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "matrix/cell.h"

namespace gnomon {

/// A run that can't be read. what() is one line, "file:line: what", or "file: what" if it can't be opened.
struct RunError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A run with the line of each of its cells, for messages.
struct RunRecord {
    std::string file{};
    std::vector<Cell> cells{};
    std::vector<int> lines{};  ///< by cell, from 1; 0 where a store has none

    /// An error about cell @p index.
    RunError error(std::size_t index, const std::string& what) const;
};

/// Reads what `gnomon matrix --format json` wrote, or a folder of `--out`. Every cell must have all keys of a
/// cell and no other, each with a value that a cell can have, and no two cells may answer the same question.
/// @throws RunError, StoreError
RunRecord readRun(const std::filesystem::path& file);

/// The same of @p text; @p file is for messages.
RunRecord parseRun(const std::string& file, const std::string& text);

}  // namespace gnomon
