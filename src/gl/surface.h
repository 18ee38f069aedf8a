#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gl/buffer_format.h"
#include "gl/chip_arithmetic.h"
#include "gl/device.h"
#include "gl/kept_objects.h"
#include "gl/table.h"

namespace gnomon {

class FrameCalls;

/// An off-screen OpenGL context with its buffers, current on the thread that made it. Owns both; not
/// copyable.
class Surface {
  public:
    /// @param chip  whose arithmetic its draws have; buffers that OpenGL lacks are emulated at any fidelity
    /// @throws NoDriver            the system has no driver for @p device, or gnomon was built without it
    /// @throws std::runtime_error  the driver can't give exactly these buffers, or lacks what the chip's
    ///                             arithmetic takes
    Surface(const BufferFormat& format, int width, int height, const ChipArithmetic& chip = {},
            Device device = defaultDevice());
    ~Surface();
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    /// The driver's entry points, unrestricted; with the chip's arithmetic under them where that is emulated.
    const GlTable& driver() const;
    /// Puts @p decorator around these entry points, for all that is drawn and read from now on: so that tests
    /// can plant a fault in them.
    void decorate(const std::function<GlTable(GlTable)>& decorator);
    const BufferFormat& format() const;
    int width() const;
    int height() const;
    Device device() const;

    /// Renderer and version as the driver calls them. @pre it is current; the same for isSoftware()
    std::string driverName() const;
    /// Whether the processor draws, and not a GPU: by the renderer's name.
    bool isSoftware() const;

    /// The programs that were linked in this context, by a name that their users choose; they live as long as
    /// it does.
    std::map<std::string, unsigned>& programs();
    /// Its other objects that stay from frame to frame.
    KeptObjects& objects();
    /// What its frames are drawn through. Another after decorate().
    FrameCalls& frameCalls();

    /// Makes the context current; needed when several surfaces live.
    void makeCurrent();

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace gnomon
