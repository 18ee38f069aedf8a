// Cells in worker processes, each isolated from the others: frames of 64x48 with two workers, each frame's
// truth included. Beside them a process for each cell.

#include <signal.h>

#include <chrono>
#include <stdexcept>

#include "bench/speed/speed_row.h"
#include "matrix/lab.h"
#include "matrix/pool.h"
#include "matrix/run.h"
#include "profile/shipped.h"
#include "scene/load.h"

namespace gnomon {
namespace {

constexpr int kWorkers = 2;
constexpr int kSeconds = 600;  ///< for a job of one cell: no limit here

double secondsOf(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

MatrixRequest requestOf(int frames) {
    MatrixRequest request;
    request.profiles = {chip("ideal")};
    request.methods = {findMethod("heidmann")->axes};
    request.scenes = {loadScene(GNOMON_SOURCE "/scenes/boxes.toml")};
    request.sizes = {{64, 48}};
    for (int f = 0; f < frames; ++f) request.frames.push_back(f);
    request.jobs = kWorkers;
    return request;
}

/// Every cell by a process of its own.
void runInJobs(const MatrixRequest& request) {
    std::vector<Job> jobs;
    for (const int frame : request.frames)
        jobs.push_back({"cell", [&request, frame](const auto& emit) {
                            Lab lab(request.scenes.front());
                            const Size size = request.sizes.front();
                            emit(lab.run(request.profiles.front(), request.methods.front(), size.width,
                                         size.height, frame)
                                     .digest);
                        }});
    runJobs(jobs, kWorkers, kSeconds, [](std::size_t, const JobEnd& end) {
        if (end.lines.size() != 1) throw std::runtime_error(end.error);
    });
}

SpeedRow row(bool crashes, const std::string& name, const std::string& what) {
    return {.name = "Workers/" + name,
            .what = "cells in two workers, 64x48: " + what,
            .bar = Bar::AtLeast,
            .target = 40,
            .unit = "/s",
            .sides = "/s (a process each)",
            .prepare = [=](Load load) -> Round {
                MatrixRequest request = requestOf(load == Load::Full ? 60 : 3);
                MatrixRequest workers = request;
                if (crashes)
                    workers.atStage = [](const std::string&, const std::string& stage) {
                        if (stage.starts_with("pass 1 ")) raise(SIGKILL);
                    };
                return [=] {
                    const Verdict expected = crashes ? Verdict::Failed : Verdict::Exact;
                    const double cells = double(request.frames.size());
                    const double ours = cells / secondsOf([&] {
                                            for (const Cell& cell : runMatrix(workers))
                                                if (cell.verdict != expected)
                                                    throw std::logic_error(cell.id());
                                        });
                    return Measured{ours, ours, cells / secondsOf([&] { runInJobs(request); })};
                };
            }};
}

}  // namespace

std::vector<SpeedRow> workerRows() {
    return {row(false, "Cells", "all good"), row(true, "Kills", "each one kills its worker")};
}

}  // namespace gnomon
