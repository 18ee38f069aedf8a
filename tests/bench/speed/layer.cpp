// What the capability layer adds: to a state call, on a table of empty functions beside these functions; and
// to a frame, with the counter of passes, beside the same calls on the driver's own entry points.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "bench/speed/easel.h"
#include "bench/speed/speed_row.h"
#include "cost/spread.h"
#include "gl/capability.h"
#include "gl/frame_calls.h"
#include "gl/pass_runner.h"
#include "gl/stopwatch.h"
#include "profile/shipped.h"

namespace gnomon {
namespace {

/// Entry points that do nothing; only those that state() calls.
GlTable emptyTable() {
    GlTable gl;
    gl.ColorMask = [](auto...) {};
    gl.Viewport = gl.Scissor = [](auto...) {};
    gl.Enable = gl.Disable = gl.DepthFunc = gl.BlendEquation = gl.CullFace = [](GLenum) {};
    gl.DepthMask = [](GLboolean) {};
    gl.AlphaFunc = [](auto...) {};
    gl.StencilFunc = [](auto...) {};
    gl.StencilOp = [](auto...) {};
    gl.StencilOpSeparate = [](auto...) {};
    gl.StencilMask = [](GLuint) {};
    gl.BlendFunc = [](auto...) {};
    gl.BlendColor = gl.Color4f = [](auto...) {};
    gl.ClearStencil = [](GLint) {};
    gl.EnableClientState = gl.DisableClientState = [](GLenum) {};
    return gl;
}

using StateCall = void (*)(const GlTable&);

/// Each kind of state call that frames are made of, allowed on the chip that allows all.
constexpr StateCall kCalls[]{
    [](const GlTable& gl) { gl.ColorMask(1, 1, 1, 0); },
    [](const GlTable& gl) { gl.Viewport(0, 0, 320, 240); },
    [](const GlTable& gl) { gl.Enable(GL_DEPTH_TEST); },
    [](const GlTable& gl) { gl.Enable(GL_STENCIL_TEST); },
    [](const GlTable& gl) { gl.Enable(GL_BLEND); },
    [](const GlTable& gl) { gl.Disable(GL_BLEND); },
    [](const GlTable& gl) { gl.DepthFunc(GL_LEQUAL); },
    [](const GlTable& gl) { gl.DepthMask(1); },
    [](const GlTable& gl) { gl.AlphaFunc(GL_GREATER, 0.5f); },
    [](const GlTable& gl) { gl.StencilFunc(GL_EQUAL, 0, ~0u); },
    [](const GlTable& gl) { gl.StencilOp(GL_KEEP, GL_KEEP, GL_INCR_WRAP); },
    [](const GlTable& gl) { gl.StencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_INCR_WRAP); },
    [](const GlTable& gl) { gl.StencilMask(~0u); },
    [](const GlTable& gl) { gl.ClearStencil(0); },
    [](const GlTable& gl) { gl.BlendFunc(GL_DST_COLOR, GL_ZERO); },
    [](const GlTable& gl) { gl.BlendEquation(GL_FUNC_ADD); },
    [](const GlTable& gl) { gl.BlendColor(0.5f, 0.5f, 0.5f, 0.5f); },
    [](const GlTable& gl) { gl.Color4f(1, 1, 1, 1); },
    [](const GlTable& gl) { gl.EnableClientState(GL_COLOR_ARRAY); },
};

/// Nanoseconds of one call.
double nanoseconds(StateCall call, const GlTable& gl, int times) {
    const double start = threadCpuMs();
    for (int i = 0; i < times; ++i) call(gl);
    return (threadCpuMs() - start) * 1e6 / times;
}

/// Layered and plain by kind of call; then what they say together.
Round stateCalls(Load load, Measured (*sum)(const std::vector<std::pair<double, double>>&)) {
    const int times = load == Load::Full ? 200'000 : 10;
    const auto profile = std::make_shared<const Profile>(chip("ideal"));
    const auto plain = std::make_shared<GlTable>(emptyTable());
    const auto layered = std::make_shared<GlTable>(restrictTo(*profile, bufferFormatOf(*profile), *plain));
    return [=, held = profile] {
        std::vector<std::pair<double, double>> kinds;
        for (const StateCall call : kCalls) {
            const double with = nanoseconds(call, *layered, times);
            kinds.push_back({with, nanoseconds(call, *plain, times)});
        }
        return sum(kinds);
    };
}

Measured mean(const std::vector<std::pair<double, double>>& kinds) {
    Measured all;
    for (const auto& [with, without] : kinds)
        all.ours += with / double(kinds.size()), all.beside += without / double(kinds.size());
    all.figure = all.ours - all.beside;
    return all;
}

Measured slowest(const std::vector<std::pair<double, double>>& kinds) {
    const auto added = [](const auto& kind) { return kind.first - kind.second; };
    const auto most = std::max_element(kinds.begin(), kinds.end(),
                                       [&](const auto& a, const auto& b) { return added(a) < added(b); });
    return {added(*most), most->first, most->second};
}

/// Thread CPU time of a frame, milliseconds, as render() draws it: through the layer and the counter; or past
/// them.
double frameMs(Easel& easel, const Plan& plan, bool isHeld) {
    Surface& surface = easel.surface();
    surface.makeCurrent();
    const GlTable& driver = surface.driver();
    resetState(driver);
    const double start = threadCpuMs();
    const GlTable& gl = isHeld ? surface.frameCalls().begin(easel.profile()) : driver;
    const LightFrames lights = easel.frame().lights();
    PassRunner runner(gl, surface, easel.profile(), plan, easel.frame().surfaces, lights,
                      VertexSource::HostMemory);
    for (const Pass& pass : plan.passes) runner.run(pass);
    driver.Finish();
    const double ms = threadCpuMs() - start;
    surface.objects().endFrame(driver);
    return ms;
}

Round frames(int width, int height, Load load) {
    const bool isFull = load == Load::Full;
    const auto easel =
        std::make_shared<Easel>(shippedScene("roettger"), isFull ? width : 32, isFull ? height : 24);
    const Plan plan = easel->plan("roettger-alpha");
    return [=] {
        std::vector<double> with, without;
        for (int i = 0; i < (isFull ? 20 : 1); ++i) {
            with.push_back(frameMs(*easel, plan, true));
            without.push_back(frameMs(*easel, plan, false));
        }
        const double held = spreadOf(with).median, bare = spreadOf(without).median;
        return Measured{100 * (held - bare) / bare, held, bare};
    };
}

SpeedRow frameRow(int width, int height) {
    return {.name = fmt::format("Layer/Frame/{}x{}", width, height),
            .what = fmt::format("capability layer: of a frame of {}x{}", width, height),
            .target = 2,
            .unit = "%",
            .sides = "ms",
            .prepare = [=](Load load) { return frames(width, height, load); }};
}

}  // namespace

std::vector<SpeedRow> layerRows() {
    return {{.name = "Layer/StateCall",
             .what = "capability layer: a state call, mean",
             .target = 10,
             .unit = "ns",
             .sides = "ns",
             .prepare = [](Load load) { return stateCalls(load, mean); }},
            {.name = "Layer/SlowestStateCall",
             .what = "capability layer: the slowest state call",
             .target = 10,
             .unit = "ns",
             .sides = "ns",
             .prepare = [](Load load) { return stateCalls(load, slowest); }},
            frameRow(1024, 1024),
            frameRow(320, 240)};
}

}  // namespace gnomon
