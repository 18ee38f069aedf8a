#include "gl/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "gl/frame_calls.h"
#include "gl/mask_reader.h"
#include "gl/pass_runner.h"
#include "gl/stopwatch.h"

namespace gnomon {
namespace {

void flipRows(Image& image) {
    const std::size_t row = std::size_t(image.width) * image.channels;
    for (int y = 0; y < image.height / 2; ++y) {
        auto* a = image.data.data() + row * y;
        std::swap_ranges(a, a + row, image.data.data() + row * (image.height - 1 - y));
    }
}

Image readPixels(Surface& surface, GLenum format, int channels) {
    Image image{surface.width(), surface.height(), channels, {}};
    image.data.resize(std::size_t(image.width) * image.height * channels);
    surface.driver().ReadPixels(0, 0, image.width, image.height, format, GL_UNSIGNED_BYTE, image.data.data());
    flipRows(image);
    return image;
}

/// Counts the fragments that pass all tests.
class SampleCounter {
  public:
    explicit SampleCounter(const GlTable& table) : gl(table) { gl.GenQueries(1, &m_query); }
    ~SampleCounter() { gl.DeleteQueries(1, &m_query); }
    SampleCounter(const SampleCounter&) = delete;
    SampleCounter& operator=(const SampleCounter&) = delete;

    void begin() { gl.BeginQuery(GL_SAMPLES_PASSED, m_query); }
    std::int64_t end() {
        gl.EndQuery(GL_SAMPLES_PASSED);
        GLuint64 samples = 0;
        gl.GetQueryObjectui64v(m_query, GL_QUERY_RESULT, &samples);
        return std::int64_t(samples);
    }

  private:
    const GlTable& gl;
    GLuint m_query = 0;
};

/// The objects that a frame makes stay for the next, but not those of a frame that is cut off: they may lack
/// what was refused.
class FrameObjects {
  public:
    explicit FrameObjects(Surface& surface) : m_surface(surface) {}
    ~FrameObjects() {
        if (!m_finished) m_surface.objects().clear(m_surface.driver());
    }
    FrameObjects(const FrameObjects&) = delete;
    FrameObjects& operator=(const FrameObjects&) = delete;
    void finish() {
        m_surface.objects().endFrame(m_surface.driver());
        m_finished = true;
    }

  private:
    Surface& m_surface;
    bool m_finished = false;
};

}  // namespace

Image readColour(Surface& surface, bool alpha) {
    return readPixels(surface, alpha ? GL_RGBA : GL_RGB, alpha ? 4 : 3);
}

Image readStencil(Surface& surface) {
    return readPixels(surface, GL_STENCIL_INDEX, 1);
}

Rendered render(Surface& surface, const Profile& profile, const Plan& plan, const FrameSurfaces& surfaces,
                const LightFrames& lights, const RenderOptions& options) {
    surface.makeCurrent();
    const GlTable& driver = surface.driver();
    resetState(driver);
    while (driver.GetError() != GL_NO_ERROR) {
    }

    FrameObjects objects(surface);
    FrameCalls& calls = surface.frameCalls();
    const GlTable& gl = calls.begin(profile);
    const bool isSoftware = surface.isSoftware();
    PassRunner runner(
        gl, surface, profile, plan, surfaces, lights,
        options.vertices.value_or(isSoftware ? VertexSource::HostMemory : VertexSource::Buffers));
    // Samples are counted of whole passes. A GPU would wait for what is read back.
    if (isSoftware && calls.fidelity() == Fidelity::Gl && !options.countsSamples) runner.leaveOutLit();
    Rendered out;
    std::size_t lightCount = 1;
    for (const MaskTap& mask : plan.masks) lightCount = std::max(lightCount, std::size_t(mask.light) + 1);
    out.masks.resize(lightCount);
    out.values.resize(out.masks.size());
    auto tap = plan.masks.begin();
    Stopwatch watch(surface);
    std::optional<SampleCounter> samples;
    if (options.countsSamples) samples.emplace(driver);
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        // What the light adds is made before the clock starts.
        const Pass& pass = plan.passes[i];
        if (options.beforePass) options.beforePass(i);
        if (pass.kind == PassKind::Scene || pass.kind == PassKind::Volume) lights(pass.light);
        const bool taps = tap != plan.masks.end() && tap->after == i + 1;
        const bool waits = i + 1 == plan.passes.size() || taps || options.afterPass || options.timesPasses;
        if (samples) samples->begin();
        watch.start();
        runner.run(pass);
        if (waits) gl.Finish();
        const double ms = watch.stop();
        out.cpuMs += ms;
        if (options.timesPasses) out.passMs.push_back(ms);
        if (samples) out.passSamples.push_back(samples->end());
        if (const GLenum error = driver.GetError(); error != GL_NO_ERROR)
            throw std::runtime_error(
                fmt::format("OpenGL error 0x{:04x} in pass {}: {}", error, i + 1, plan.passes[i].label));
        if (options.afterPass) options.afterPass(i);
        if (taps) {
            MaskValues values = readMask(surface, plan, *tap, runner);
            std::vector<bool>& shadow = out.masks[std::size_t(tap->light)];
            const int reference = runner.reference(tap->test);
            shadow.resize(values.size());
            for (std::size_t p = 0; p < values.size(); ++p)
                shadow[p] = isShadow(plan, *tap, values[p], reference);
            out.values[std::size_t(tap->light)] = std::move(values);
            ++tap;
        }
    }
    objects.finish();
    out.image = readColour(surface);
    out.counts = calls.counts();
    if (plan.masks.empty()) {
        out.masks[0].resize(std::size_t(plan.width) * plan.height);
        out.values[0].resize(out.masks[0].size());
    }
    return out;
}

}  // namespace gnomon
