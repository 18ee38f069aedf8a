#include "report/reproduce_kolivand2011.h"

#include <fmt/format.h>

#include <cstdio>

#include "app/options.h"
#include "app/reproduce.h"
#include "app/terminal.h"
#include "matrix/lab.h"
#include "scene/camera_path.h"

namespace gnomon {

int reproduceKolivand2011(const ReproduceOptions& options) {
    const Profile ideal = ProfileOption{}.load({"ideal"}).front();
    Scene scene = theOnly("--scene", scenesOf(options, {"knot"}));
    scene.frames = cameraPath(scene, options.frames.value_or(12));
    if (scene.lights.size() > 1) scene.lights.resize(1);
    const Size size = options.size.value_or(Size{});
    KolivandRun run{.scene = scene.id,
                    .triangles = triangleCount(scene),
                    .width = size.width,
                    .height = size.height,
                    .frames = int(scene.frames.size()),
                    .repeats = options.repeats.value_or(9),
                    .device = measuredOn(options.device),
                    .rows = kolivandTable1()};
    std::vector<TimedWay> ways;
    for (KolivandRow& row : run.rows) {
        ways.push_back({ideal, row.axes});
        row.buildMs.resize(std::size_t(run.repeats));
        row.totalMs.resize(std::size_t(run.repeats));
    }
    Lab lab(std::move(scene));
    lab.drawOn(options.device);
    TerminalProgress bar("frames");
    for (int frame = 0; frame < run.frames; ++frame) {
        bar.show({.done = std::size_t(frame), .all = std::size_t(run.frames)});
        const auto times = lab.frameTimes(ways, size.width, size.height, frame, run.repeats);
        for (std::size_t way = 0; way < ways.size(); ++way)
            for (std::size_t i = 0; i < times[way].size(); ++i) {
                run.rows[way].buildMs[i] += times[way][i].buildMs / run.frames;
                run.rows[way].totalMs[i] += times[way][i].total() / run.frames;
            }
    }
    bar.clear();
    compareRates(run.rows);
    fmt::print("{}", showKolivand(run, options.page));
    return 0;
}

}  // namespace gnomon
