#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <string_view>
#include <vector>

#include "gl/device_context.h"
#include "gl/extensions.h"

namespace gnomon {
namespace {

bool lists(const char* extensions, std::string_view name) {
    return extensions && listsName(extensions, name);
}

/// What EGL can draw on without a window system: GPUs, then Mesa's choice, which is its software rasteriser
/// where there is no GPU.
std::vector<EGLDisplay> displays() {
    std::vector<EGLDisplay> all;
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto queryDevices =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto queryDevice =
        reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
    const bool hasDevices = lists(client, "EGL_EXT_platform_device") && queryDevices && queryDevice;
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (hasDevices && queryDevices(EGLint(devices.size()), devices.data(), &count)) {
        for (EGLint i = 0; i < count; ++i) {
            EGLDeviceEXT device = devices[std::size_t(i)];
            if (!lists(queryDevice(device, EGL_EXTENSIONS), "EGL_MESA_device_software"))
                all.push_back(eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
        }
    }
    if (lists(client, "EGL_MESA_platform_surfaceless"))
        all.push_back(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    std::erase(all, EGL_NO_DISPLAY);
    return all;
}

/// A context for no surface in particular, or EGL_NO_CONTEXT.
/// @pre the display is initialised
EGLContext contextOn(EGLDisplay display) {
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    if (!lists(extensions, "EGL_KHR_surfaceless_context") || !eglBindAPI(EGL_OPENGL_API))
        return EGL_NO_CONTEXT;
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (!lists(extensions, "EGL_KHR_no_config_context")) {
        const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
        EGLint count = 0;
        if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) return EGL_NO_CONTEXT;
    }
    // The oldest version that has profiles; drivers give the newest that they have.
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 2,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                                 EGL_NONE};
    return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
}

/// Its display is the process's, and stays initialised.
class EglContext : public DeviceContext {
  public:
    EglContext() {
        bool isAny = false;
        for (EGLDisplay display : displays()) {
            if (!eglInitialize(display, nullptr, nullptr)) continue;
            isAny = true;
            m_display = display;
            m_context = contextOn(display);
            if (m_context != EGL_NO_CONTEXT) return;
        }
        if (!isAny) throw NoDriver("EGL has no driver that draws without a window");
        throw std::runtime_error("EGL gives no OpenGL compatibility context without a surface");
    }
    ~EglContext() override {
        if (eglGetCurrentContext() == m_context) release();
        eglDestroyContext(m_display, m_context);
    }

    void makeCurrent() override {
        if (!eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, m_context))
            throw std::runtime_error("EGL can't make its context current");
    }
    void release() override { eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
    Entry address(const char* name) const override { return eglGetProcAddress(name); }
    bool hasFramebuffer() const override { return false; }

  private:
    EGLDisplay m_display = EGL_NO_DISPLAY;
    EGLContext m_context = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<DeviceContext> eglContext() {
    return std::make_unique<EglContext>();
}

}  // namespace gnomon
