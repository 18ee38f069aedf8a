#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/options.h"
#include "report/run_pictures.h"

namespace gnomon {

/// Which cells a run has: what `matrix` and `check` take alike.
struct MatrixOptions {
    ProfileOption profiles{};
    SceneOption scenes{};
    MethodOption methods{};
    SizeOption sizes{};
    FidelityOption fidelity{};
    EffectsOption effects{};
    DeviceOption device{};
    std::vector<std::string> frames{};

    void addTo(CLI::App& app);
    /// Loads all that is named; notes about scenes, frames and methods go to standard error.
    /// @throws UsageError, SceneError, ProfileError
    MatrixRequest load() const;
};

/// What the cells of a request are drawn from.
RunSources sourcesOf(const MatrixRequest& request);

/// --jobs, --timeout, --memory
struct WorkerOptions {
    int jobs = 0;
    StepLimits limits{};
    WorkerOptions();
    void addTo(CLI::App& app);
    void applyTo(MatrixRequest& request) const;
};

/// The words of MatrixOptions that were given, by flag ("--scene") in the flags' order.
using ChoiceWords = std::vector<std::pair<std::string, std::string>>;

/// @param options  that were added by MatrixOptions::addTo()
ChoiceWords choiceOf(const std::vector<CLI::Option*>& options);

/// The words of a line such as "--scene boxes --frames 0".
/// @throws UsageError
ChoiceWords choiceFrom(const std::string& line);

/// @p choice with what @p over has instead.
ChoiceWords withWords(ChoiceWords choice, const ChoiceWords& over);

/// The line that choiceFrom() takes.
std::string toText(const ChoiceWords& choice);

/// The options of a choice.
/// @throws UsageError
MatrixOptions optionsOf(const ChoiceWords& choice);

}  // namespace gnomon
