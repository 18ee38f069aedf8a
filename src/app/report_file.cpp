#include "app/report_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/output_file.h"
#include "app/run_command.h"
#include "app/terminal.h"
#include "image/whole_file.h"
#include "report/report_page.h"

namespace gnomon {

void ReportFile::addTo(CLI::App& app, const std::string& flag) {
    app.add_option(flag, file, "write the run as one page: tables, pictures, film strips, plots")
        ->type_name("FILE.html");
    app.add_option("--limit", megabytes,
                   "how large that page may be, MB: film strips that show the least new are left out first "
                   "(default: 5)")
        ->check([](const std::string& word) -> std::string {
            double value = -1;  // CLI::Range lets nan through
            const bool isNumber = CLI::detail::lexical_cast(word, value);
            return isNumber && value > 0 && value <= 1000 ? "" : word + " is not in 0 to 1000, without 0";
        });
}

void ReportFile::check() const {
    checkOutputFile(file, {".html"}, "a report's name ends in .html");
}

Report reportOf(const std::vector<Cell>& cells, const RunSources& sources, int jobs,
                const std::vector<Cell>& before) {
    TerminalProgress bar("pictures");
    RunPictures pictures = drawRun(cells, sources, jobs, [&](const Progress& at) { bar.show(at); });
    bar.clear();
    Report report{.title = {commandOf(cells, sources), "gnomon " GNOMON_VERSION},
                  .cells = cells,
                  .sources = sources,
                  .pictures = std::move(pictures),
                  .states = statesOf(cells, sources)};
    if (!before.empty()) {
        // Which gnomon made it, a run doesn't say.
        report.before = RunTitle{commandOf(before, sources), "gnomon"};
        report.changes = changesBetween(before, cells);
    }
    return report;
}

void ReportFile::write(Report report) const {
    std::string page;
    try {
        page = reportPage(bundledPage(), std::move(report), std::size_t(megabytes * 1e6));
    } catch (const ReportTooLarge& error) {
        throw UsageError(fmt::format("--limit: {}", error.what()));
    }
    writeChosen([&] { writeWhole(file, page); });
}

void sayFaults(const std::vector<std::pair<std::size_t, std::string>>& faults,
               const std::function<std::string(std::size_t)>& nameOf) {
    constexpr std::size_t kMost = 20;
    for (std::size_t i = 0; i < std::min(faults.size(), kMost); ++i)
        fmt::print(stderr, "{}: {}\n", nameOf(faults[i].first), faults[i].second);
    if (faults.size() > kMost) fmt::print(stderr, "and {} more\n", faults.size() - kMost);
}

}  // namespace gnomon
