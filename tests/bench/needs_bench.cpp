/// What minimal plans save: frame time (thread CPU time of the OpenGL calls) and touched pixels of the plan
/// with what each frame calls for, as shares of the full plan's. Both are drawn in turn in one process; of
/// each frame the medians of the repetitions make one ratio.
///
///   needs_bench --table [SCENE...]  medians, least and largest over the frames of each scene's path; without
///                                   scenes roettger, boxes, and the two of shared/data/scenes where they are
///   needs_bench                     (Google Benchmark) a small frame by both, and what the needs cost
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "bench/run_benchmarks.h"
#include "cost/spread.h"
#include "matrix/choice.h"
#include "profile/shipped.h"
#include "scene/load.h"

namespace gnomon {
namespace {

constexpr int kRepeats = 5;
constexpr int kWidth = 320, kHeight = 240;
constexpr std::size_t kMostFrames = 12;
const std::vector<std::string> kMethods{"heidmann", "carmack", "roettger-screen", "roettger-alpha", "hornus"};

struct Ratios {
    std::vector<double> time{}, touched{};
};

/// The time of the OpenGL calls alone: what the host builds is the same by both.
std::vector<double> drawMs(const std::vector<FrameTime>& times) {
    std::vector<double> ms;
    for (const FrameTime& time : times) ms.push_back(time.drawMs);
    return ms;
}

void addFrame(Lab& lab, const Profile& profile, const Axes& axes, int frame, Ratios& ratios) {
    const std::vector<TimedWay> ways{{profile, axes, {}, Effects::all()},
                                     {profile, axes, {}, Effects::none()}};
    const auto times = lab.frameTimes(ways, kWidth, kHeight, frame, kRepeats);
    ratios.time.push_back(spreadOf(drawMs(times[1])).median / spreadOf(drawMs(times[0])).median);
    const MinimalPlan least = lab.minimalPlan(profile, axes, kWidth, kHeight, frame);
    ratios.touched.push_back(
        double(sumOf(lab.amounts(profile, least, kWidth, kHeight, frame)).pixels.total()) /
        double(sumOf(lab.fullAmounts(profile, axes, kWidth, kHeight, frame)).pixels.total()));
}

std::string spread(const std::vector<double>& ratios) {
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    return fmt::format("{:.2f} ({:.2f} to {:.2f})", spreadOf(ratios).median, *least, *most);
}

void showTable(std::vector<std::string> files) {
    const std::filesystem::path root(GNOMON_SOURCE);
    if (files.empty()) {
        for (const char* id : {"roettger", "boxes"})
            files.push_back((root / "scenes" / fmt::format("{}.toml", id)).string());
        for (const char* id : {"crypt_248lights.glb", "sponza_crytek.glb"}) {
            const auto file = root / ".." / "shared" / "data" / "scenes" / id;
            if (std::filesystem::exists(file)) files.push_back(file.string());
        }
    }
    fmt::print("minimal over full, {}x{}, ideal: median (least to largest) of the frames\n\n", kWidth,
               kHeight);
    fmt::print("{:<22} {:<16} {:>6}  {:<22} {:<22}\n", "scene", "method", "frames", "frame time",
               "touched pixels");
    std::vector<double> timeMedians, touchedMedians;
    const Profile profile = chip("ideal");
    for (const std::string& file : files) {
        Scene scene = loadScene(file);
        if (scene.lights.size() > 8) scene.lights.resize(8);  // as the program draws them by default
        Lab lab(std::move(scene));
        const std::size_t frames = lab.scene().frames.size();
        std::vector<Ratios> all(kMethods.size());
        const std::size_t count = std::min(frames, kMostFrames);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t m = 0; m < kMethods.size(); ++m)
                addFrame(lab, profile, findMethod(kMethods[m])->axes, int(i * frames / count), all[m]);
        for (std::size_t m = 0; m < kMethods.size(); ++m) {
            fmt::print("{:<22} {:<16} {:>6}  {:<22} {:<22}\n", std::filesystem::path(file).stem().string(),
                       kMethods[m], count, spread(all[m].time), spread(all[m].touched));
            timeMedians.push_back(spreadOf(all[m].time).median),
                touchedMedians.push_back(spreadOf(all[m].touched).median);
        }
        std::fflush(stdout);
    }
    const auto mean = [](const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    };
    fmt::print("\nmean of the medians: frame time {:.2f}, touched pixels {:.2f}\n", mean(timeMedians),
               mean(touchedMedians));
}

void smoke(benchmark::State& state, const Effects& effects) {
    Lab lab(loadScene(std::filesystem::path(GNOMON_SOURCE) / "scenes" / "boxes.toml"));
    const std::vector<TimedWay> ways{{chip("ideal"), findMethod("carmack")->axes, {}, effects}};
    for (auto _ : state) benchmark::DoNotOptimize(lab.frameTimes(ways, 64, 48, 0, 1));
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
    using namespace gnomon;
    std::vector<std::string> words(argv + 1, argv + argc);
    const auto table = std::find(words.begin(), words.end(), "--table");
    if (table != words.end()) {
        words.erase(table);
        try {
            showTable(words);
        } catch (const std::runtime_error& error) {
            fmt::print(stderr, "{}\n", error.what());
            return 2;
        }
        return 0;
    }
    benchmark::RegisterBenchmark("Smoke/full", smoke, Effects::all());
    benchmark::RegisterBenchmark("Smoke/needed", smoke, Effects::none());
    benchmark::ConsoleReporter reporter;
    return runBenchmarks(argc, argv, reporter);
}
