#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

namespace gnomon {

/// A command line that works in an empty folder, and what it is for.
struct Example {
    std::string line{};  ///< "gnomon matrix boxes"
    std::string what{};
};

/// The examples that the help of @p command ends with.
const std::vector<Example>& examplesOf(const std::string& command);

/// What the exit statuses mean, one line.
std::string exitStatusText();

/// Gives every command the house's help: no line wider than @p columns, examples and exit status at the end.
/// @pre all commands have been added
void setHelp(CLI::App& app, std::size_t columns);

/// The manual page of the whole program, in troff's man macros, from the same texts as --help.
/// @param version  "gnomon 0.1.0"
std::string manPage(const CLI::App& app, const std::string& version);

}  // namespace gnomon
