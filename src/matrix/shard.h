#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace gnomon {

class CellList;

/// One part of a run that is done in @p count parts, on as many machines.
struct Shard {
    int index = 1, count = 1;  ///< index from 1
    auto operator<=>(const Shard&) const = default;
};

/// Seconds that cells took in an earlier run: by scene, width, height, frame and profile.
using PastCosts = std::map<std::tuple<std::string, int, int, int, std::string>, double>;

/// The places of the cells in @p shard, ascending. Shards are disjoint and together all cells, and depend on
/// the arguments only: whoever asks gets the same. They are balanced by @p past, by pixels where there is
/// none: groups, cut by profile where there are few, go to the shard that has least by then, the most
/// expensive first (longest processing time; Graham 1969, SIAM J. Appl. Math. 17, 2).
std::vector<std::size_t> placesOf(const CellList& list, const Shard& shard, const PastCosts& past = {});

}  // namespace gnomon
