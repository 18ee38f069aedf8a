#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "matrix/cell.h"
#include "report/page.h"

namespace gnomon {

/// A cell that two runs have otherwise: by key as flatCell() has them, what differs. A cell of one run only
/// has no values on the other side.
struct CellChange {
    std::string cell{};  ///< its id
    nlohmann::ordered_json before{}, after{};
};

/// Changes that have the same reason.
struct ChangeGroup {
    std::string
        cause{};  ///< "verdict: exact -> edge", "fewer wrong pixels", "passes: 2/4/3/0 -> 2/4/2/0", ...
    std::vector<CellChange> cells{};
};

/// What differs between the answers of two runs to the same questions (Cell::question()), the gravest first:
/// verdicts, limits, wrong pixels, causes, predictions, passes, pictures, and the rest. A cell stands in one
/// group. Times, and on what and by whose clock they were taken, are no changes.
std::vector<ChangeGroup> changesBetween(const std::vector<Cell>& before, const std::vector<Cell>& after);

/// For people, by group with at most a few cells of each; JSON and CSV have all. In CSV a cell of one run
/// only is one row, with its verdict.
std::string showChanges(const std::vector<ChangeGroup>& groups, std::size_t cellsBefore,
                        std::size_t cellsAfter, const Page& page);

/// A list of groups: cause, and cells with their old and new values.
nlohmann::ordered_json changesJson(const std::vector<ChangeGroup>& groups);

}  // namespace gnomon
