#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "matrix/cell.h"
#include "report/mask_states.h"
#include "report/run_compare.h"
#include "report/run_pictures.h"

namespace gnomon {

/// What stands above a run.
struct RunTitle {
    std::string command{};  ///< "gnomon matrix boxes"
    std::string program{};  ///< "gnomon 0.1.0"
};

/// What a report shows.
struct Report {
    RunTitle title{};
    std::vector<Cell> cells{};
    RunSources sources{};
    RunPictures pictures{};
    std::vector<MaskStates> states{};
    std::optional<RunTitle> before{};    ///< of the run that this one is compared with
    std::vector<ChangeGroup> changes{};  ///< what differs from that
};

/// A run as the report's page reads it: cells by columns, the chips' facts, methods, scenes, pictures, states
/// of masks, changes.
nlohmann::ordered_json runJson(const Report& report);

/// The same for other programs, without pictures: cells as `gnomon matrix --format json` has them, each with
/// the "plan" that the page shows of it, and "differs" and "error" where it came out otherwise than its run
/// has it.
nlohmann::ordered_json wordsJson(const Report& report);

/// The keys of a cell's JSON object with their values, those of objects within by "passes.scene"; "causes"
/// and "view", whose keys are the cell's own, stay objects. Without the id.
std::vector<std::pair<std::string, nlohmann::ordered_json>> flatCell(const Cell& cell);

}  // namespace gnomon
