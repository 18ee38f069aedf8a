#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "app/commands.h"
#include "app/options.h"
#include "cost/steady_memory.h"
#include "matrix/frontier.h"
#include "report/cost_report.h"

namespace gnomon {
namespace {

struct Options {
    SceneOption scenes{};
    ProfileOption profiles{};
    MethodOption methods{};
    SizeOption sizes{};
    FidelityOption fidelity{};
    EffectsOption effects{};
    FormatOption format{};
    std::vector<std::string> frames{};
    std::string output{};
    DeviceOption device{};
    int repeats = CostRequest{}.repeats;
};

/// Progress on standard error, and only to a terminal.
void showProgress(std::size_t done, std::size_t all) {
    if (!isatty(STDERR_FILENO)) return;
    fmt::print(stderr, "\r{} of {} steps{}", done, all, done == all ? "\n" : "");
    std::fflush(stderr);
}

std::vector<CostSetting> settingsOf(const Options& options, const Profile& profile) {
    const auto fidelities = options.fidelity.value({profile});
    const auto effects = options.effects.value();
    if (options.methods.isEmpty()) {
        const Shade shade = theOnly("--shade", options.methods.shadeList());
        return costSweep(profile, shade,
                         options.fidelity.words.empty() ? std::vector<FidelityChoice>{} : fidelities,
                         effects);
    }
    std::string dropped;
    const std::vector<Axes> methods = options.methods.axes(dropped);
    if (!dropped.empty()) fmt::print(stderr, "{}\n", dropped);
    return costSettings(profile, methods, fidelities, effects);
}

int run(const Options& options) {
    const Format format = options.format.value();
    checkPlotFile(options.output);
    const Size size = theOnly("--size", options.sizes.value());
    CostRequest request{.profile = theOnly("--profile", options.profiles.load({"ideal"})),
                        .reference = ProfileOption{.ids = {"ideal"}}.load().front(),
                        .width = size.width,
                        .height = size.height,
                        .repeats = options.repeats};
    request.settings = settingsOf(options, request.profile);
    Lab lab(theOnly("--scene", options.scenes.load({"roettger"})));
    lab.drawOn(options.device.value());
    const Scene& scene = lab.scene();
    if (!options.frames.empty()) request.frames = parseFrames(options.frames);
    for (const int frame : request.frames)
        if (frame >= int(scene.frames.size()))
            throw UsageError(
                fmt::format("--frames: {} has frames 0 to {}", scene.id, scene.frames.size() - 1));
    for (const std::string& note : scene.notes) fmt::print(stderr, "{}: {}\n", scene.id, note);

    keepFreedMemory();
    const CostStudy study = costStudy(lab, request, showProgress);
    fmt::print("{}", showCost(study, format));
    const bool isDrawn =
        std::any_of(study.rows.begin(), study.rows.end(), [](const CostRow& row) { return row.isDrawn(); });
    if (!isDrawn && !options.output.empty())
        fmt::print(stderr, "gnomon: {}: nothing to plot, all is refused\n", options.output);
    if (isDrawn && !options.output.empty()) {
        try {
            savePlots(costPlots(study), options.output);
        } catch (const std::runtime_error& error) {
            throw UsageError(error.what());  // the file is the user's choice
        }
    }
    const bool hasFailed = std::any_of(study.rows.begin(), study.rows.end(),
                                       [](const CostRow& row) { return !row.failure.empty(); });
    return hasFailed ? 3 : isDrawn ? 0 : 1;
}

}  // namespace

void addCost(CLI::App& app, int& status) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "cost",
        "What accuracy costs: each way to draw a scene's shadows, with its wrong pixels and its time as a\n"
        "multiple of the unshadowed frame on this machine; marks those that nothing beats in both.\n"
        "Without a method or axis: the named methods, and some with other levels, silhouettes, map sizes,\n"
        "arithmetic and depth formats.");
    options->scenes.addTo(*command, "scene: id, scene file, mesh file (default: roettger)");
    options->profiles.addTo(*command, "chip (default: ideal)");
    options->methods.addTo(*command);
    options->sizes.addTo(*command);
    command->add_option("--frames", options->frames, "frames of the camera path: 0,15 or 0-59 (default: 0)")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--repeats", options->repeats,
                     fmt::format("rounds of timing, of {} drawings each", kDrawingsPerRound))
        ->capture_default_str()
        ->check(CLI::Range(1, 10'000));
    options->fidelity.addTo(*command);
    options->effects.addTo(*command);
    command->add_option("-o,--output", options->output, "draw error against cost as an .svg or .png file");
    options->device.addTo(*command);
    options->format.addTo(*command);
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gnomon
