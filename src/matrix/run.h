#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gl/chip_arithmetic.h"
#include "gl/device.h"
#include "matrix/cell.h"
#include "matrix/progress.h"
#include "matrix/shard.h"
#include "matrix/workers.h"
#include "needs/effects.h"
#include "profile/profile.h"
#include "scene/scene.h"

namespace gnomon {

class RunStore;

struct Size {
    int width = 320, height = 240;  ///< what all chips of the table ran but the Nintendo DS
};

/// What a run covers: the product of its lists.
struct MatrixRequest {
    std::vector<Profile> profiles{};
    std::vector<Axes> methods{};
    std::vector<Scene> scenes{};
    std::vector<Size> sizes{};
    /// Frames of the camera path; those beyond a scene's path are left out. Empty: twelve, a twelfth of
    /// the path apart.
    std::vector<int> frames{};
    std::vector<FidelityChoice> fidelities{{}};
    std::optional<Effects> effects{};           ///< Lab::simulate()
    std::map<std::string, std::string> view{};  ///< Cell::view of all cells: how the scenes were placed
    Device device = defaultDevice();            ///< Lab::drawOn()
    int jobs = 1;
    StepLimits limits{};                    ///< of each cell
    Shard shard{};                          ///< the part of all that is drawn
    PastCosts past{};                       ///< what shards are balanced by
    std::filesystem::path pictureFolder{};  ///< where each image and mask goes; empty: nowhere
    /// Called in a worker's process as it enters a stage of a cell, "" the first; so that tests can plant
    /// faults there. While a frame is made ready, the cell is "".
    std::function<void(const std::string& cell, const std::string& stage)> atStage{};
};

/// Adds to @p cell what was chosen besides its method and fidelity, so that it can be drawn again from its
/// record.
/// @param view  Cell::view
void addQuestion(Cell& cell, const FidelityChoice& fidelity, const std::map<std::string, std::string>& view);

/// Frames of @p scene that @p request asks for.
std::vector<int> framesOf(const MatrixRequest& request, const Scene& scene);

/// Runs all cells of a shard in request.jobs worker processes; a crash, or one beyond the limits, costs its
/// own cell only: it is failed, with how and in which pass. The order of cells is that of CellList whatever
/// ends first.
///
/// @param progress  in cells: at the start, and as each comes in
/// @param store     has cells that need not be drawn, and keeps the others before progress is told of them
std::vector<Cell> runMatrix(const MatrixRequest& request, const ProgressListener& progress = {},
                            RunStore* store = nullptr);

}  // namespace gnomon
