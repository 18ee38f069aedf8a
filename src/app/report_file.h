#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/options.h"
#include "report/run_pictures.h"

namespace gnomon {

/// Where a report goes, and how large it may be.
struct ReportFile {
    std::string file{};
    double megabytes = 5;  ///< of a million bytes
    /// @param flag  "-o,--output"
    void addTo(CLI::App& app, const std::string& flag);

    bool isWanted() const { return !file.empty(); }
    /// Refuses a file that could not be written, before anything is drawn.
    /// @throws UsageError
    void check() const;
    /// Draws the pictures in @p jobs processes and writes the report.
    /// @throws UsageError          it can't be written, or is too large without any picture
    /// @throws std::runtime_error  a cell comes out otherwise than it is in @p cells
    /// @param before  cells of an older run that these are compared with; empty: none
    void write(const std::vector<Cell>& cells, const RunSources& sources, int jobs,
               const std::vector<Cell>& before = {}) const;
};

/// The `gnomon matrix` command that asks for such cells, as far as the defaults leave something to say.
std::string commandOf(const std::vector<Cell>& cells, const RunSources& sources);

}  // namespace gnomon
