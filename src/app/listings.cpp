#include "report/listings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <filesystem>

#include "app/commands.h"
#include "app/options.h"

namespace gnomon {
namespace {

struct ListingsOptions {
    std::string id{};
    FormatOption format{};
};

int runProfiles(const ListingsOptions& options) {
    ProfileOption choice;
    if (!options.id.empty()) choice.ids = {options.id};
    const auto profiles = choice.load();
    const Page page = options.format.value();
    fmt::print("{}", options.id.empty() ? listProfiles(profiles, page) : showProfile(profiles.front(), page));
    return 0;
}

int runMethods(const ListingsOptions& options) {
    std::vector<NamedMethod> methods = namedMethods();
    if (!options.id.empty()) {
        std::vector<std::string> known;
        for (const NamedMethod& m : methods) known.push_back(m.id);
        if (!findMethod(options.id))
            throw UsageError(
                fmt::format("no such method '{}' (known: {})", options.id, fmt::join(known, ", ")));
        methods = {*findMethod(options.id)};
    }
    const Page page = options.format.value();
    fmt::print("{}", listMethods(methods, page));
    // JSON and CSV are one list; the values stand in each cell's own fields.
    if (page.format == Format::Text && options.id.empty()) fmt::print("\n{}", listAxisValues(page));
    return 0;
}

int runScenes(const ListingsOptions& options) {
    SceneOption choice;
    choice.ids = {options.id.empty() ? "all" : options.id};
    auto scenes = choice.load();
    // Commands that are printed name a file as it was given.
    if (scenes.size() == 1 && std::filesystem::exists(options.id)) scenes.front().id = options.id;
    fmt::print("{}", listScenes(scenes, options.format.value()));
    if (scenes.size() == 1)
        for (const std::string& note : scenes.front().notes)
            fmt::print(stderr, "{}: {}\n", scenes.front().id, note);
    return 0;
}

void addListing(CLI::App& app, Task& chosen, const std::string& name, const std::string& help,
                int (*run)(const ListingsOptions&)) {
    const auto options = std::make_shared<ListingsOptions>();
    CLI::App* command = app.add_subcommand(name, help);
    command->add_option("id", options->id, "one of them, with all that is known");
    options->format.addTo(*command);
    command->callback([options, run, &chosen] { chosen = [options, run] { return run(*options); }; });
}

}  // namespace

void addProfiles(CLI::App& app, Task& chosen) {
    addListing(app, chosen, "profiles", "The chips, or all facts of one with their sources", runProfiles);
}

void addMethods(CLI::App& app, Task& chosen) {
    addListing(app, chosen, "methods", "The named methods with their papers", runMethods);
}

void addScenes(CLI::App& app, Task& chosen) {
    addListing(app, chosen, "scenes",
               "The scenes and hard cases that come with gnomon, or one scene or mesh file", runScenes);
}

}  // namespace gnomon
