#include "matrix/run.h"

#include <algorithm>

#include "matrix/cell_json.h"
#include "matrix/cell_worker.h"

namespace gnomon {
namespace {

std::vector<CellGroup> groupsOf(const MatrixRequest& request) {
    std::vector<CellGroup> groups;
    for (const Scene& scene : request.scenes)
        for (const Size& size : request.sizes)
            for (const int frame : framesOf(request, scene)) groups.push_back({&scene, size, frame});
    return groups;
}

Cell failedCell(const MatrixRequest& request, const CellGroup& group, std::size_t index, std::string error) {
    Cell cell = blankCell(request, group, index);
    cell.error = std::move(error);
    return cell;
}

}  // namespace

void addQuestion(Cell& cell, const FidelityChoice& fidelity, const std::map<std::string, std::string>& view) {
    cell.dithers = fidelity.dithers;
    if (fidelity.unit) cell.blendUnit = name(*fidelity.unit);
    cell.view = view;
}

std::vector<int> framesOf(const MatrixRequest& request, const Scene& scene) {
    const int all = int(scene.frames.size());
    std::vector<int> frames = request.frames;
    if (frames.empty())
        for (int i = 0; i < 12; ++i) frames.push_back(i * all / 12);
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    std::erase_if(frames, [&](int f) { return f >= all; });
    return frames;
}

std::vector<Cell> runMatrix(const MatrixRequest& request, const ProgressListener& progress) {
    const std::vector<CellGroup> groups = groupsOf(request);
    const std::size_t perGroup = cellsPerGroup(request);
    std::vector<Cell> cells(groups.size() * perGroup);
    Progress at{.all = cells.size()};
    if (progress) progress(at);
    const auto make = [&](Whereabouts& whereabouts) {
        return std::make_unique<CellWorker>(request, groups, whereabouts);
    };
    const auto ended = [&](std::size_t group, std::size_t index, StepEnd end) {
        Cell& cell = cells[group * perGroup + index];
        cell = end.error.empty() ? cellFromJson(nlohmann::ordered_json::parse(end.result))
                                 : failedCell(request, groups[group], index, std::move(end.error));
        ++at.done;
        at.failures += cell.verdict == Verdict::Failed;
        if (progress) progress(at);
    };
    runSteps(std::vector<std::size_t>(groups.size(), perGroup), request.jobs, request.limits, make, ended);
    return cells;
}

}  // namespace gnomon
