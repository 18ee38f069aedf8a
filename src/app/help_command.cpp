#include <fmt/format.h>

#include <cstdio>

#include "app/commands.h"
#include "app/help.h"
#include "app/options.h"

namespace gnomon {
namespace {

struct HelpOptions {
    std::string command{};
    bool isManual = false;
};

int run(const CLI::App& app, const HelpOptions& options) {
    if (options.isManual) {
        if (!options.command.empty()) throw UsageError("--man: the manual is of all commands");
        fmt::print("{}", manPage(app, app.version()));
        return 0;
    }
    if (options.command.empty()) {
        // app.help() itself would be that of the command which runs.
        fmt::print("{}", app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal));
        return 0;
    }
    const auto isNamed = [&](const CLI::App* other) { return other->get_name() == options.command; };
    const auto found = app.get_subcommands(isNamed);
    if (found.empty())
        throw UsageError(fmt::format("no such command '{}' (gnomon --help lists them)", options.command));
    fmt::print("{}", found.front()->help(app.get_name()));
    return 0;
}

}  // namespace

void addHelp(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<HelpOptions>();
    CLI::App* command = app.add_subcommand("help", "The help of a command, or the manual page");
    command->add_option("command", options->command, "name of a command (default: the list of all)");
    command->add_flag("--man", options->isManual, "the manual page of all commands, as man(1) reads it");
    command->callback([options, &app, &chosen] { chosen = [options, &app] { return run(app, *options); }; });
}

}  // namespace gnomon
