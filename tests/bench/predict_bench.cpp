/// What predicting a frame costs on one core: 512x512 pixels, a closed torus of 100,352 triangles over a
/// floor.
///
/// - Casters: the casters' faces and sides, by the plain builder
/// - Crossings: what every pixel's eye ray crosses; of winding sides, and of one volume per triangle of
///   a torus of 8,192
/// - Mask: the passes done over in every pixel, given the crossings; a stencil's and a colour's
/// - Frame: all of it for one method
/// - Truth: the tracer's frame, beside which the others stand
/// - Smoke: all of it on a small mesh
///
/// --table prints medians and spreads. bar_ms is what a frame may take.
#include <benchmark/benchmark.h>

#include <memory>

#include "bench/run_benchmarks.h"
#include "bench/table_reporter.h"
#include "bench/torus.h"
#include "method/method.h"
#include "predict/mask_prediction.h"
#include "predict/window_prediction.h"
#include "scene/primitives.h"

namespace gnomon {
namespace {

constexpr int kSize = 512;
constexpr std::uint32_t kQuads = 224;       ///< per side of the grid: 100,352 triangles
constexpr std::uint32_t kSingleQuads = 64;  ///< 8,192 triangles

Scene torusOverFloor(std::uint32_t quads) {
    Scene scene{.id = "torus"};
    scene.objects.push_back({.name = "torus", .mesh = torusGrid(quads)});
    Mesh floor = rectangle({12, 12});
    for (glm::vec3& p : floor.positions) p.y = -1.03f;
    scene.objects.push_back({.name = "floor", .mesh = floor, .casts = false});
    scene.lights.push_back({.position = {1.7f, 4.1f, 0.9f, 1}});
    scene.frames.push_back({.eye = {2.9f, 2.3f, 3.1f}, .target = {0, -0.3f, 0}, .nearPlane = 0.5f});
    return scene;
}

/// A frame and one method on it.
struct Setup {
    explicit Setup(std::uint32_t quads, Silhouette silhouette, int size = kSize)
        : scene(torusOverFloor(quads)),
          axes{.silhouette = silhouette},
          view(viewOf(scene.frames[0], size, size)) {}

    std::vector<LitCaster> casters() const { return litCasters(scene, light(), axes.silhouette); }
    Crossings crossings(const std::vector<LitCaster>& lit) const {
        return crossingsOf(scene, lit, light(), view, depthTies(24));
    }
    const glm::vec4& light() const { return scene.lights[0].position; }

    Plan planOf(Store store, const std::vector<LitCaster>& lit) {
        axes.store = store;
        axes.arithmetic = store == Store::Stencil ? Arithmetic::Count : Arithmetic::Double;
        Profile chip;
        chip.colourFormats = {{"888", 8, 8, 8, 0}};
        return planFrame(axes, {view.width, view.height, {{.volumes = int(volumeCount(lit))}}}, chip);
    }
    /// Sums up the mask, so that all of it is made.
    int mask(const Plan& plan, const Crossings& crossings) const {
        MaskPrediction mask(
            {.plan = plan, .crossings = crossings, .arithmetic = {.format = {"", 8, 8, 8, 8}}});
        const WindowPrediction window(plan, mask, 8);
        int shadows = 0;
        for (std::size_t p = 0; p < std::size_t(view.width) * std::size_t(view.height); ++p)
            shadows += window.shadow(p);
        return shadows;
    }

    Scene scene;
    Axes axes;
    View view;
};

void run(benchmark::State& state, Setup& setup, Store store) {
    for (auto _ : state) {
        const auto lit = setup.casters();
        const Crossings crossings = setup.crossings(lit);
        benchmark::DoNotOptimize(setup.mask(setup.planOf(store, lit), crossings));
    }
}

void addAll() {
    const auto add = [](const std::string& name, auto function, double bar = 0) {
        benchmark::RegisterBenchmark(name.c_str(),
                                     [function, bar](benchmark::State& state) {
                                         function(state);
                                         if (bar > 0) state.counters["bar_ms"] = bar;
                                     })
            ->Unit(benchmark::kMillisecond)
            ->Iterations(1);
    };
    const auto winding = std::make_shared<Setup>(kQuads, Silhouette::Winding);
    const auto single = std::make_shared<Setup>(kSingleQuads, Silhouette::PerTriangle);
    add("Casters/winding", [=](benchmark::State& state) {
        for (auto _ : state) benchmark::DoNotOptimize(winding->casters());
    });
    for (const auto& [name, of] : {std::pair("winding", winding), std::pair("per-triangle", single)}) {
        const std::shared_ptr<Setup> world = of;
        add(std::string("Crossings/") + name, [world](benchmark::State& state) {
            const auto lit = world->casters();
            for (auto _ : state) benchmark::DoNotOptimize(world->crossings(lit));
        });
    }
    for (const auto& [name, of] :
         {std::pair("stencil", Store::Stencil), std::pair("screen", Store::Screen)}) {
        const Store store = of;
        add(std::string("Mask/") + name, [=](benchmark::State& state) {
            const auto lit = winding->casters();
            const Crossings crossings = winding->crossings(lit);
            const Plan plan = winding->planOf(store, lit);
            for (auto _ : state) benchmark::DoNotOptimize(winding->mask(plan, crossings));
        });
        add(
            std::string("Frame/") + name, [=](benchmark::State& state) { run(state, *winding, store); },
            2000);
    }
    add("Truth", [=](benchmark::State& state) {
        const Tracer tracer(winding->scene, winding->scene.lights[0]);
        for (auto _ : state) benchmark::DoNotOptimize(tracer.trace(winding->view, depthTies(24)));
    });
    add("Smoke", [](benchmark::State& state) {
        Setup small(12, Silhouette::Winding, 48);
        run(state, small, Store::Screen);
    });
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
    gnomon::addAll();
    gnomon::TableReporter reporter;
    return gnomon::runBenchmarks(argc, argv, reporter);
}
