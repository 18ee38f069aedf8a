#pragma once

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace gnomon {

/// Prints medians with their spread as one table: a row per step, its bar, and the plain scalar loop of the
/// same run beside it where there is one ("Scalar" and the step's name).
class TableReporter : public benchmark::BenchmarkReporter {
  public:
    bool ReportContext(const Context&) override { return true; }

    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
            // step/order/triangles[/kernels]
            const std::string name = run.run_name.function_name;
            if (!m_times.contains(name)) m_order.push_back(name);
            m_times[name].push_back(run.GetAdjustedCPUTime() * toMilliseconds(run.time_unit));
            const auto bar = run.counters.find("bar_ms");
            if (bar != run.counters.end()) m_bars[name] = bar->second;
        }
    }

    void Finalize() override {
        fmt::print("{:<42}{:>8}  {:<24}{}\n", "step/order/triangles/kernels", "bar ms",
                   "median (min to max) ms", "plain loop, ratio");
        std::sort(m_order.begin(), m_order.end());
        for (const std::string& name : m_order) {
            if (name.starts_with("Scalar") || name == "Smoke") continue;
            const auto bar = m_bars.find(name);
            // The loop has no kernels in its name.
            const std::string plain = "Scalar" + name;
            const auto loop = std::find_if(m_order.begin(), m_order.end(), [&](const std::string& other) {
                return plain == other || plain.starts_with(other + "/");
            });
            fmt::print("{:<42}{:>8}  {:<24}{}\n", name,
                       bar == m_bars.end() ? "" : fmt::format("{}", bar->second), spread(m_times[name]),
                       loop == m_order.end() ? ""
                                             : fmt::format("{:.3g}, {:.1f}", median(m_times[*loop]),
                                                           median(m_times[*loop]) / median(m_times[name])));
        }
        std::fflush(stdout);
    }

  private:
    static double toMilliseconds(benchmark::TimeUnit unit) {
        return 1e3 / benchmark::GetTimeUnitMultiplier(unit);
    }
    static double median(std::vector<double> values) {
        std::sort(values.begin(), values.end());
        return values[values.size() / 2];
    }
    static std::string spread(const std::vector<double>& values) {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return fmt::format("{:.3g} ({:.3g} to {:.3g})", median(values), *low, *high);
    }

    std::vector<std::string> m_order{};
    std::map<std::string, std::vector<double>> m_times{};
    std::map<std::string, double> m_bars{};
};

}  // namespace gnomon
