#include "app/matrix_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <thread>

namespace gnomon {
namespace {

/// A word as CLI11 takes it from a line.
std::string quoted(const std::string& word) {
    return word.find(' ') == std::string::npos ? word : fmt::format("\"{}\"", word);
}

/// An application that takes a choice and nothing else.
struct ChoiceParser {
    CLI::App app{"a choice of cells"};
    MatrixOptions options{};

    explicit ChoiceParser(const std::string& line) {
        options.addTo(app);
        app.set_help_flag();
        try {
            app.parse(line, false);
        } catch (const CLI::ParseError& error) {
            throw UsageError(error.what());
        }
    }
};

}  // namespace

void MatrixOptions::addTo(CLI::App& app) {
    scenes.addTo(app, "scenes: ids, scene files, mesh files");
    profiles.addTo(app, "chips (gnomon profiles lists them)");
    methods.addTo(app);
    sizes.addTo(app);
    app.add_option("--frames", frames,
                   "frames of the camera path: 0,15 or 0-59 (default: twelve, a twelfth of the path apart)")
        ->delimiter(',')
        ->allow_extra_args(false);
    fidelity.addTo(app);
    effects.addTo(app);
    device.addTo(app);
}

MatrixRequest MatrixOptions::load() const {
    MatrixRequest request;
    std::string dropped;
    request.methods = methods.axes(dropped);
    request.sizes = sizes.value();
    request.frames = parseFrames(frames);
    request.profiles = profiles.load();
    request.scenes = scenes.load();
    request.fidelities = fidelity.value(request.profiles);
    request.device = device.value();
    request.effects = effects.value();
    request.view = scenes.view();
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
    return request;
}

RunSources sourcesOf(const MatrixRequest& request) {
    RunSources sources;
    for (const Profile& profile : request.profiles) sources.profiles.emplace(profile.id, profile);
    for (const Scene& scene : request.scenes)
        sources.scenes.emplace(std::pair(scene.id, request.view), scene);
    return sources;
}

WorkerOptions::WorkerOptions() : jobs(int(std::max(1u, std::thread::hardware_concurrency()))) {}

void WorkerOptions::addTo(CLI::App& app) {
    app.add_option("--jobs", jobs, "worker processes (default: one per core)")->check(CLI::Range(1, 256));
    app.add_option("--timeout", limits.seconds,
                   fmt::format("seconds that a cell may take; beyond them it is failed (default: {})",
                               limits.seconds))
        ->type_name("SECONDS")
        ->check([](const std::string& word) -> std::string {
            double value = -1;  // CLI::Range lets nan through
            const bool isNumber = CLI::detail::lexical_cast(word, value);
            return isNumber && value > 0 && value <= 1e6 ? "" : word + " is not in 0 to 1000000, without 0";
        });
    app.add_option(
           "--memory", limits.megabytes,
           "resident memory that a worker may hold; a cell that takes more is failed (default: no limit)")
        ->type_name("MB")
        ->check(CLI::Range(1, 1 << 24));
}

void WorkerOptions::applyTo(MatrixRequest& request) const {
    request.jobs = jobs;
    request.limits = limits;
}

ChoiceWords choiceOf(const std::vector<CLI::Option*>& options) {
    ChoiceWords words;
    for (const CLI::Option* option : options)
        if (option->count() > 0)
            words.emplace_back(fmt::format("--{}", option->get_lnames().front()),
                               fmt::format("{}", fmt::join(option->results(), ",")));
    return words;
}

ChoiceWords choiceFrom(const std::string& line) {
    ChoiceParser parser(line);
    return choiceOf(parser.app.get_options());
}

ChoiceWords withWords(ChoiceWords choice, const ChoiceWords& over) {
    for (const auto& word : over) {
        const auto same = [&](const auto& other) { return other.first == word.first; };
        const auto old = std::find_if(choice.begin(), choice.end(), same);
        if (old != choice.end())
            *old = word;
        else
            choice.push_back(word);
    }
    return choice;
}

std::string toText(const ChoiceWords& choice) {
    std::string text;
    for (const auto& [flag, value] : choice)
        text += fmt::format("{}{} {}", text.empty() ? "" : " ", flag, quoted(value));
    return text;
}

MatrixOptions optionsOf(const ChoiceWords& choice) {
    return ChoiceParser(toText(choice)).options;
}

}  // namespace gnomon
