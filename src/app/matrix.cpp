#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "app/commands.h"
#include "app/keep_options.h"
#include "app/matrix_options.h"
#include "app/report_file.h"
#include "app/terminal.h"
#include "matrix/cell_list.h"
#include "report/matrix_report.h"

namespace gnomon {
namespace {

struct MatrixCommandOptions {
    MatrixOptions choice{};
    WorkerOptions workers{};
    KeepOptions keeping{};
    FormatOption format{};
    ReportFile report{};
};

int run(const MatrixCommandOptions& options) {
    options.report.check();
    MatrixRequest request = options.choice.load();
    options.workers.applyTo(request);
    options.keeping.applyTo(request);
    if (options.report.isWanted() && placesOf(CellList(request), request.shard, request.past).empty())
        throw UsageError(fmt::format("--report: no cell is left for shard {}", toText(request.shard)));
    const auto store = options.keeping.open(request);

    TerminalProgress bar("cells");
    const std::vector<Cell> cells = runMatrix(
        request, [&](const Progress& at) { bar.show(at); }, store.get());
    bar.clear();
    const Page page = options.format.value();
    fmt::print("{}", page.format == Format::Json  ? matrixJson(cells)
                     : page.format == Format::Csv ? matrixCsv(cells)
                     : cells.empty() ? fmt::format("no cell is left for shard {}\n", toText(request.shard))
                                     : matrixText(cells, page));
    if (store) fmt::print(page.format == Format::Text ? stdout : stderr, "{}\n", keptText(*store));
    bool hasFailed = std::any_of(cells.begin(), cells.end(),
                                 [](const Cell& cell) { return cell.verdict == Verdict::Failed; });
    if (options.report.isWanted()) {
        Report report = reportOf(cells, sourcesOf(request), request.jobs);
        const auto faults = faultsOf(report.pictures);
        options.report.write(std::move(report));
        sayFaults(faults, [&](std::size_t i) { return cells[i].id(); });
        hasFailed = hasFailed || !faults.empty();
    }
    return hasFailed ? 3 : 0;
}

}  // namespace

void addMatrix(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<MatrixCommandOptions>();
    CLI::App* command = app.add_subcommand(
        "matrix",
        "The main job: draws each scene with each method on each chip, compares every pixel with ray-traced\n"
        "truth, and says of each cell: exact, edge, wrong (why), refused (what is missing), failed.\n"
        "Leave a choice out to run all.");
    options->choice.addTo(*command);
    options->format.addTo(*command);
    options->format.addColourTo(*command);
    options->report.addTo(*command, "--report");
    options->workers.addTo(*command);
    options->keeping.addTo(*command);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
