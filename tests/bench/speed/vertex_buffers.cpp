// Frames from vertex buffers beside the same frames from arrays in the host's memory. Where the processor
// draws, buffers are a copy that nobody needs; they are there for a GPU.
#include <memory>

#include "bench/speed/easel.h"
#include "bench/speed/speed_row.h"
#include "bench/torus.h"

namespace gnomon {
namespace {

/// A torus of 100,000 triangles over a floor.
Scene torusOverFloor() {
    Scene scene;
    scene.objects = {placed("floor", gnomon::rectangle({9, 9}), {0, -0.9f, 0}, false),
                     placed("torus", torusGrid(224), {0, 0, 0})};
    scene.lights = {{.position = {1.3f, 6.1f, 0.7f, 1}}};
    scene.frames = {{.eye = {2.9f, 3.1f, 3.7f}, .target = {0, 0, 0}, .nearPlane = 0.5f}};
    return scene;
}

Round fromBuffers(const Scene& scene, Load load) {
    const int side = load == Load::Full ? 1024 : 32;
    const auto easel = std::make_shared<Easel>(scene, side, side);
    const Plan plan = easel->plan("carmack");
    return [=] {
        Measured times{.ours = easel->frameMs(plan, {.vertices = VertexSource::Buffers}),
                       .beside = easel->frameMs(plan, {.vertices = VertexSource::HostMemory})};
        times.figure = times.ours / times.beside;
        return times;
    };
}

SpeedRow row(const std::string& scene, Scene (*make)()) {
    return {.name = "VertexBuffers/" + scene,
            .what = "frame from vertex buffers over arrays, " + scene,
            .bar = Bar::None,
            .unit = "x",
            .sides = "ms",
            .prepare = [make](Load load) { return fromBuffers(make(), load); }};
}

}  // namespace

std::vector<SpeedRow> vertexBufferRows() {
    return {row("roettger", [] { return shippedScene("roettger"); }),
            row("100,000 triangles", torusOverFloor)};
}

}  // namespace gnomon
