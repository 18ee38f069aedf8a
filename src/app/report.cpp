#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "app/commands.h"
#include "app/options.h"
#include "app/report_file.h"
#include "report/run_compare.h"
#include "report/run_file.h"

namespace gnomon {
namespace {

struct ReportOptions {
    std::vector<std::string> runs{};
    ProfileOption profiles{};
    std::vector<std::string> scenes{};
    ReportFile output{};
    FormatOption format{};
    int jobs = int(std::max(1u, std::thread::hardware_concurrency()));
};

/// What is wrong with a scene or chip, said of the cell that names it.
/// @param file  of it, and @p flag says where that is if it isn't found
template <class Load>
auto loadedFor(const RunRecord& run, std::size_t index, const std::string& file, const char* flag,
               const Load& load) {
    try {
        return load();
    } catch (const RunError&) {
        throw;
    } catch (const std::runtime_error& error) {
        std::error_code none;
        if (std::filesystem::exists(file, none)) throw run.error(index, error.what());
        throw run.error(index, fmt::format("{}; {} FILE says where it is", error.what(), flag));
    }
}

/// Where the scene of a cell stands: a file that was given, by its id or else by its name, or what the cell
/// says. The same mesh has another id from another folder.
/// @param files  by id: scenes that stand elsewhere than the shipped ones
std::string fileOf(const std::string& scene, const std::map<std::string, std::string>& files) {
    if (const auto file = files.find(scene); file != files.end()) return file->second;
    const auto nameOf = [](const std::string& path) { return std::filesystem::path(path).filename(); };
    for (const auto& [id, file] : files)
        if (nameOf(file) == nameOf(scene)) return file;
    return scene;
}

/// The scene of a cell.
Scene sceneOf(const RunRecord& run, std::size_t index, const std::map<std::string, std::string>& files) {
    const Cell& cell = run.cells[index];
    const std::string file = fileOf(cell.scene, files);
    return loadedFor(run, index, file, "--scene", [&] {
        SceneOption option{.ids = {file}};
        option.place(cell.view);
        std::vector<Scene> scenes = option.load();
        if (scenes.size() != 1 || (file == cell.scene && scenes.front().id != cell.scene))
            throw run.error(index, fmt::format("no scene '{}'; --scene FILE says where it is", cell.scene));
        scenes.front().id = cell.scene;
        return std::move(scenes.front());
    });
}

/// The chips of all cells, and the scenes of those that are to be drawn or planned.
RunSources sourcesOf(const RunRecord& run, const ReportOptions& options) {
    RunSources sources;
    if (!options.profiles.ids.empty())
        for (Profile& profile : options.profiles.load()) sources.profiles.emplace(profile.id, profile);
    std::map<std::string, std::string> files;
    for (const std::string& file : options.scenes)
        for (const Scene& scene : SceneOption{.ids = {file}}.load()) files.emplace(scene.id, file);
    for (std::size_t i = 0; i < run.cells.size(); ++i) {
        const Cell& cell = run.cells[i];
        if (sources.profiles.contains(cell.profile)) continue;
        loadedFor(run, i, cell.profile, "--profile", [&] {
            sources.profiles.emplace(cell.profile, ProfileOption{.ids = {cell.profile}}.load().front());
            return 0;
        });
    }
    std::vector<std::size_t> planned = shownCells(run.cells);
    const auto refused = refusedCells(run.cells);
    planned.insert(planned.end(), refused.begin(), refused.end());
    for (const std::size_t i : planned) {
        const Cell& cell = run.cells[i];
        auto at = sources.scenes.find({cell.scene, cell.view});
        if (at == sources.scenes.end())
            at = sources.scenes.emplace(std::pair(cell.scene, cell.view), sceneOf(run, i, files)).first;
        const std::size_t frames = at->second.frames.size();
        if (std::size_t(cell.frame) >= frames)
            throw run.error(i,
                            fmt::format("no frame {}: {} has 0 to {}", cell.frame, cell.scene, frames - 1));
    }
    return sources;
}

int run(const ReportOptions& options) {
    if (options.runs.size() > 2)
        throw UsageError(fmt::format("{}: a third run; two can be compared", options.runs[2]));
    const bool compares = options.runs.size() == 2;
    if (!compares && options.format.word == "csv")
        throw UsageError("--format: csv is for two runs; of one, gnomon matrix has it");
    if (!compares && options.format.word == "text" && !options.output.isWanted())
        throw UsageError("-o: a report needs a file to go to; --format json prints what it says");
    options.output.check();
    std::error_code error;
    for (const std::string& file : options.runs)
        if (options.output.isWanted() && std::filesystem::equivalent(file, options.output.file, error))
            throw UsageError(fmt::format("{}: is the run itself", options.output.file));
    const RunRecord last = readRun(options.runs.back());
    const RunRecord first = compares ? readRun(options.runs.front()) : RunRecord{};
    const Page page = options.format.value();
    bool hasFaults = false;
    if (options.output.isWanted() || !compares) {
        Report report = reportOf(last.cells, sourcesOf(last, options), options.jobs, first.cells);
        const auto faults = faultsOf(report.pictures);
        sayFaults(faults,
                  [&](std::size_t i) { return std::string(last.error(i, last.cells[i].id()).what()); });
        hasFaults = !faults.empty();
        if (!compares && page.format == Format::Json) fmt::print("{}\n", wordsJson(report).dump(1));
        if (options.output.isWanted()) options.output.write(std::move(report));
    }
    const auto changes = compares ? changesBetween(first.cells, last.cells) : std::vector<ChangeGroup>{};
    if (compares) fmt::print("{}", showChanges(changes, first.cells.size(), last.cells.size(), page));
    return hasFaults ? 3 : changes.empty() ? 0 : 1;
}

}  // namespace

void addReport(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<ReportOptions>();
    CLI::App* command = app.add_subcommand(
        "report",
        "A run as one page that opens from disk without a network: tables, pictures, film strips, plots.\n"
        "The run is what gnomon matrix --format json wrote; its pictures are drawn again. Of two runs: what\n"
        "has changed from the first to the second, in words, and with -o as a page. --format json of one "
        "run\n"
        "prints all that the page says.");
    command
        ->add_option(
            "run", options->runs,
            "what gnomon matrix --format json wrote, or a folder of --out; or two of these, the older first")
        ->required()
        ->type_name("FILE.json");
    options->output.addTo(*command, "-o,--output");
    options->format.addTo(*command);
    options->profiles.addTo(*command, "files of chips in the run that are not gnomon's own");
    command->add_option("--scene", options->scenes, "files of scenes in the run that are not gnomon's own")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("FILE");
    command->add_option("--jobs", options->jobs, "worker processes (default: one per core)")
        ->check(CLI::Range(1, 256));
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
