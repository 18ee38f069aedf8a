#pragma once

#include <string>
#include <vector>

#include "matrix/cell.h"
#include "report/page.h"

namespace gnomon {

/// The matrix for a person: one table per scene and size, methods by chips; frames are drawn together, the
/// worst verdict counts and the wrong pixels add up. Chips with equal columns share one, wide tables go on in
/// further blocks. Causes are spelled out below each table, refusals once for all tables.
std::string matrixText(const std::vector<Cell>& cells, const Page& page = {});

/// One array of cells.
std::string matrixJson(const std::vector<Cell>& cells);

/// One line per cell under a head line; nested values are flattened ("wrong_edge"), lists joined by "; ".
std::string matrixCsv(const std::vector<Cell>& cells);

}  // namespace gnomon
