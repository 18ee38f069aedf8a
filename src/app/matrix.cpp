#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "app/commands.h"
#include "app/options.h"
#include "app/report_file.h"
#include "app/terminal.h"
#include "report/matrix_report.h"

namespace gnomon {
namespace {

struct Options {
    ProfileOption profiles{};
    SceneOption scenes{};
    MethodOption methods{};
    SizeOption sizes{};
    FidelityOption fidelity{};
    EffectsOption effects{};
    FormatOption format{};
    DeviceOption device{};
    ReportFile report{};
    std::vector<std::string> frames{};
    int jobs = int(std::max(1u, std::thread::hardware_concurrency()));
};

int run(const Options& options) {
    options.report.check();
    MatrixRequest request;
    std::string dropped;
    request.methods = options.methods.axes(dropped);
    request.sizes = options.sizes.value();
    request.frames = parseFrames(options.frames);
    request.profiles = options.profiles.load();
    request.scenes = options.scenes.load();
    request.fidelities = options.fidelity.value(request.profiles);
    request.device = options.device.value();
    request.effects = options.effects.value();
    request.view = options.scenes.view();
    request.jobs = options.jobs;
    for (const Scene& scene : request.scenes) {
        if (framesOf(request, scene).empty()) checkFrame("--frames", request.frames.front(), scene);
        const int last = int(scene.frames.size()) - 1;
        for (const int frame : request.frames)
            if (frame > last) {
                fmt::print(stderr, "{}: no frame {}, the path has 0 to {}\n", scene.id, frame, last);
                break;
            }
        for (const std::string& note : scene.notes) fmt::print(stderr, "{}: {}\n", scene.id, note);
    }
    if (!dropped.empty()) fmt::print(stderr, "{}\n", dropped);

    TerminalProgress bar("cells");
    const std::vector<Cell> cells = runMatrix(request, [&](const Progress& at) { bar.show(at); });
    bar.clear();
    const Page page = options.format.value();
    fmt::print("{}", page.format == Format::Json  ? matrixJson(cells)
                     : page.format == Format::Csv ? matrixCsv(cells)
                                                  : matrixText(cells, page));
    bool hasFailed = std::any_of(cells.begin(), cells.end(),
                                 [](const Cell& cell) { return cell.verdict == Verdict::Failed; });
    if (options.report.isWanted()) {
        RunSources sources;
        for (const Profile& profile : request.profiles) sources.profiles.emplace(profile.id, profile);
        for (const Scene& scene : request.scenes)
            sources.scenes.emplace(std::pair(scene.id, request.view), scene);
        const auto faults = options.report.write(cells, sources, options.jobs);
        sayFaults(faults, [&](std::size_t i) { return cells[i].id(); });
        hasFailed = hasFailed || !faults.empty();
    }
    return hasFailed ? 3 : 0;
}

}  // namespace

void addMatrix(CLI::App& app, int& status) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "matrix",
        "The main job: draws each scene with each method on each chip, compares every pixel with ray-traced\n"
        "truth, and says of each cell: exact, edge, wrong (why), refused (what is missing), failed.\n"
        "Leave a choice out to run all.");
    options->scenes.addTo(*command, "scenes: ids, scene files, mesh files");
    options->profiles.addTo(*command, "chips (gnomon profiles lists them)");
    options->methods.addTo(*command);
    options->sizes.addTo(*command);
    command
        ->add_option("--frames", options->frames,
                     "frames of the camera path: 0,15 or 0-59 (default: twelve, a twelfth of the path apart)")
        ->delimiter(',')
        ->allow_extra_args(false);
    options->fidelity.addTo(*command);
    options->effects.addTo(*command);
    options->device.addTo(*command);
    options->format.addTo(*command);
    options->format.addColourTo(*command);
    options->report.addTo(*command, "--report");
    command->add_option("--jobs", options->jobs, "worker processes (default: one per core)")
        ->check(CLI::Range(1, 256));
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gnomon
