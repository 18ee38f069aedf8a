#include "report/reproduce_usta2019.h"

#include <fmt/format.h>

#include <cstdio>

#include "app/options.h"
#include "app/output_file.h"
#include "app/reproduce.h"
#include "app/terminal.h"
#include "matrix/lab.h"
#include "scene/camera_path.h"
#include "scene/subdivide.h"

namespace gnomon {
namespace {

struct Method {
    const char *id = "", *called = "";
    bool byShader = false;
    std::size_t base = 0;  ///< the line of the Z-Pass whose volumes are made the same way
};

const std::vector<Method>& methods() {
    static const std::vector<Method> kMethods{
        {"heidmann", "Z-Pass", false, 0}, {"carmack", "Z-Fail", false, 0}, {"hornus", "ZP+", false, 0},
        {"eisemann", "++ZP", false, 0},   {"heidmann", "Z-Pass", true, 4}, {"eisemann", "++ZP", true, 4},
        {"atomiczp", "AtomicZP", true, 4}};
    return kMethods;
}

std::vector<double> maskMs(const std::vector<FrameTime>& times) {
    std::vector<double> ms;
    for (const FrameTime& time : times) ms.push_back(time.buildMs + time.maskMs);
    return ms;
}

UstaScene measured(Scene scene, const Profile& chip, const UstaRun& run, Device device, TerminalProgress& bar,
                   Progress& at) {
    UstaScene out{.scene = scene.id, .triangles = triangleCount(scene)};
    std::vector<TimedWay> ways;
    for (const Method& method : methods()) {
        out.lines.push_back({.method = method.id, .called = method.called, .byShader = method.byShader});
        // AtomicZP's volumes are the shader's as it is.
        const Axes& axes = findMethod(method.id)->axes;
        ways.push_back({.profile = chip,
                        .axes = axes,
                        .shaderVolumes = method.byShader && axes.count != Count::AtomicZp});
    }
    Lab lab(std::move(scene));
    lab.drawOn(device);
    for (int frame = 0; frame < run.frames; ++frame, ++at.done) {
        bar.show(at);
        const auto times = lab.frameTimes(ways, run.width, run.height, frame, run.repeats, true);
        for (std::size_t i = 0; i < ways.size(); ++i) {
            UstaLine& line = out.lines[i];
            const auto ms = maskMs(times[i]);
            line.ms.push_back(spreadOf(ms).median);
            line.ratios.push_back(spreadOf(ratios(ms, maskMs(times[methods()[i].base]))).median);
            const Cell cell = lab.run(chip, ways[i].axes, run.width, run.height, frame);
            if (cell.verdict == Verdict::Failed) throw std::runtime_error(cell.id() + ": " + cell.error);
            line.wrong += cell.wrongEdge + cell.wrongInterior;
            line.framesWrong += cell.wrongEdge + cell.wrongInterior > 0;
        }
    }
    return out;
}

}  // namespace

int reproduceUsta2019(const ReproduceOptions& options) {
    const Profile ideal = ProfileOption{}.load({"ideal"}).front();
    std::vector<Scene> scenes = scenesOf(options, {"roettger", "boxes", "knot"});
    if (!options.subdivide.empty() && options.subdivide.size() != scenes.size())
        throw UsageError(
            fmt::format("--subdivide: {} numbers for {} scenes", options.subdivide.size(), scenes.size()));
    const Size size = options.size.value_or(Size{});
    UstaRun run{.width = size.width,
                .height = size.height,
                .frames = options.frames.value_or(12),
                .repeats = options.repeats.value_or(10),
                .device = measuredOn(options.device)};
    TerminalProgress bar("frames");
    Progress at{.all = scenes.size() * std::size_t(run.frames)};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        Scene& scene = scenes[i];
        if (scene.lights.empty()) throw UsageError(fmt::format("{}: no light", scene.id));
        scene.lights.resize(1);
        scene.frames = cameraPath(scene, run.frames);
        if (!options.subdivide.empty())
            for (Object& object : scene.objects) object.mesh = subdivided(object.mesh, options.subdivide[i]);
        run.scenes.push_back(measured(std::move(scene), ideal, run, options.device, bar, at));
    }
    bar.clear();
    fmt::print("{}", showUsta(run, options.page));
    if (!options.plot.empty()) writeChosen([&] { savePlots(ustaPlots(run), options.plot); });
    return 0;
}

}  // namespace gnomon
