#include "matrix/stored_cell.h"

#include "matrix/cell_json.h"

namespace gnomon {

StoredCell storedCell(std::size_t place, std::uint64_t key, const Cell& cell, double seconds) {
    return {.place = place,
            .key = key,
            .verdict = name(cell.verdict),
            .seconds = seconds,
            .digest = contentDigest(cell),
            .cell = toJson(cell).dump()};
}

std::optional<Cell> cellIn(const StoredCell& stored) {
    constexpr double kLongest = 1e9;  // seconds; a comparison with not a number is false
    try {
        Cell cell = cellFromJson(nlohmann::ordered_json::parse(stored.cell));
        const bool isWhole = contentDigest(cell) == stored.digest && name(cell.verdict) == stored.verdict;
        if (isWhole && stored.seconds >= 0 && stored.seconds <= kLongest) return cell;
    } catch (const std::exception&) {
        // A text that is no cell is as damaged as one that says something else.
    }
    return std::nullopt;
}

}  // namespace gnomon
