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
                emit(toJson(cell).dump());
            }
        }
    }
}

Cell failedCell(const Group& group, Device device, const FidelityChoice& fidelity, const Axes& axes,
                const Profile& profile, const std::string& error) {
    Cell cell;
    cell.device = name(device);
    cell.fidelity = name(fidelity.fidelity);
    cell.profile = profile.id, cell.method = methodId(axes), cell.scene = group.scene->id;
    cell.axes = axes;
    cell.width = group.size.width, cell.height = group.size.height, cell.frame = group.frame;
    cell.pixels = cell.width * cell.height;
    cell.error = error;
    return cell;
}

}  // namespace

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

std::vector<Cell> runMatrix(const MatrixRequest& request,
                            const std::function<void(std::size_t, std::size_t)>& progress) {
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
    std::size_t done = 0;
    runJobs(jobs, request.jobs, request.secondsPerJob, [&](std::size_t job, JobEnd end) {
        for (std::size_t i = 0; i < perGroup; ++i) {
            Cell& cell = cells[job * perGroup + i];
            if (i < end.lines.size())
                cell = cellFromJson(nlohmann::ordered_json::parse(end.lines[i]));
            else
                cell = failedCell(groups[job], request.device, request.fidelities[i / perFidelity],
                                  request.methods[i % perFidelity / request.profiles.size()],
                                  request.profiles[i % request.profiles.size()], end.error);
        }
        done += perGroup;
        if (progress) progress(done, cells.size());
    });
    return cells;
}

}  // namespace gnomon
