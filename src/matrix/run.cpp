#include "matrix/run.h"

#include <algorithm>

#include "matrix/cell_json.h"
#include "matrix/cell_worker.h"
#include "matrix/run_store.h"

namespace gnomon {

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

std::vector<Cell> runMatrix(const MatrixRequest& request, const ProgressListener& progress, RunStore* store) {
    const CellList list(request);
    const std::vector<std::size_t> places = placesOf(list, request.shard, request.past);
    std::vector<Cell> cells(places.size());
    Progress at{.all = places.size()};
    const auto count = [&](const Cell& cell) {
        ++at.done;
        at.failures += cell.verdict == Verdict::Failed;
    };

    // What is known need not be drawn.
    std::vector<CellTask> tasks;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (auto known = store ? store->take(places[i]) : std::nullopt) {
            cells[i] = std::move(*known);
            count(cells[i]);
            continue;
        }
        const std::size_t group = places[i] / list.perGroup();
        if (tasks.empty() || tasks.back().group != group) tasks.push_back({group, {}});
        tasks.back().places.push_back(places[i]);
    }
    if (progress) progress(at);

    std::vector<std::size_t> steps;
    for (const CellTask& task : tasks) steps.push_back(task.places.size());
    const auto make = [&](Whereabouts& whereabouts) {
        return std::make_unique<CellWorker>(list, tasks, whereabouts);
    };
    const auto ended = [&](std::size_t task, std::size_t step, StepEnd end) {
        const std::size_t place = tasks[task].places[step];
        Cell& cell =
            cells[std::size_t(std::lower_bound(places.begin(), places.end(), place) - places.begin())];
        if (end.error.empty()) {
            cell = cellFromJson(nlohmann::ordered_json::parse(end.result));
        } else {
            cell = list.blank(place);
            cell.error = std::move(end.error);
        }
        if (store) store->keep(place, cell, end.seconds);
        count(cell);
        if (progress) progress(at);
    };
    runSteps(steps, request.jobs, request.limits, make, ended);
    if (store) store->finish();
    return cells;
}

}  // namespace gnomon
