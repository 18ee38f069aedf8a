#pragma once

#include <optional>
#include <string>

#include "matrix/cell.h"
#include "matrix/cell_store.h"

namespace gnomon {

/// @p cell as it is kept.
StoredCell storedCell(std::size_t place, std::uint64_t key, const Cell& cell, double seconds);

/// The cell that @p stored holds; nothing if it is not what was written.
std::optional<Cell> cellIn(const StoredCell& stored);

}  // namespace gnomon
