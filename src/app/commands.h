#pragma once

#include <CLI/CLI.hpp>

namespace gnomon {

// Each adds its subcommand to @p app; its exit status goes to @p status when it runs.
void addMatrix(CLI::App& app, int& status);
void addMerge(CLI::App& app, int& status);
void addSlurm(CLI::App& app, int& status);
void addCheck(CLI::App& app, int& status);
void addRender(CLI::App& app, int& status);
void addPlan(CLI::App& app, int& status);
void addAdvise(CLI::App& app, int& status);
void addProfiles(CLI::App& app, int& status);
void addMethods(CLI::App& app, int& status);
void addScenes(CLI::App& app, int& status);
void addMesh(CLI::App& app, int& status);
void addReproduce(CLI::App& app, int& status);
void addDevices(CLI::App& app, int& status);
void addProve(CLI::App& app, int& status);
void addCost(CLI::App& app, int& status);
void addHelp(CLI::App& app, int& status);
void addReport(CLI::App& app, int& status);

}  // namespace gnomon
