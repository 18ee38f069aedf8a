#include "report/reproduce_roettger2002.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "app/options.h"
#include "app/reproduce.h"
#include "matrix/lab.h"

namespace gnomon {
namespace {

/// Table 1, counted at the capability layer and in the plan.
std::vector<Comparison> countedTable1() {
    ProfileOption profiles;
    const Profile ideal = profiles.load({"ideal"}).front();
    SceneOption scenes;
    Lab lab(scenes.load({"roettger"}).front());
    const Size size{};
    std::vector<Comparison> rows = roettgerTable1();
    for (Comparison& row : rows) {
        row.planned = countPasses(lab.plan(ideal, row.axes, size.width, size.height, 0));
        const Cell cell = lab.run(ideal, row.axes, size.width, size.height, 0);
        if (cell.verdict == Verdict::Failed) throw std::runtime_error(cell.id() + ": " + cell.error);
        row.counted = cell.passes;
    }
    return rows;
}

}  // namespace

int reproduceRoettger2002(const ReproduceOptions& options) {
    const std::vector<Comparison> rows = countedTable1();
    fmt::print("{}", showComparisons(rows, options.format));
    const bool allAgree =
        std::all_of(rows.begin(), rows.end(), [](const Comparison& row) { return row.agrees(); });
    return allAgree ? 0 : 1;
}

}  // namespace gnomon
