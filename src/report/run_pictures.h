#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "matrix/cell.h"
#include "matrix/progress.h"
#include "profile/profile.h"
#include "report/picture_pack.h"
#include "scene/scene.h"

namespace gnomon {

/// What a run's cells were drawn with.
struct RunSources {
    std::map<std::string, Profile> profiles{};  ///< by id
    /// By id and Cell::view, which they were placed with.
    std::map<std::pair<std::string, std::map<std::string, std::string>>, Scene> scenes{};
};

/// The buffers after one pass; pictures are indices.
struct StripFrame {
    std::size_t pass = 0;  ///< from 1
    std::string title{}, why{};
    std::vector<std::pair<std::string, int>> buffers{};  ///< "colour", and "stencil" or "alpha"
};

/// The pictures of one cell, and of all that show the same.
struct CellDrawing {
    std::vector<std::size_t> cells{};  ///< indices into the run's
    int chunk = 0;                     ///< of its pictures but the strip's
    std::vector<std::pair<std::string, int>>
        pictures{};  ///< "image", "mask", "truth", "causes", "difference"
    std::vector<StripFrame> strip{};
    int stripChunk = -1;  ///< -1: the strip is left out
    std::string plan{};   ///< the passes with their reasons, for people
    /// Keys of flatCell() in which what was drawn is otherwise than in the run: "digest", and outcomes.
    std::vector<std::string> differs{};
    std::string error{};  ///< why it could not be drawn; then it has no pictures
    /// 0: the first of its scene and method, what a chip draws when no method is named, or what came out
    /// otherwise than the run has it; 1: the first of its verdict and causes too; 2: none of these.
    int news = 0;
};

/// The pictures of a run: of every chip, method and scene one frame, of those with the worst verdict the one
/// with the most wrong pixels, else the first that was drawn.
struct RunPictures {
    std::vector<CellDrawing> drawings{};
    std::vector<PackedPicture> pictures{};
    std::vector<PackedChunk> chunks{};
    /// By cell, of every chip, method and scene that is refused in all frames the first: the passes that the
    /// chip can't run, as CellDrawing::plan.
    std::map<std::size_t, std::string> refusedPlans{};
};

/// By chip, method and scene, the cell that is shown in pictures; indices in the order of @p cells. Refused
/// and failed cells show nothing.
std::vector<std::size_t> shownCells(const std::vector<Cell>& cells);

/// By chip, method and scene that no frame is drawn of, the first refused cell; indices as above.
std::vector<std::size_t> refusedCells(const std::vector<Cell>& cells);

/// Draws the shown cells of a run again in @p jobs processes.
/// @param progress  in cells
/// @pre every shown cell's profile and scene are in @p sources, and the scene has the cell's frame
/// A cell that comes out otherwise than the run has it, or can't be drawn, says so in its drawing.
RunPictures drawRun(const std::vector<Cell>& cells, const RunSources& sources, int jobs,
                    const ProgressListener& progress = {});

/// By cell that came out otherwise or could not be drawn, what is to be said of it.
std::vector<std::pair<std::size_t, std::string>> faultsOf(const RunPictures& pictures);

/// The same with what fits into @p bytes of deflated chunks: film strips that show the least new go first,
/// the last of the run first, then drawings in the same order.
RunPictures fitted(RunPictures all, std::size_t bytes);

}  // namespace gnomon
