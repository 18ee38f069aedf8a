#pragma once

#include <memory>
#include <stdexcept>

#include "gl/buffer_format.h"
#include "gl/device.h"

namespace gnomon {

/// The system has no driver for a device.
struct NoDriver : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An OpenGL compatibility context of one device. Of several devices' contexts only one may be current on a
/// thread, and neither library knows of the other: see Surface::makeCurrent().
class DeviceContext {
  public:
    using Entry = void (*)();

    DeviceContext() = default;
    virtual ~DeviceContext() = default;
    DeviceContext(const DeviceContext&) = delete;
    DeviceContext& operator=(const DeviceContext&) = delete;

    /// @throws std::runtime_error  the device refuses
    virtual void makeCurrent() = 0;
    /// Leaves the thread without a context. @pre this one is current
    virtual void release() = 0;
    /// The entry point @p name; null if the driver has none.
    virtual Entry address(const char* name) const = 0;
    /// Whether it has a frame buffer 0.
    virtual bool hasFramebuffer() const = 0;
};

/// A new context, not yet current.
///
/// @param format  of frame buffer 0, where the device has one
/// @pre  no context of another device is current
/// @throws NoDriver            the system has none, or this gnomon was built without the device
/// @throws std::runtime_error  the driver gives no such context
std::unique_ptr<DeviceContext> newContext(Device device, const BufferFormat& format, int width, int height);

/// The same of one device, where it was built in.
std::unique_ptr<DeviceContext> osmesaContext(const BufferFormat& format, int width, int height);
std::unique_ptr<DeviceContext> eglContext();

}  // namespace gnomon
