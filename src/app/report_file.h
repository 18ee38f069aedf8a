#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/options.h"
#include "report/run_json.h"
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
    /// Writes the page of a report.
    /// @throws UsageError  it can't be written, or is too large without any picture
    void write(Report report) const;
};

/// The report of @p cells, with its pictures drawn in @p jobs processes.
/// @param before  cells of an older run that these are compared with; empty: none
Report reportOf(const std::vector<Cell>& cells, const RunSources& sources, int jobs,
                const std::vector<Cell>& before = {});

/// Names the cells that did not come out as their run has them on standard error, a line each.
/// @param nameOf  a cell by its index, with where it stands
void sayFaults(const std::vector<std::pair<std::size_t, std::string>>& faults,
               const std::function<std::string(std::size_t)>& nameOf);

}  // namespace gnomon
