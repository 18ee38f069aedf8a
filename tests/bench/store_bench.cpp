// What limits a run of many millions of cells on the side of its store: verdicts are put one by one into
// shards, as a run does it, read again as when it goes on, and merged. Nothing is drawn but the cells whose
// texts all verdicts have.
//
//     store_bench --table [VERDICTS]     default: 1000000

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/run_benchmarks.h"
#include "matrix/cell_json.h"
#include "matrix/merge.h"
#include "matrix/run.h"
#include "matrix/temporary_folder.h"
#include "profile/shipped.h"
#include "scene/load.h"

namespace gnomon {
namespace {

constexpr int kShards = 4;

double secondsOf(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Cells as they come: exact, wrong, refused.
std::vector<StoredCell> drawnCells() {
    MatrixRequest request;
    request.profiles = {chip("ideal"), chip("voodoo2"), chip("ps2")};
    for (const NamedMethod& named : namedMethods())
        if (!named.axes.automatic) request.methods.push_back(named.axes);
    request.scenes = {loadScene(GNOMON_SOURCE "/scenes/boxes.toml")};
    request.sizes = {{64, 48}};
    request.frames = {0};
    std::vector<StoredCell> cells;
    for (const Cell& cell : runMatrix(request))
        cells.push_back({.verdict = name(cell.verdict),
                         .seconds = 0.01,
                         .digest = contentDigest(cell),
                         .cell = toJson(cell).dump()});
    return cells;
}

struct Figures {
    double putSeconds = 0, readSeconds = 0, mergeSeconds = 0, digestSeconds = 0;
    std::uintmax_t bytes = 0;  ///< of the whole
};

/// @p verdicts in kShards shards, and merged.
Figures simulated(std::size_t verdicts) {
    const TemporaryFolder folder;
    const std::vector<StoredCell> drawn = drawnCells();
    Figures figures;
    std::vector<std::filesystem::path> shards;
    for (int index = 1; index <= kShards; ++index) {
        shards.push_back(folder / fmt::format("shard-{}", index));
        const std::size_t first = verdicts * std::size_t(index - 1) / kShards;
        const std::size_t end = verdicts * std::size_t(index) / kShards;
        figures.putSeconds += secondsOf([&] {
            CellStore store = CellStore::toWrite(shards.back());
            store.setSettings(
                {{"shard", toText(Shard{index, kShards})}, {"cells", fmt::format("{}", end - first)}});
            for (std::size_t place = first; place < end; ++place) {
                StoredCell cell = drawn[place % drawn.size()];
                cell.place = cell.key = place;
                store.put(cell);
            }
            store.finish();
        });
        figures.readSeconds += secondsOf([&] {
            CellStore::toRead(shards.back()).forEach([&](const StoredCell& stored) {
                const Cell cell = cellFromJson(nlohmann::ordered_json::parse(stored.cell));
                if (contentDigest(cell) != stored.digest)
                    throw std::logic_error("another cell was read than was put");
            });
        });
    }
    std::size_t merged = 0;
    figures.mergeSeconds = secondsOf([&] { merged = mergedShards(shards, folder / "whole").count(); });
    if (merged != verdicts) throw std::logic_error(fmt::format("{} cells of {}", merged, verdicts));
    figures.digestSeconds = secondsOf([&] { CellStore::toRead(folder / "whole").digest(); });
    figures.bytes = std::filesystem::file_size(folder / "whole" / CellStore::kFile);
    return figures;
}

void showTable(std::size_t verdicts) {
    const Figures f = simulated(verdicts);
    const auto row = [&](const char* what, double seconds) {
        fmt::print("{:<52}{:>9.1f} s{:>9.1f} us{:>9.1f} min\n", what, seconds,
                   seconds / double(verdicts) * 1e6, seconds / double(verdicts) * 1e7 / 60);
    };
    fmt::print("{:<52}{:>11}{:>12}{:>13}\n", fmt::format("{} verdicts in {} shards", verdicts, kShards),
               "in all", "each", "10 million");
    row("put, a transaction each", f.putSeconds);
    row("read and checked, as a run that goes on does", f.readSeconds);
    row("merged", f.mergeSeconds);
    row("digest of the whole", f.digestSeconds);
    fmt::print("{:<52}{:>8.2f} GB{:>9.0f} B {:>9.1f} GB\n", "the whole on disk, without pictures",
               double(f.bytes) / 1e9, double(f.bytes) / double(verdicts),
               double(f.bytes) / double(verdicts) * 1e7 / 1e9);
}

void smoke(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(simulated(400));
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
    using namespace gnomon;
    if (argc >= 2 && std::string(argv[1]) == "--table") {
        try {
            showTable(argc > 2 ? std::stoul(argv[2]) : 1'000'000);
        } catch (const std::exception& error) {
            fmt::print(stderr, "{}\n", error.what());
            return 2;
        }
        return 0;
    }
    benchmark::RegisterBenchmark("Smoke", smoke);
    benchmark::ConsoleReporter reporter;
    return runBenchmarks(argc, argv, reporter);
}
