#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "matrix/cell.h"
#include "report/page.h"
#include "report/reproduce_roettger2002_table2.h"

namespace gnomon {

/// One figure of a paper beside the same figure of ours.
struct Comparison {
    std::string buffer{}, shade{};  ///< "alpha", "attenuated"
    bool maximum = false;           ///< with the maximum blend equation: the figures in brackets
    int publishedScene = 0, publishedRectangles = 0;
    Axes axes{};
    PassCounts counted{}, planned{};  ///< at the capability layer; the plan's length

    bool agrees() const;
};

/// The rows of Table 1 of Roettger et al. 2002, without our figures: passes that draw the scene, and
/// rectangles over the whole window.
std::vector<Comparison> roettgerTable1();

std::string showComparisons(const std::vector<Comparison>& rows, const Page& page);
nlohmann::ordered_json comparisonsJson(const std::vector<Comparison>& rows);

/// What `gnomon reproduce roettger2002` prints: one table or both. JSON is one array: the rows of Table 1,
/// then Table 2 as one object.
/// @pre CSV: one table
std::string showRoettger2002(const std::optional<std::vector<Comparison>>& table1,
                             const std::optional<Table2>& table2, const Page& page);

}  // namespace gnomon
