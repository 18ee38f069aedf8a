#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace gnomon {

/// What a command line asks for; returns the exit status.
using Task = std::function<int()>;

// Each adds its subcommand to @p app; where a command line names it, the command becomes @p chosen. It may
// use @p app when it runs.
void addMatrix(CLI::App& app, Task& chosen);
void addMerge(CLI::App& app, Task& chosen);
void addSlurm(CLI::App& app, Task& chosen);
void addCheck(CLI::App& app, Task& chosen);
void addRender(CLI::App& app, Task& chosen);
void addPlan(CLI::App& app, Task& chosen);
void addAdvise(CLI::App& app, Task& chosen);
void addProfiles(CLI::App& app, Task& chosen);
void addMethods(CLI::App& app, Task& chosen);
void addScenes(CLI::App& app, Task& chosen);
void addMesh(CLI::App& app, Task& chosen);
void addReproduce(CLI::App& app, Task& chosen);
void addDevices(CLI::App& app, Task& chosen);
void addProve(CLI::App& app, Task& chosen);
void addCost(CLI::App& app, Task& chosen);
void addHelp(CLI::App& app, Task& chosen);
void addReport(CLI::App& app, Task& chosen);

}  // namespace gnomon
