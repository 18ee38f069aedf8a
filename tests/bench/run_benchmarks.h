#pragma once

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// What --table runs, where other options don't say otherwise.
struct TableRun {
    int repetitions = 7;
    std::string filter{"-Smoke"};  ///< of names, as --benchmark_filter has it
};

/// The rest of main() once the benchmarks are registered. With --table @p reporter prints them, in an order
/// that is shuffled so that what is compared shares the machine's moods.
/// @return the exit status
inline int runBenchmarks(int argc, char** argv, benchmark::BenchmarkReporter& reporter,
                         const TableRun& table = {}) {
    std::vector<char*> arguments(argv, argv + argc);
    const bool asTable =
        std::erase_if(arguments, [](const char* a) { return std::string_view(a) == "--table"; }) > 0;
    std::string defaults[]{fmt::format("--benchmark_repetitions={}", table.repetitions),
                           "--benchmark_enable_random_interleaving=true",
                           fmt::format("--benchmark_filter={}", table.filter)};
    if (asTable)
        for (std::string& word : defaults) arguments.insert(arguments.begin() + 1, word.data());
    int count = int(arguments.size());
    arguments.push_back(nullptr);
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
    asTable ? benchmark::RunSpecifiedBenchmarks(&reporter) : benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}

}  // namespace gnomon
