#include <fmt/format.h>

#include <cstdio>

#include "app/commands.h"
#include "app/options.h"
#include "app/output_file.h"
#include "app/terminal.h"
#include "cost/steady_memory.h"
#include "matrix/frontier.h"
#include "report/cost_report.h"

namespace gnomon {
namespace {

struct CostOptions {
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
    int repeats = 0;  ///< 0: as the number of frames calls for
};

std::vector<CostSetting> settingsOf(const CostOptions& options, const Profile& profile) {
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

int run(const CostOptions& options) {
    const Page page = options.format.value();
    checkPlotFile(options.output);
    const Size size = theOnly("--size", options.sizes.value());
    CostRequest request{.profile = theOnly("--profile", options.profiles.load({"ideal"})),
                        .reference = ProfileOption{.ids = {"ideal"}}.load().front(),
                        .width = size.width,
                        .height = size.height};
    request.settings = settingsOf(options, request.profile);
    Lab lab(theOnly("--scene", options.scenes.load({"roettger"})));
    lab.drawOn(options.device.value());
    const Scene& scene = lab.scene();
    if (!options.frames.empty()) request.frames = parseFrames(options.frames);
    request.repeats = options.repeats ? options.repeats : defaultRepeats(request.frames.size());
    for (const int frame : request.frames) checkFrame("--frames", frame, scene);
    for (const std::string& note : scene.notes) fmt::print(stderr, "{}: {}\n", scene.id, note);

    keepFreedMemory();
    TerminalProgress bar("steps");
    const CostStudy study = costStudy(
        lab, request, [&](std::size_t done, std::size_t all) { bar.show({.done = done, .all = all}); });
    bar.clear();
    fmt::print("{}", showCost(study, page));
    const bool isDrawn =
        std::any_of(study.rows.begin(), study.rows.end(), [](const CostRow& row) { return row.isDrawn(); });
    if (!isDrawn && !options.output.empty())
        fmt::print(stderr, "gnomon: {}: nothing to plot, all is refused\n", options.output);
    if (isDrawn && !options.output.empty()) writeChosen([&] { savePlots(costPlots(study), options.output); });
    const bool hasFailed = std::any_of(study.rows.begin(), study.rows.end(),
                                       [](const CostRow& row) { return !row.failure.empty(); });
    return hasFailed ? 3 : isDrawn ? 0 : 1;
}

}  // namespace

void addCost(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<CostOptions>();
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
                     fmt::format("rounds of timing in each frame, of {} drawings each (default: {} in all, "
                                 "at least 1)",
                                 kDrawingsPerRound, defaultRepeats(1)))
        ->check(CLI::Range(1, 10'000));
    options->fidelity.addTo(*command);
    options->effects.addTo(*command);
    command->add_option("-o,--output", options->output, "draw error against cost as an .svg or .png file");
    options->device.addTo(*command);
    options->format.addTo(*command);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
