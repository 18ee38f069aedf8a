#include "report/reproduce_roettger2002_table2.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>

namespace gnomon {
namespace {

constexpr int kPassKinds = 5;

/// A pass of the unknown scene: more fragments, and as many triangles.
PassCost scaled(PassCost pass, const Unknowns& unknowns) {
    const double factor = pass.kind == PassKind::Volume  ? unknowns.volumes
                          : pass.kind == PassKind::Scene ? unknowns.scene
                                                         : 1;
    pass.fillMs *= factor, pass.bandwidthMs *= factor;
    return pass;
}

/// By kind of pass.
std::array<double, kPassKinds> chipMsByKind(const Table2Cell& cell, const Unknowns& unknowns) {
    std::array<double, kPassKinds> sums{};
    for (const FrameCost& frame : cell.frames)
        for (const PassCost& pass : frame.passes)
            sums[std::size_t(pass.kind)] += scaled(pass, unknowns).ms() / double(cell.frames.size());
    return sums;
}

int scenePasses(const Table2Cell& cell) {
    const auto& passes = cell.frames.front().passes;
    return int(std::count_if(passes.begin(), passes.end(),
                             [](const PassCost& pass) { return pass.kind == PassKind::Scene; }));
}

double hostMs(const Table2Cell& cell, const Unknowns& u) {
    const double shadows = cell.column == Column::None ? 0 : u.hostVolumesMs;
    return u.hostMs + shadows + u.hostSceneMs * (scenePasses(cell) - 1);
}

double chipMs(const FrameCost& frame, const Unknowns& unknowns) {
    double sum = 0;
    for (const PassCost& pass : frame.passes) sum += scaled(pass, unknowns).ms();
    return sum;
}

const Table2Cell& cellOf(const std::vector<Table2Cell>& cells, Column column, int size) {
    const auto found = std::find_if(cells.begin(), cells.end(), [&](const Table2Cell& cell) {
        return cell.column == column && cell.size == size;
    });
    assert(found != cells.end());
    return *found;
}

double unshadowedChipMs(const std::vector<Table2Cell>& cells, int size, double scene) {
    const auto sums = chipMsByKind(cellOf(cells, Column::None, size), {.scene = scene});
    double all = 0;
    for (const double ms : sums) all += ms;
    return all;
}

/// Where @p f, which grows, is 0.
template <class F>
double rootOf(const F& f, double low, double high) {
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        (f(middle) < 0 ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// Where @p f is least in the range: by steps, then finer around the best of them. It may have several dips.
template <class F>
double leastOf(const F& f, double low, double high) {
    constexpr int kSteps = 16, kRounds = 6;
    double best = low;
    for (int round = 0; round < kRounds; ++round) {
        const double step = (high - low) / kSteps;
        double least = f(best);
        for (int i = 0; i <= kSteps; ++i)
            if (const double x = low + step * i, value = f(x); value < least) least = value, best = x;
        low = std::max(low, best - step), high = std::min(high, best + step);
    }
    return best;
}

/// By frame of a cell.
std::vector<double> chipTimes(const Table2Cell& cell, const Unknowns& unknowns) {
    std::vector<double> times;
    for (const FrameCost& frame : cell.frames) times.push_back(chipMs(frame, unknowns));
    return times;
}

/// The average over frames that take @p chip on the chip.
double averageMs(const std::vector<double>& chip, double host, bool takesTurns) {
    double sum = 0;
    for (const double ms : chip) sum += takesTurns ? host + ms : std::max(host, ms);
    return sum / double(chip.size());
}

/// The sum of squares of the residuals of the cells with shadows, for any host and one number of fragments.
class Residuals {
  public:
    Residuals(const std::vector<Table2Cell>& cells, const Unknowns& unknowns) : m_cells(cells) {
        for (const Table2Cell& cell : cells) m_chip.push_back(chipTimes(cell, unknowns));
    }

    double squares(const Unknowns& unknowns) const {
        double sum = 0;
        for (std::size_t i = 0; i < m_cells.size(); ++i) {
            if (m_cells[i].column == Column::None) continue;
            const double ms = averageMs(m_chip[i], hostMs(m_cells[i], unknowns), unknowns.takesTurns);
            const double residual = std::log(ms / m_cells[i].publishedMs());
            sum += residual * residual;
        }
        return sum;
    }

  private:
    const std::vector<Table2Cell>& m_cells;
    std::vector<std::vector<double>> m_chip{};
};

/// What makes one frame longer than the other.
std::string differenceText(const Table2Cell& longer, const Table2Cell& shorter, const Unknowns& unknowns) {
    static const std::array<const char*, kPassKinds> kNames{"clears", "scene", "volumes", "rectangles",
                                                            "copy"};
    const auto a = chipMsByKind(longer, unknowns), b = chipMsByKind(shorter, unknowns);
    double chipA = 0, chipB = 0;
    std::vector<std::string> terms;
    for (std::size_t kind = 0; kind < a.size(); ++kind) {
        chipA += a[kind], chipB += b[kind];
        if (std::abs(a[kind] - b[kind]) >= 0.005)
            terms.push_back(fmt::format("{} {:+.2f}", kNames[kind], a[kind] - b[kind]));
    }
    const double hostA = hostMs(longer, unknowns), hostB = hostMs(shorter, unknowns);
    const std::string onChip =
        fmt::format("on the chip {:.2f} and {:.2f} ms: {}", chipB, chipA, fmt::join(terms, ", "));
    if (unknowns.takesTurns || (chipA >= hostA && chipB >= hostB)) return onChip;
    if (hostA >= chipA && hostB >= chipB)
        return fmt::format("both wait for the host, {:.2f} and {:.2f} ms; {}", hostB, hostA, onChip);
    return fmt::format("{} waits for the host, {:.2f} ms; {}",
                       name(hostA >= chipA ? longer.column : shorter.column), hostA >= chipA ? hostA : hostB,
                       onChip);
}

}  // namespace

const std::string& name(Column column) {
    static const std::array<std::string, kColumns> kNames{"screen", "alpha",   "stencil",
                                                          "half",   "quarter", "no shadows"};
    return kNames[std::size_t(column)];
}

std::vector<Table2Cell> roettgerTable2() {
    using enum Column;
    struct Row {
        int size;
        double screen, alpha, stencil, half, none;
    };
    std::vector<Table2Cell> cells;
    for (const Row& row : {Row{256, 40.8, 42.4, 42.4, 39.1, 90.4}, Row{512, 29.9, 33.6, 29.1, 30.5, 89.2},
                           Row{1024, 9.3, 10.2, 8.9, 15.7, 44.6}}) {
        cells.push_back({Screen, row.size, row.screen, "roettger-screen"});
        cells.push_back({Alpha, row.size, row.alpha, "roettger-alpha"});
        cells.push_back({Stencil, row.size, row.stencil, "heidmann"});
        cells.push_back({Half, row.size, row.half, "roettger-half"});
        if (row.size == 1024) cells.push_back({Quarter, row.size, 23.6, "roettger-quarter"});
        cells.push_back({None, row.size, row.none, "none"});
    }
    return cells;
}

double modelMs(const Table2Cell& cell, const Unknowns& unknowns) {
    assert(!cell.frames.empty());
    return averageMs(chipTimes(cell, unknowns), hostMs(cell, unknowns), unknowns.takesTurns);
}

Unknowns fromUnshadowed(const std::vector<Table2Cell>& cells, bool takesTurns) {
    const double small = cellOf(cells, Column::None, 256).publishedMs();
    const double large = cellOf(cells, Column::None, 1024).publishedMs();
    const auto excess = [&](double scene) {
        const double host = takesTurns ? small - unshadowedChipMs(cells, 256, scene) : 0;
        return host + unshadowedChipMs(cells, 1024, scene) - large;
    };
    Unknowns u{.scene = rootOf(excess, 0, 100), .takesTurns = takesTurns};
    u.hostMs = takesTurns ? small - unshadowedChipMs(cells, 256, u.scene) : small;
    return u;
}

Table2Fit fitTable2(const std::vector<Table2Cell>& cells, FreeNumbers numbers, bool takesTurns) {
    constexpr double kMostMs = 40;  // the longest published frame of 256x256 takes 25.6 ms
    Table2Fit fit{.unknowns = fromUnshadowed(cells, takesTurns)};
    const auto fitted = [&](double logVolumes) {
        Unknowns best = fit.unknowns;
        best.volumes = std::exp(logVolumes);
        const Residuals residuals(cells, best);
        // One unknown inside the other.
        const auto withScene = [&](Unknowns u) {
            const auto squares = [&](double ms) {
                u.hostSceneMs = ms;
                return residuals.squares(u);
            };
            if (numbers == FreeNumbers::AndScene) u.hostSceneMs = leastOf(squares, 0, kMostMs);
            return std::pair(residuals.squares(u), u);
        };
        const auto withHost = [&](Unknowns u) {
            const auto squares = [&](double ms) {
                u.hostVolumesMs = ms;
                return withScene(u).first;
            };
            if (numbers != FreeNumbers::Volumes) u.hostVolumesMs = leastOf(squares, 0, kMostMs);
            return withScene(u);
        };
        return withHost(best);
    };
    const double best = leastOf([&](double x) { return fitted(x).first; }, std::log(0.01), std::log(1000));
    fit.unknowns = fitted(best).second;

    double squares = 0;
    int count = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        fit.residuals.push_back(std::log(modelMs(cells[i], fit.unknowns) / cells[i].publishedMs()));
        if (cells[i].column == Column::None) continue;
        squares += fit.residuals[i] * fit.residuals[i], ++count;
        if (count == 1 || std::abs(fit.residuals[i]) > std::abs(fit.residuals[fit.worst])) fit.worst = i;
    }
    fit.rms = std::sqrt(squares / count);
    return fit;
}

double stencilFactor(const std::vector<Table2Cell>& cells, const Unknowns& unknowns) {
    const Table2Cell& alpha = cellOf(cells, Column::Alpha, 1024);
    const Table2Cell& stencil = cellOf(cells, Column::Stencil, 1024);
    const double wanted = modelMs(alpha, unknowns) * stencil.publishedMs() / alpha.publishedMs();
    const double volumes = chipMsByKind(stencil, unknowns)[std::size_t(PassKind::Volume)];
    return 1 + (wanted - modelMs(stencil, unknowns)) / volumes;
}

bool OrderLine::isAsPublished() const {
    // Less than the last digit that the paper prints of its shortest frame is no difference.
    constexpr double kEqualMs = 0.005;
    if (mayBeEqual) return fasterMs <= slowerMs + kEqualMs;
    return fasterMs < slowerMs - kEqualMs;
}

std::vector<OrderLine> orderLines(const std::vector<Table2Cell>& cells, const Unknowns& unknowns) {
    using enum Column;
    std::vector<OrderLine> lines;
    const auto add = [&](int size, Column faster, Column slower) {
        const Table2Cell &a = cellOf(cells, faster, size), &b = cellOf(cells, slower, size);
        lines.push_back({.size = size,
                         .faster = faster,
                         .slower = slower,
                         .mayBeEqual = a.published == b.published,
                         .fasterMs = modelMs(a, unknowns),
                         .slowerMs = modelMs(b, unknowns),
                         .reason = differenceText(b, a, unknowns)});
    };
    for (const int size : {256, 512, 1024}) add(size, Alpha, Screen);
    for (const int size : {256, 512, 1024}) add(size, Alpha, Stencil);
    for (const Column full : {Screen, Alpha, Stencil}) add(1024, Half, full);
    for (const Column full : {Screen, Alpha, Stencil}) add(256, full, Half);
    add(1024, Quarter, Half);
    return lines;
}

}  // namespace gnomon
