#include "gl/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "gl/device_context.h"
#include "gl/emulation.h"
#include "gl/frame_calls.h"
#include "gl/load_table.h"
#include "gl/window_object.h"

namespace gnomon {
namespace {

/// What is current on a thread. The libraries of the devices don't know of each other, but Mesa's share the
/// thread's dispatch table: one gives it up before the other takes it. (Mesa 22.3 was seen to bear it
/// otherwise.)
struct Current {
    DeviceContext* context = nullptr;
    Device device{};
};
thread_local Current t_current;

/// Leaves the thread without a context of another device than @p device.
void leaveTo(Device device) {
    if (!t_current.context || t_current.device == device) return;
    t_current.context->release();
    t_current = {};
}

/// Throws unless the buffers are what was asked for and nothing else.
void checkBits(const GlTable& gl, const BufferFormat& wanted) {
    const auto bits = [&](GLenum of) {
        GLint count = 0;
        gl.GetIntegerv(of, &count);
        return int(count);
    };
    const BufferFormat given{.red = bits(GL_RED_BITS),
                             .green = bits(GL_GREEN_BITS),
                             .blue = bits(GL_BLUE_BITS),
                             .alpha = bits(GL_ALPHA_BITS),
                             .depth = bits(GL_DEPTH_BITS),
                             .stencil = bits(GL_STENCIL_BITS)};
    const auto words = [](const BufferFormat& f) {
        return fmt::format("{}, {}, {}, {} bits of colour, {} of depth, {} of stencil", f.red, f.green,
                           f.blue, f.alpha, f.depth, f.stencil);
    };
    if (given != wanted)
        throw std::runtime_error(fmt::format("the driver gives {} for {}", words(given), words(wanted)));
}

std::string text(const GlTable& gl, GLenum what) {
    const GLubyte* given = gl.GetString(what);
    return given ? reinterpret_cast<const char*>(given) : "";
}

}  // namespace

struct Surface::Impl {
    BufferFormat format{};
    int width = 0, height = 0;
    Device device{};
    Fidelity fidelity = Fidelity::Gl;
    std::unique_ptr<DeviceContext> context{};
    GlTable driver{};
    std::map<std::string, unsigned> programs{};
    KeptObjects objects{};
    std::optional<FrameCalls> frameCalls{};  ///< none before the first frame

    void makeCurrent() {
        leaveTo(device);
        context->makeCurrent();
        t_current = {context.get(), device};
    }

    ~Impl() {
        if (!context) return;
        Current other = t_current;
        if (other.context == context.get()) {
            context->release();
            other = t_current = {};
        }
        leaveTo(device);
        context.reset();
        if (other.context && other.device != device) other.context->makeCurrent(), t_current = other;
    }
};

Surface::Surface(const BufferFormat& format, int width, int height, const ChipArithmetic& chip, Device device)
    : m_impl(std::make_unique<Impl>()) {
    // One thread per process: the matrix runs processes side by side, and thread CPU time then times a frame.
    // Whoever asks for threads gets them, and times that mean nothing. Only software rasterisers ask for
    // these.
    setenv("LP_NUM_THREADS", "0", 0);
    setenv("GALLIUM_DRIVER", "llvmpipe", 0);
    Impl& m = *m_impl;
    m.format = format;
    m.width = width;
    m.height = height;
    m.device = device;
    m.fidelity = chip.fidelity;
    // An emulated frame lives in buffers of its own; the context's are not drawn to.
    const bool emulated = needsEmulation(format, chip);
    const BufferFormat own = emulated ? BufferFormat{.depth = 0, .stencil = 0} : format;
    leaveTo(device);
    m.context = newContext(device, own, width, height);
    m.makeCurrent();
    m.driver = loadTable(*m.context);
    const bool makesWindow = !m.context->hasFramebuffer() && !emulated;
    if (makesWindow) m.driver = withWindowObject(format, width, height, std::move(m.driver));
    if (makesWindow || m.context->hasFramebuffer()) checkBits(m.driver, own);
    m.driver.PixelStorei(GL_PACK_ALIGNMENT, 1);
    m.driver.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    // Dithering is on by default in OpenGL; llvmpipe has none, and a mask must not depend on it.
    m.driver.Disable(GL_DITHER);
    if (emulated) m.driver = emulate(format, chip, width, height, std::move(m.driver));
}

Surface::~Surface() = default;

const GlTable& Surface::driver() const {
    return m_impl->driver;
}
void Surface::decorate(const std::function<GlTable(GlTable)>& decorator) {
    m_impl->driver = decorator(std::move(m_impl->driver));
    m_impl->frameCalls.reset();
}
const BufferFormat& Surface::format() const {
    return m_impl->format;
}
int Surface::width() const {
    return m_impl->width;
}
int Surface::height() const {
    return m_impl->height;
}
Device Surface::device() const {
    return m_impl->device;
}

std::string Surface::driverName() const {
    return fmt::format("{}, OpenGL {}", text(m_impl->driver, GL_RENDERER), text(m_impl->driver, GL_VERSION));
}

bool Surface::isSoftware() const {
    // As Mesa's rasterisers call themselves.
    constexpr std::array kNames{"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"};
    const std::string renderer = text(m_impl->driver, GL_RENDERER);
    return std::any_of(kNames.begin(), kNames.end(),
                       [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

std::map<std::string, unsigned>& Surface::programs() {
    return m_impl->programs;
}
KeptObjects& Surface::objects() {
    return m_impl->objects;
}
FrameCalls& Surface::frameCalls() {
    if (!m_impl->frameCalls) m_impl->frameCalls.emplace(m_impl->format, m_impl->driver, m_impl->fidelity);
    return *m_impl->frameCalls;
}

void Surface::makeCurrent() {
    m_impl->makeCurrent();
}

}  // namespace gnomon
