#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "gl/surface.h"

namespace gnomon {

/// What these tests draw on: the device named by GNOMON_TEST_DEVICE, else the default. The build runs them
/// once for each (tests/CMakeLists.txt).
inline Device testDevice() {
    const char* word = std::getenv("GNOMON_TEST_DEVICE");
    if (!word) return defaultDevice();
    for (int i = 0; i < kDevices; ++i)
        if (std::string(word) == name(Device(i))) return Device(i);
    throw std::invalid_argument("GNOMON_TEST_DEVICE");
}

/// A surface there.
class TestSurface : public Surface {
  public:
    TestSurface(const BufferFormat& format, int width, int height, const ChipArithmetic& chip = {})
        : Surface(format, width, height, chip, testDevice()) {}
};

}  // namespace gnomon
