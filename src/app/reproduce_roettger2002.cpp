#include "report/reproduce_roettger2002.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "app/options.h"
#include "app/reproduce.h"
#include "app/terminal.h"
#include "cost/spread.h"
#include "matrix/lab.h"

namespace gnomon {
namespace {

constexpr std::array kSizes{256, 512, 1024};  ///< of Table 2: sides of the window, pixels

/// Table 1, counted at the capability layer and in the plan.
std::vector<Comparison> countedTable1(Device device) {
    ProfileOption profiles;
    const Profile ideal = profiles.load({"ideal"}).front();
    SceneOption scenes;
    Lab lab(scenes.load({"roettger"}).front());
    lab.drawOn(device);
    const Size size{};
    std::vector<Comparison> rows = roettgerTable1();
    TerminalProgress bar("rows");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Comparison& row = rows[i];
        bar.show({.done = i, .all = rows.size()});
        row.planned = countPasses(lab.plan(ideal, row.axes, size.width, size.height, 0));
        const Cell cell = lab.run(ideal, row.axes, size.width, size.height, 0);
        if (cell.verdict == Verdict::Failed) throw std::runtime_error(cell.id() + ": " + cell.error);
        row.counted = cell.passes;
    }
    return rows;
}

/// Table 2 by the model: the published methods on our scene, in frames all around it.
std::vector<Table2Cell> modelledCells(const Profile& profile) {
    constexpr int kFrames = 4;
    SceneOption scenes;
    Lab lab(scenes.load({"roettger"}).front());
    std::vector<Table2Cell> cells = roettgerTable2();
    const auto length = int(lab.scene().frames.size());
    TerminalProgress bar("frames");
    Progress at{.all = kSizes.size() * kFrames};
    for (const int size : kSizes)
        for (int i = 0; i < kFrames; ++i, ++at.done) {
            bar.show(at);
            for (Table2Cell& cell : cells)
                if (cell.size == size)
                    cell.frames.push_back(lab.fullCost(profile, findMethod(cell.method)->axes, size, size,
                                                       i * length / kFrames));
        }
    return cells;
}

/// By cell: the time on this machine, over that of the frame without shadows in the same round; the median.
std::vector<double> measuredTable2(const Profile& profile, const std::vector<Table2Cell>& cells,
                                   Device device) {
    constexpr int kRounds = 5;
    SceneOption scenes;
    Lab lab(scenes.load({"roettger"}).front());
    lab.drawOn(device);
    std::vector<double> ratiosOfCells;
    TerminalProgress bar("frames");
    for (const int size : kSizes) {
        std::vector<TimedWay> ways;
        for (const Table2Cell& cell : cells)
            if (cell.size == size)
                ways.push_back({.profile = profile, .axes = findMethod(cell.method)->axes});
        std::vector<std::vector<double>> times;
        for (const auto& way :
             lab.frameTimes(ways, size, size, 0, kRounds, false, [&](const Progress& at) { bar.show(at); })) {
            std::vector<double>& all = times.emplace_back();
            for (const FrameTime& time : way) all.push_back(time.total());
        }
        // The last column of each row is that without shadows.
        for (const auto& way : times) ratiosOfCells.push_back(spreadOf(ratios(way, times.back())).median);
    }
    return ratiosOfCells;
}

Table2 modelledTable2(bool measures, Device device) {
    ProfileOption profiles;
    const Profile profile = profiles.load({"geforce2mx"}).front();
    Table2 table{.cells = modelledCells(profile), .rates = modelRates(profile)};
    if (measures) table.measured = measuredTable2(profile, table.cells, device);
    return table;
}

}  // namespace

int reproduceRoettger2002(const ReproduceOptions& options) {
    if (!options.table && options.page.format == Format::Csv)
        throw UsageError("--format: tables 1 and 2 have different columns; choose one by --table");
    std::optional<std::vector<Comparison>> table1;
    std::optional<Table2> table2;
    if (options.wants(1)) table1 = countedTable1(options.device);
    if (options.wants(2)) table2 = modelledTable2(options.measures, options.device);
    fmt::print("{}", showRoettger2002(table1, table2, options.page));
    if (!table1) return 0;
    const bool allAgree =
        std::all_of(table1->begin(), table1->end(), [](const Comparison& row) { return row.agrees(); });
    return allAgree ? 0 : 1;
}

}  // namespace gnomon
