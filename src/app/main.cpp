#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <utility>

#include "app/commands.h"
#include "app/help.h"
#include "app/options.h"
#include "app/terminal.h"
#include "matrix/cell_store.h"
#include "matrix/expectations.h"
#include "process/interrupt.h"
#include "report/run_file.h"

namespace {

enum Exit { kAsExpected = 0, kBadInput = 2, kOurFault = 3 };

void addCommands(CLI::App& app, int& status) {
    gnomon::addMatrix(app, status);
    gnomon::addCheck(app, status);
    gnomon::addMerge(app, status);
    gnomon::addSlurm(app, status);
    gnomon::addReport(app, status);
    gnomon::addRender(app, status);
    gnomon::addPlan(app, status);
    gnomon::addAdvise(app, status);
    gnomon::addCost(app, status);
    gnomon::addProve(app, status);
    gnomon::addReproduce(app, status);
    gnomon::addProfiles(app, status);
    gnomon::addMethods(app, status);
    gnomon::addScenes(app, status);
    gnomon::addMesh(app, status);
    gnomon::addDevices(app, status);
    gnomon::addHelp(app, status);
    gnomon::setHelp(app, gnomon::textColumns());
}

int fail(Exit status, const std::string& what) {
    fmt::print(stderr, "gnomon: {}\n", what);
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    gnomon::exitOnInterrupt();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of who writes it
    int status = kAsExpected;
    CLI::App app(
        "Which shadow algorithm can an old graphics chip run, in how many passes, and how exact?\n"
        "Methods run on a software OpenGL that is held to one chip's limits, and every pixel is compared\n"
        "with exact ray-traced truth.",
        "gnomon");
    app.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    app.require_subcommand(1);
    try {
        // CLI11 drops empty words, and an option with them.
        for (int i = 1; i < argc; ++i)
            if (argv[i][0] == 0)
                throw gnomon::UsageError(
                    fmt::format("{}: an empty argument", i > 1 ? argv[i - 1] : "gnomon"));
        addCommands(app, status);
        // CLI11 would only say that a command is missing.
        const auto isNamed = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
        if (argc > 1 && argv[1][0] != '-' && std::as_const(app).get_subcommands(isNamed).empty())
            throw gnomon::UsageError(fmt::format("no such command '{}' (gnomon --help lists them)", argv[1]));
        app.parse(argc, argv);
    } catch (const CLI::Success& done) {
        return app.exit(done);
    } catch (const CLI::ExtrasError&) {
        // CLI11 names them from the last to the first.
        const std::vector<std::string> left = app.remaining(true);
        return fail(kBadInput, fmt::format("The following argument{} not expected: {}",
                                           left.size() > 1 ? "s were" : " was", fmt::join(left, " ")));
    } catch (const CLI::ParseError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::UsageError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::ExpectationError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::StoreError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::RunError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::SceneError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::ProfileError& error) {
        return fail(kBadInput, error.what());
    } catch (const std::exception& error) {
        return fail(kOurFault, error.what());
    }
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        return fail(kBadInput, fmt::format("standard output: {}", std::strerror(errno ? errno : EIO)));
    return status;
}
