// What a mask pass costs beside its fragments: the volume passes of a plan, as the renderer draws them,
// beside the same triangles as one plain batch: one glDrawArrays on the driver's own entry points under the
// state of the first of these passes, without culling, so that front and back faces are drawn at once as
// well.
#include <fmt/format.h>

#include <memory>

#include "bench/speed/easel.h"
#include "bench/speed/speed_row.h"
#include "gl/stopwatch.h"
#include "gl/words.h"

namespace gnomon {
namespace {

constexpr int kTimes = 8;  ///< so that finishing, and OSMesa's copy of the frame, weigh little on either side

/// The state of @p pass, set anew on the driver.
void setState(const GlTable& gl, const Pass& pass) {
    gl.ColorMask(pass.write.red, pass.write.green, pass.write.blue, pass.write.alpha);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(glEnum(pass.depthFunction));
    gl.DepthMask(GL_FALSE);
    gl.Color4f(pass.colour.r, pass.colour.g, pass.colour.b, pass.colour.a);
    if (pass.blend.enabled) {
        gl.Enable(GL_BLEND);
        gl.BlendFunc(glEnum(pass.blend.source), glEnum(pass.blend.destination));
    }
    const Stencil& s = pass.stencil;
    if (!s.enabled) return;
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFunc(glEnum(s.function), s.reference, s.readMask);
    gl.StencilOpSeparate(GL_FRONT, GL_KEEP, glEnum(s.front.onDepthFail), glEnum(s.front.onPass));
    gl.StencilOpSeparate(GL_BACK, GL_KEEP, glEnum(s.back.onDepthFail), glEnum(s.back.onPass));
}

void switchOff(const GlTable& gl) {
    for (const GLenum what : {GL_DEPTH_TEST, GL_BLEND, GL_STENCIL_TEST}) gl.Disable(what);
}

/// Boxes over a floor, a volume each: 8 by 8.
Scene manyBoxes() {
    Scene scene;
    scene.objects = {placed("floor", gnomon::rectangle({20, 20}), {0, 0, 0}, false)};
    for (int x = 0; x < 8; ++x)
        for (int z = 0; z < 8; ++z)
            scene.objects.push_back(placed("box", box({0.5, 0.4, 0.6}),
                                           {1.03f * float(x) - 3.6f, 0.81f, 1.07f * float(z) - 3.7f}));
    scene.lights = {{.position = {1.4f, 7.3f, 2.7f, 1}}};
    scene.frames = {{.eye = {3.9f, 6.1f, 8.7f}, .target = {0, 0.6f, 0}, .nearPlane = 0.5f}};
    return scene;
}

Round maskPass(const Scene& scene, const std::string& method, Load load) {
    const int side = load == Load::Full ? 1024 : 32;
    const auto easel = std::make_shared<Easel>(scene, side, side);
    const Plan plan = easel->plan(method);
    Plan before = plan, volumes = plan;
    before.passes.clear(), volumes.passes.clear();
    for (const Pass& pass : plan.passes)
        if (pass.kind == PassKind::Volume)
            volumes.passes.push_back(pass);
        else if (volumes.passes.empty())
            before.passes.push_back(pass);
    const std::vector<Pass> once = volumes.passes;
    for (int i = 1; i < kTimes; ++i) volumes.passes.insert(volumes.passes.end(), once.begin(), once.end());
    std::vector<glm::vec4> batch;
    for (int part = 0; part < kParts; ++part)
        if (once.front().parts.has(Part(part)))
            for (const glm::vec4& vertex : easel->frame().volumes().all(Part(part))) batch.push_back(vertex);

    const auto raw = [=] {
        easel->draw(before);
        const GlTable& gl = easel->surface().driver();
        const double start = threadCpuMs();
        setState(gl, once.front());
        gl.VertexPointer(4, GL_FLOAT, 0, batch.data());
        for (int i = 0; i < kTimes; ++i) gl.DrawArrays(GL_TRIANGLES, 0, GLsizei(batch.size()));
        gl.Finish();
        const double ms = threadCpuMs() - start;
        switchOff(gl);
        return ms / kTimes;
    };
    return [=] {
        Measured times{.beside = raw()};
        easel->draw(before);
        times.ours = easel->draw(volumes).cpuMs / kTimes;
        times.figure = times.ours / times.beside;
        return times;
    };
}

SpeedRow row(const std::string& store, const std::string& method, const std::string& scene, Scene (*make)()) {
    return {.name = "MaskPass/" + store + "/" + scene,
            .what = fmt::format("mask pass into {}, {}, over its raw fragments", store, scene),
            .target = 1.3,
            .unit = "x",
            .sides = "ms",
            .prepare = [=](Load load) { return maskPass(make(), method, load); }};
}

}  // namespace

std::vector<SpeedRow> maskPassRows() {
    const auto paper = [] { return shippedScene("roettger"); };
    return {row("stencil", "heidmann", "2 volumes", paper),
            row("alpha", "roettger-alpha", "2 volumes", paper),
            row("screen", "roettger-screen", "2 volumes", paper),
            row("stencil", "heidmann", "64 volumes", manyBoxes),
            row("alpha", "roettger-alpha", "64 volumes", manyBoxes),
            row("screen", "roettger-screen", "64 volumes", manyBoxes)};
}

}  // namespace gnomon
