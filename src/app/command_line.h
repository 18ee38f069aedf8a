#pragma once

#include <CLI/CLI.hpp>

#include "app/commands.h"

namespace gnomon {

/// The program's commands with their flags.
class CommandLine {
  public:
    CommandLine();

    /// What the arguments ask for, of which nothing has been done yet: a command, or a text such as the help.
    /// It must not outlive this object.
    /// @param arguments  @p count of them, the program's name first
    /// @throws UsageError  what is wrong with them
    Task parse(int count, const char* const* arguments);

  private:
    CLI::App m_app;
    Task m_chosen{};
};

}  // namespace gnomon
