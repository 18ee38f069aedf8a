/// What the chips' own arithmetic costs beside OpenGL's blending, on one core of this machine.
///
/// Frames of 1024x1024 of the shipped scenes, drawn through the capability layer as the program draws them;
/// the time is that of the frame with the timed passes 16 times over, less that without them, by thread
/// CPU time.
///
/// - Mask/SCENE/PROFILE/gl, .../chip: the mask of roettger-screen (PS2: screen-texture), volumes and
/// rectangles
/// - Rectangle/PROFILE/gl, .../chip: its rectangles alone
/// - Volumes/SCENE/stencil, .../alpha/gl, .../alpha/chip: the volume passes of heidmann and of roettger-alpha
/// - Smoke: one small frame of each kind
///
/// Each repetition draws all ways in turn. --table prints the medians of the repetitions' ratios, with the
/// bars.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "bench/run_benchmarks.h"
#include "gl/renderer.h"
#include "gl/tools.h"
#include "scene/scene_file.h"

namespace gnomon {
namespace {

constexpr int kSide = 1024;

Scene shippedScene(const std::string& id) {
    return loadSceneFile(std::filesystem::path(GNOMON_SOURCE) / "scenes" / (id + ".toml"));
}

/// No old chip of 16 bits drew frames of this size; its arithmetic doesn't mind.
Profile withoutLimits(Profile profile) {
    profile.maxWidth = profile.maxHeight = 0;
    profile.frameBytes = 0;
    profile.maxTextureSize = std::max(profile.maxTextureSize, kSide);
    return profile;
}

/// One method on one chip, ready to be drawn again and again: as it is but for the passes that are timed,
/// which are left out, and with each of them several times.
class Easel {
  public:
    Easel(const std::string& scene, const std::string& profile, const std::string& method, Fidelity fidelity,
          bool (*isTimed)(const Pass&), int side = kSide)
        : m_profile(withoutLimits(chip(profile))),
          m_frame(frameOf(shippedScene(scene), side, side)),
          m_surface(bufferFormatOf(m_profile), side, side, arithmeticOf(m_profile, {.fidelity = fidelity})) {
        Plan plan = planFrame(findMethod(method)->axes, shapeOf(int(m_frame.volumes().size()), side, side),
                              m_profile);
        std::size_t end = plan.masks.front().after;
        for (std::size_t i = 0; i < end; ++i)
            if (plan.passes[i].kind == PassKind::Copy) end = i;
        plan.masks.clear();
        m_without = m_with = plan;
        m_without.passes.clear();
        m_with.passes.clear();
        for (std::size_t i = 0; i < plan.passes.size(); ++i) {
            const bool timed = i < end && isTimed(plan.passes[i]);
            if (!timed) m_without.passes.push_back(plan.passes[i]);
            m_with.passes.push_back(plan.passes[i]);
            const bool ends = timed && !(i + 1 < end && isTimed(plan.passes[i + 1]));
            if (ends) {
                // The whole run of timed passes once more and again.
                std::size_t begin = i;
                while (begin > 0 && isTimed(plan.passes[begin - 1])) --begin;
                for (int times = 1; times < kTimes; ++times)
                    for (std::size_t k = begin; k <= i; ++k) m_with.passes.push_back(plan.passes[k]);
            }
        }
        draw();  // programs are compiled here
    }

    /// Thread CPU time of the timed passes, milliseconds.
    double draw() { return (frame(m_with) - frame(m_without)) / kTimes; }

  private:
    double frame(const Plan& plan) {
        return render(m_surface, m_profile, plan, m_frame.surfaces, m_frame.lights()).cpuMs;
    }

