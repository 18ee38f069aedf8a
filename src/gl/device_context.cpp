#include "gl/device_context.h"

#include <fmt/format.h>

namespace gnomon {

std::unique_ptr<DeviceContext> newContext(Device device, const BufferFormat& format, int width, int height) {
    // A device that isn't built in has no function to call.
    if constexpr (GNOMON_OSMESA)
        if (device == Device::Osmesa) return osmesaContext(format, width, height);
    if constexpr (GNOMON_EGL)
        if (device == Device::Egl) return eglContext();
    throw NoDriver(fmt::format("this gnomon was built without {}", title(device)));
}

}  // namespace gnomon
