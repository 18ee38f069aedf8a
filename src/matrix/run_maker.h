#pragma once

#include <cstdint>
#include <string>

#include "gl/device.h"

namespace gnomon {

/// What draws the cells of a run, and where.
struct RunMaker {
    std::string version{};   ///< of gnomon
    std::string compiler{};  ///< of gnomon: "g++ 12.2.0"
    /// Surface::driverName(), without the width of the processor's vectors, on which no result depends.
    std::string driver{};
    std::string processor{};    ///< as the system calls it
    std::uint64_t program = 0;  ///< digest of this program's file
};

/// @throws std::runtime_error  nothing draws on @p device
RunMaker runMaker(const std::string& version, Device device);

}  // namespace gnomon
