#pragma once

#include <filesystem>
#include <vector>

#include "matrix/cell_store.h"

namespace gnomon {

/// Puts all shards of one run together as one run in @p folder, or again in the place of the same one. It is
/// there whole or not at all; pictures are linked, or copied to another disk. Memory doesn't grow with the
/// number of cells.
/// @return the store of the whole
/// @throws StoreError  a shard is missing, not at its end, there twice, of another run, or damaged
CellStore mergedShards(const std::vector<std::filesystem::path>& shards, const std::filesystem::path& folder);

/// What is missing of a run: "120 of 378 cells"; "" if nothing is.
std::string missingOf(const CellStore& store);

}  // namespace gnomon