    static constexpr int kTimes = 16;
    Profile m_profile;
    Frame m_frame;
    Surface m_surface;
    Plan m_with{}, m_without{};
};

bool isVolume(const Pass& pass) {
    return pass.kind == PassKind::Volume;
}
bool isRectangle(const Pass& pass) {
    return pass.kind == PassKind::Rectangle;
}
bool isOfMask(const Pass& pass) {
    return isVolume(pass) || isRectangle(pass);
}

/// One way of drawing in a comparison.
struct Way {
    std::string name{}, profile{}, method{};
    Fidelity fidelity = Fidelity::Gl;
};

/// Draws all ways in turn, so that they share the machine's moods; the first is what the others are held to.
void compare(const std::string& name, const std::string& scene, const std::vector<Way>& ways,
             bool (*counts)(const Pass&)) {
    benchmark::RegisterBenchmark(name.c_str(),
                                 [=](benchmark::State& state) {
                                     std::vector<std::unique_ptr<Easel>> easels;
                                     for (const Way& way : ways)
                                         easels.push_back(std::make_unique<Easel>(
                                             scene, way.profile, way.method, way.fidelity, counts));
                                     for ([[maybe_unused]] const auto _ : state) {
                                         double all = 0, first = 0;
                                         for (std::size_t i = 0; i < ways.size(); ++i) {
                                             const double ms = easels[i]->draw();
                                             if (i == 0) first = ms;
                                             all += ms;
                                             state.counters[ways[i].name] = ms;
                                             if (i > 0) state.counters[ways[i].name + " ratio"] = ms / first;
                                         }
                                         state.SetIterationTime(all / 1e3);
                                     }
                                 })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
}

void addAll() {
    for (const std::string scene : {"roettger", "boxes", "knot"}) {
        for (const std::string profile : {"voodoo2", "ps2", "tnt", "geforce2mx"}) {
            const std::string method = profile == "ps2" ? "screen-texture" : "roettger-screen";
            const std::vector<Way> ways{{"gl", profile, method}, {"chip", profile, method, Fidelity::Chip}};
            compare(fmt::format("Mask/{}/{}", scene, profile), scene, ways, isOfMask);
            if (scene == "boxes") compare(fmt::format("Rectangle/{}", profile), scene, ways, isRectangle);
        }
        compare(fmt::format("Volumes/{}", scene), scene,
                {{"stencil", "geforce2mx", "heidmann"},
                 {"alpha gl", "geforce2mx", "roettger-alpha"},
                 {"alpha chip", "geforce2mx", "roettger-alpha", Fidelity::Chip}},
                isVolume);
    }
    benchmark::RegisterBenchmark("Smoke", [](benchmark::State& state) {
        Easel alpha("boxes", "geforce2mx", "roettger-alpha", Fidelity::Chip, isVolume, 64);
        Easel screen("boxes", "voodoo2", "roettger-screen", Fidelity::Chip, isOfMask, 64);
        for ([[maybe_unused]] const auto _ : state)
            if (alpha.draw() + screen.draw() <= 0) state.SkipWithError("no pass is timed");
    })->Iterations(1);
}

/// Prints medians of the repetitions: times, and ratios with the least and the greatest.
class RatioReporter : public benchmark::BenchmarkReporter {
  public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
            for (const auto& [counter, value] : run.counters)
                m_values[run.run_name.function_name][counter].push_back(value);
        }
    }
    void Finalize() override {
        fmt::print("{:<26}{:<11}{:>7}  {:<8}{:>7}  {:<22}{}\n", "", "", "ms", "beside", "ms",
                   "ratio (min to max)", "bar");
        for (auto& [name, counters] : m_values) {
            const bool volumes = name.starts_with("Volumes");
            const char* beside = volumes ? "stencil" : "gl";
            for (auto& [counter, values] : counters) {
                if (!counter.ends_with(" ratio")) continue;
                const std::string way = counter.substr(0, counter.size() - 6);
                const char* bar = way == "alpha gl" ? "" : volumes ? "1.3" : "1.0";
                const auto [low, high] = std::minmax_element(values.begin(), values.end());
                fmt::print("{:<26}{:<11}{:>7.2f}  {:<8}{:>7.2f}  {:<22}{}\n", name, way,
                           median(counters[way]), beside, median(counters[beside]),
                           fmt::format("{:.2f} ({:.2f} to {:.2f})", median(values), *low, *high), bar);
            }
        }
        std::fflush(stdout);
    }

  private:
    static double median(std::vector<double> values) {
        std::sort(values.begin(), values.end());
        return values[values.size() / 2];
    }
    std::map<std::string, std::map<std::string, std::vector<double>>> m_values{};
};

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
    gnomon::addAll();
    gnomon::RatioReporter reporter;
    return gnomon::runBenchmarks(argc, argv, reporter);
}
