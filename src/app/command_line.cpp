#include "app/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "app/help.h"
#include "app/options.h"
#include "app/terminal.h"

namespace gnomon {

CommandLine::CommandLine()
    : m_app(
          "Which shadow algorithm can an old graphics chip run, in how many passes, and how exact?\n"
          "Methods run on a software OpenGL that is held to one chip's limits, and every pixel is compared\n"
          "with exact ray-traced truth.",
          "gnomon") {
    m_app.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    m_app.require_subcommand(1);
    addMatrix(m_app, m_chosen);
    addCheck(m_app, m_chosen);
    addMerge(m_app, m_chosen);
    addSlurm(m_app, m_chosen);
    addReport(m_app, m_chosen);
    addRender(m_app, m_chosen);
    addPlan(m_app, m_chosen);
    addAdvise(m_app, m_chosen);
    addCost(m_app, m_chosen);
    addProve(m_app, m_chosen);
    addReproduce(m_app, m_chosen);
    addProfiles(m_app, m_chosen);
    addMethods(m_app, m_chosen);
    addScenes(m_app, m_chosen);
    addMesh(m_app, m_chosen);
    addDevices(m_app, m_chosen);
    addHelp(m_app, m_chosen);
    setHelp(m_app, textColumns());
}

Task CommandLine::parse(int count, const char* const* arguments) {
    m_chosen = {};
    // CLI11 drops empty words, and an option with them.
    for (int i = 1; i < count; ++i)
        if (arguments[i][0] == 0)
            throw UsageError(fmt::format("{}: an empty argument", i > 1 ? arguments[i - 1] : "gnomon"));
    // CLI11 would only say that a command is missing.
    const auto isNamed = [&](const CLI::App* command) { return command->get_name() == arguments[1]; };
    if (count > 1 && arguments[1][0] != '-' && std::as_const(m_app).get_subcommands(isNamed).empty())
        throw UsageError(fmt::format("no such command '{}' (gnomon --help lists them)", arguments[1]));
    try {
        m_app.parse(count, arguments);
    } catch (const CLI::Success& text) {
        return [this, text] { return m_app.exit(text); };
    } catch (const CLI::ExtrasError&) {
        // CLI11 names them from the last to the first.
        const std::vector<std::string> left = m_app.remaining(true);
        throw UsageError(fmt::format("The following argument{} not expected: {}",
                                     left.size() > 1 ? "s were" : " was", fmt::join(left, " ")));
    } catch (const CLI::ParseError& error) {
        throw UsageError(error.what());
    }
    return m_chosen;
}

}  // namespace gnomon
