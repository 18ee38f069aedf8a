#pragma once

#include <string>

#include "gl/device.h"
#include "gl/stopwatch.h"

namespace gnomon {

/// What draws on a device here.
struct DriverFacts {
    Device device{};
    std::string driver{};   ///< Surface::driverName()
    DrawClock clock{};      ///< clockOf() its surfaces
    std::string problem{};  ///< one line if nothing can be drawn; the others are empty then
};

/// Draws nothing, but makes a surface of @p device. In a process of its own: a driver may crash, and one of a
/// GPU does not outlive a fork, by which the matrix makes its workers.
DriverFacts probe(Device device);

}  // namespace gnomon
