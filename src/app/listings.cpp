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

CLI::App* addListing(CLI::App& app, const std::string& name, const std::string& help,
                     const std::shared_ptr<ListingsOptions>& options) {
    CLI::App* command = app.add_subcommand(name, help);
    command->add_option("id", options->id, "one of them, with all that is known");
    options->format.addTo(*command);
    return command;
}

}  // namespace

void addProfiles(CLI::App& app, int& status) {
    const auto options = std::make_shared<ListingsOptions>();
    addListing(app, "profiles", "The chips, or all facts of one with their sources", options)
        ->callback([options, &status] {
            ProfileOption choice;
            if (!options->id.empty()) choice.ids = {options->id};
            const auto profiles = choice.load();
            const Page page = options->format.value();
            fmt::print("{}", options->id.empty() ? listProfiles(profiles, page)
                                                 : showProfile(profiles.front(), page));
            status = 0;
        });
}

void addMethods(CLI::App& app, int& status) {
    const auto options = std::make_shared<ListingsOptions>();
    addListing(app, "methods", "The named methods with their papers", options)->callback([options, &status] {
        std::vector<NamedMethod> methods = namedMethods();
        if (!options->id.empty()) {
            std::vector<std::string> known;
            for (const NamedMethod& m : methods) known.push_back(m.id);
            if (!findMethod(options->id))
                throw UsageError(
                    fmt::format("no such method '{}' (known: {})", options->id, fmt::join(known, ", ")));
            methods = {*findMethod(options->id)};
        }
        const Page page = options->format.value();
        fmt::print("{}", listMethods(methods, page));
        // JSON and CSV are one list; the values stand in each cell's own fields.
        if (page.format == Format::Text && options->id.empty()) fmt::print("\n{}", listAxisValues(page));
        status = 0;
    });
}

void addScenes(CLI::App& app, int& status) {
    const auto options = std::make_shared<ListingsOptions>();
    addListing(app, "scenes", "The scenes and hard cases that come with gnomon, or one scene or mesh file",
               options)
        ->callback([options, &status] {
            SceneOption choice;
            choice.ids = {options->id.empty() ? "all" : options->id};
            auto scenes = choice.load();
            // Commands that are printed name a file as it was given.
            if (scenes.size() == 1 && std::filesystem::exists(options->id)) scenes.front().id = options->id;
            fmt::print("{}", listScenes(scenes, options->format.value()));
            if (scenes.size() == 1)
                for (const std::string& note : scenes.front().notes)
                    fmt::print(stderr, "{}: {}\n", scenes.front().id, note);
            status = 0;
        });
}

}  // namespace gnomon
