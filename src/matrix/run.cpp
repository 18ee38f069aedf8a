#include "matrix/run.h"

#include <algorithm>

#include "matrix/cell_json.h"
#include "matrix/lab.h"
#include "matrix/pool.h"

namespace gnomon {
namespace {

/// All cells of one scene, size and frame: they share truth and geometry, so one process draws them.
struct Group {
    const Scene* scene = nullptr;
    Size size{};
    int frame = 0;
};

std::vector<Group> groupsOf(const MatrixRequest& request) {
    std::vector<Group> groups;
    for (const Scene& scene : request.scenes)
        for (const Size& size : request.sizes)
            for (const int frame : framesOf(request, scene)) groups.push_back({&scene, size, frame});
    return groups;
}

void runGroup(const MatrixRequest& request, const Group& group,
              const std::function<void(std::string)>& emit) {
    Lab lab(*group.scene);
    lab.drawOn(request.device);
    const auto [width, height] = group.size;
    std::vector<std::string> chosen;
    for (const Profile& profile : request.profiles) {
        const auto path = lab.path(profile, width, height, group.frame);
        chosen.push_back(path.back().missing.empty() ? methodId(path.back().axes) : "");
    }
    for (const FidelityChoice& fidelity : request.fidelities) {
        lab.use(fidelity);
        lab.simulate(request.effects);
        for (const Axes& axes : request.methods) {
            for (std::size_t p = 0; p < request.profiles.size(); ++p) {
                Cell cell = lab.run(request.profiles[p], axes, width, height, group.frame);
                cell.chosen = cell.method == chosen[p];
                addQuestion(cell, fidelity, request.view);
                emit(toJson(cell).dump());
            }
        }
    }
}

Cell failedCell(const MatrixRequest& request, const Group& group, const FidelityChoice& fidelity,
                const Axes& axes, const Profile& profile, const std::string& error) {
    Cell cell;
    addQuestion(cell, fidelity, request.view);
    cell.device = name(request.device);
    cell.fidelity = name(fidelity.fidelity);
    cell.profile = profile.id, cell.method = methodId(axes), cell.scene = group.scene->id;
    cell.axes = axes;
    cell.width = group.size.width, cell.height = group.size.height, cell.frame = group.frame;
    cell.pixels = cell.width * cell.height;
    cell.error = error;
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
    const std::vector<Group> groups = groupsOf(request);
    const std::size_t perFidelity = request.methods.size() * request.profiles.size();
    const std::size_t perGroup = request.fidelities.size() * perFidelity;
    std::vector<Job> jobs;
    for (const Group& group : groups) {
        jobs.push_back({group.scene->id, [&request, &group](const std::function<void(std::string)>& emit) {
                            runGroup(request, group, emit);
                        }});
    }

    std::vector<Cell> cells(groups.size() * perGroup);
    std::vector<std::size_t> doneOf(groups.size());
    Progress at{.all = cells.size()};
    if (progress) progress(at);
    const auto add = [&](std::size_t job, Cell cell) {
        at.failures += cell.verdict == Verdict::Failed;
        cells[job * perGroup + doneOf[job]++] = std::move(cell);
        ++at.done;
        if (progress) progress(at);
    };
    const auto arrived = [&](std::size_t job, const std::string& line) {
        add(job, cellFromJson(nlohmann::ordered_json::parse(line)));
    };
    const auto ended = [&](std::size_t job, const JobEnd& end) {
        while (doneOf[job] < perGroup) {
            const std::size_t i = doneOf[job];
            add(job, failedCell(request, groups[job], request.fidelities[i / perFidelity],
                                request.methods[i % perFidelity / request.profiles.size()],
                                request.profiles[i % request.profiles.size()], end.error));
        }
    };
    runJobs(jobs, request.jobs, request.secondsPerJob, ended, arrived);
    return cells;
}

}  // namespace gnomon
