#pragma once

#include <cstdint>

namespace gnomon {

/// What gives OpenGL contexts without a window.
enum class Device : std::uint8_t {
    Osmesa,  ///< Mesa's off-screen library: a software rasteriser, always
    Egl,     ///< EGL without surfaces: a GPU where the system has one, else Mesa's software rasteriser
};
constexpr int kDevices = 2;

/// "osmesa", "egl".
const char* name(Device);
/// As it is called in text: "OSMesa", "EGL".
const char* title(Device);

/// Whether this gnomon was built with it.
bool isBuilt(Device);

/// OSMesa where it was built in, else EGL.
Device defaultDevice();

}  // namespace gnomon
