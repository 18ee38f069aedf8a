// Only which paper and which table: each paper has a file of its own.

#include "app/reproduce.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/commands.h"
#include "app/options.h"
#include "app/output_file.h"
#include "matrix/probe.h"

namespace gnomon {
namespace {

const std::vector<ReproducedPaper>& papers() {
    static const std::vector<ReproducedPaper> kPapers{
        {"roettger2002", {1, 2}, {"--measure"}, reproduceRoettger2002},
        {"kolivand2011", {1}, {"--scene", "--size", "--frames", "--repeats"}, reproduceKolivand2011},
        {"aldridge", {}, {"--scene", "--size", "--repeats"}, reproduceAldridge},
        {"usta2019",
         {},
         {"--scene", "--size", "--frames", "--repeats", "--subdivide", "--output"},
         reproduceUsta2019},
    };
    return kPapers;
}

struct ReproduceCommandOptions {
    std::string paper{};
    std::optional<int> table{}, frames{}, repeats{};
    SceneOption scenes{};
    SizeOption sizes{};
    std::vector<int> subdivide{};
    std::string plot{};
    FormatOption format{};
    bool measures = false;
    DeviceOption device{};
};

int run(const ReproduceCommandOptions& options) {
    const auto paper = std::find_if(papers().begin(), papers().end(),
                                    [&](const ReproducedPaper& p) { return p.id == options.paper; });
    const auto& tables = paper->tables;
    if (options.table && std::find(tables.begin(), tables.end(), *options.table) == tables.end())
        throw UsageError(
            tables.empty()
                ? fmt::format("--table: {} is reproduced as a whole", paper->id)
                : fmt::format("--table: of {}, {} {} reproduced", paper->id,
                              fmt::format("{} {}", tables.size() == 1 ? "only table" : "only tables",
                                          fmt::join(tables, " and ")),
                              tables.size() == 1 ? "is" : "are"));
    const std::vector<std::pair<std::string, bool>> given{{"--scene", !options.scenes.ids.empty()},
                                                          {"--size", !options.sizes.words.empty()},
                                                          {"--frames", options.frames.has_value()},
                                                          {"--repeats", options.repeats.has_value()},
                                                          {"--subdivide", !options.subdivide.empty()},
                                                          {"--output", !options.plot.empty()},
                                                          {"--measure", options.measures}};
    for (const auto& [flag, isGiven] : given)
        if (isGiven && !paper->flags.contains(flag))
            throw UsageError(fmt::format("{}: not for {}", flag, paper->id));
    if (options.measures && options.table && *options.table != 2)
        throw UsageError(fmt::format("--measure: only with table 2 of {}", paper->id));

    checkPlotFile(options.plot);
    ReproduceOptions wanted{.table = options.table,
                            .page = options.format.value(),
                            .frames = options.frames,
                            .repeats = options.repeats,
                            .subdivide = options.subdivide,
                            .plot = options.plot,
                            .measures = options.measures,
                            .device = options.device.value()};
    if (!options.scenes.ids.empty()) {
        SceneOption scenes = options.scenes;
        scenes.lights = "all";
        wanted.scenes = scenes.load();
        for (const Scene& scene : *wanted.scenes)
            for (const std::string& note : scene.notes) fmt::print(stderr, "{}: {}\n", scene.id, note);
    }
    if (!options.sizes.words.empty()) wanted.size = theOnly("--size", options.sizes.value());
    return paper->run(wanted);
}

}  // namespace

std::vector<Scene> scenesOf(const ReproduceOptions& options, const std::vector<std::string>& ids) {
    return options.scenes ? *options.scenes : SceneOption{}.load(ids);
}

std::string measuredOn(Device device) {
    const DriverFacts facts = probe(device);
    return fmt::format("{}, {}", facts.driver,
                       facts.clock == DrawClock::Gpu ? "time of the GPU" : "thread CPU time");
}

void addReproduce(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<ReproduceCommandOptions>();
    CLI::App* command = app.add_subcommand(
        "reproduce", "Published figures beside measured ones; exit status 1 if one that must agree differs");
    std::vector<std::string> ids;
    for (const ReproducedPaper& paper : papers()) ids.push_back(paper.id);
    command->add_option("paper", options->paper, fmt::format("{}", fmt::join(ids, ", ")))
        ->required()
        ->check(CLI::IsMember(ids));
    command->add_option("--table", options->table, "number of the table in the paper (default: all)");
    command
        ->add_option("--scene", options->scenes.ids,
                     "scenes: id, scene file, mesh file; with all their lights")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("ID|FILE");
    options->sizes.addTo(*command);
    command->add_option("--frames", options->frames, "frames of each scene's camera path")
        ->check(CLI::Range(1, 10'000));
    command->add_option("--repeats", options->repeats, "rounds in which all methods are drawn in turn")
        ->check(CLI::Range(1, 10'000));
    command
        ->add_option("--subdivide", options->subdivide,
                     "how often each triangle is cut in four; a number for each scene")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(0, 6));
    command->add_option("-o,--output", options->plot, "file for the figure, .svg or .png");
    command->add_flag("--measure", options->measures,
                      "roettger2002's table 2: also time its frames on this machine");
    options->device.addTo(*command);
    options->format.addTo(*command);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
