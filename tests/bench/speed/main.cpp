/// The speed that gnomon's own paths are held to: each row a target and what is measured beside it, in one
/// run.
///
///   speed_bench --table [--benchmark_repetitions=N] [--benchmark_filter=REGEX]
///       the table: medians of the rounds with their quartiles, targets, and misses by name. Rows take turns
///       in random order; both sides of a ratio are measured in one round.
///   speed_bench
///       the same figures as Google Benchmark prints them
///
/// A subject is a file of rows: tests/bench/speed/<subject>.cpp, named in speed_row.h and in subjects()
/// below.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>

#include "bench/run_benchmarks.h"
#include "bench/speed/speed_row.h"
#include "cost/spread.h"

namespace gnomon {
namespace {

std::vector<SpeedRow> subjects() {
    std::vector<SpeedRow> rows;
    for (const auto& subject :
         {maskPassRows, halfRows, vertexBufferRows, layerRows, workerRows, truthRows, judgeRows})
        for (SpeedRow& row : subject()) rows.push_back(std::move(row));
    return rows;
}

/// A row as benchmarks: one for its figures, and a small one of one round.
/// @param rounds  gets what they share
void addRow(const SpeedRow& row, std::vector<std::shared_ptr<Round>>& rounds) {
    const auto run = [row](benchmark::State& state, std::shared_ptr<Round> round, Load load) {
        try {
            if (!*round) {
                *round = row.prepare(load);
                if (load == Load::Full) (*round)();
            }
            for ([[maybe_unused]] const auto _ : state) {
                const Measured measured = (*round)();
                state.counters["figure"] = measured.figure;
                state.counters["ours"] = measured.ours;
                state.counters["beside"] = measured.beside;
            }
        } catch (const std::exception& error) {
            state.SkipWithError(error.what());
        }
    };
    for (const Load load : {Load::Full, Load::Smoke}) {
        const std::string name = fmt::format("{}{}", load == Load::Smoke ? "Smoke/" : "", row.name);
        rounds.push_back(std::make_shared<Round>());
        benchmark::RegisterBenchmark(name.c_str(), run, rounds.back(), load)
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    }
}

/// Prints the table. Rows that were not run are left out; one that failed is a miss.
class SpeedReporter : public benchmark::BenchmarkReporter {
  public:
    explicit SpeedReporter(const std::vector<SpeedRow>& rows) : m_rows(rows) {}

    bool ReportContext(const Context&) override { return true; }

    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration) continue;
            Figures& figures = m_figures[run.run_name.function_name];
            if (run.error_occurred) {
                figures.error = run.error_message;
                continue;
            }
            for (const auto& [name, value] : run.counters) figures.counters[name].push_back(value);
        }
    }

    void Finalize() override {
        fmt::print("{:<60} {:>10}  {:<28}{}\n", "", "target", "median (quartiles)", "its sides");
        int met = 0, all = 0;
        std::string misses;
        for (const SpeedRow& row : m_rows) {
            const auto found = m_figures.find(row.name);
            if (found == m_figures.end()) continue;
            all += row.bar != Bar::None;
            Figures& figures = found->second;
            const std::string target =
                row.bar == Bar::None
                    ? "none"
                    : fmt::format("{} {:g} {}", row.bar == Bar::AtMost ? "<=" : ">=", row.target, row.unit);
            if (!figures.error.empty()) {
                fmt::print("{:<60} {:>10}  failed: {}\n", row.what, target, figures.error);
                misses += fmt::format("missed: {}: {}\n", row.what, figures.error);
                continue;
            }
            const Spread figure = spreadOf(figures.counters["figure"]);
            const bool meets = row.bar == Bar::None || (row.bar == Bar::AtMost ? figure.median <= row.target
                                                                               : figure.median >= row.target);
            met += meets && row.bar != Bar::None;
            if (!meets)
                misses += fmt::format("missed: {}: {:.3g} {} (target {})\n", row.what, figure.median,
                                      row.unit, target);
            const std::string sides =
                row.sides.empty()
                    ? ""
                    : fmt::format("{:.3g} and {:.3g} {}", spreadOf(figures.counters["ours"]).median,
                                  spreadOf(figures.counters["beside"]).median, row.sides);
            fmt::print("{:<60} {:>10}  {:<28}{}\n", row.what, target,
                       fmt::format("{:.3g} ({:.3g} to {:.3g}) {}{}", figure.median, figure.low, figure.high,
                                   row.unit, meets ? "" : " *"),
                       sides);
        }
        fmt::print("\n{} of {} targets are met.\n{}", met, all, misses);
        std::fflush(stdout);
    }

  private:
    struct Figures {
        std::map<std::string, std::vector<double>> counters{};
        std::string error{};
    };
    const std::vector<SpeedRow>& m_rows;
    std::map<std::string, Figures> m_figures{};
};

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
    using namespace gnomon;
    const std::vector<SpeedRow> rows = subjects();
    std::vector<std::shared_ptr<Round>> rounds;
    for (const SpeedRow& row : rows) addRow(row, rounds);
    SpeedReporter reporter(rows);
    const int status = runBenchmarks(argc, argv, reporter, {.repetitions = 9});
    // Google Benchmark keeps its benchmarks until the program ends, when OpenGL's library is gone already.
    for (const auto& round : rounds) *round = {};
    return status;
}
