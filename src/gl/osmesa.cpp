#include <GL/osmesa.h>
#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "gl/device_context.h"

namespace gnomon {
namespace {

struct PixelFormat {
    GLenum osmesa = 0, type = 0;
    int bytes = 0;
};

PixelFormat pixelFormat(const BufferFormat& f) {
    if (f.red == 5 && f.green == 6 && f.blue == 5 && f.alpha == 0)
        return {OSMESA_RGB_565, GL_UNSIGNED_SHORT_5_6_5, 2};
    if (f.red == 8 && f.green == 8 && f.blue == 8 && f.alpha == 8) return {OSMESA_RGBA, GL_UNSIGNED_BYTE, 4};
    throw std::runtime_error(
        fmt::format("OSMesa has no buffer of {}, {}, {} and {} bits", f.red, f.green, f.blue, f.alpha));
}

class OsmesaContext : public DeviceContext {
  public:
    OsmesaContext(const BufferFormat& format, int width, int height)
        : m_pixels(pixelFormat(format)), m_width(width), m_height(height) {
        const int attributes[] = {OSMESA_FORMAT,
                                  int(m_pixels.osmesa),
                                  OSMESA_DEPTH_BITS,
                                  format.depth,
                                  OSMESA_STENCIL_BITS,
                                  format.stencil,
                                  OSMESA_ACCUM_BITS,
                                  0,
                                  OSMESA_PROFILE,
                                  OSMESA_COMPAT_PROFILE,
                                  0};
        m_context = OSMesaCreateContextAttribs(attributes, nullptr);
        if (!m_context) throw std::runtime_error("OSMesa gives no context");
        m_buffer.resize((std::size_t(width) * height * m_pixels.bytes + 3) / 4);
    }
    ~OsmesaContext() override { OSMesaDestroyContext(m_context); }

    void makeCurrent() override {
        if (!OSMesaMakeCurrent(m_context, m_buffer.data(), m_pixels.type, m_width, m_height))
            throw std::runtime_error(
                fmt::format("OSMesa can't draw {}x{} in this format", m_width, m_height));
    }
    void release() override { OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0); }
    Entry address(const char* name) const override { return OSMesaGetProcAddress(name); }
    bool hasFramebuffer() const override { return true; }

  private:
    const PixelFormat m_pixels;
    const int m_width, m_height;
    OSMesaContext m_context = nullptr;
    std::vector<std::uint32_t> m_buffer{};
};

}  // namespace

std::unique_ptr<DeviceContext> osmesaContext(const BufferFormat& format, int width, int height) {
    return std::make_unique<OsmesaContext>(format, width, height);
}

}  // namespace gnomon
