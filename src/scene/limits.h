#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace gnomon {

/// What a scene or a mesh file may ask for. Beyond it a file is refused by a line that names the limit,
/// before the memory is taken or the time is spent.
struct SceneLimits {
    std::uint64_t meshBytes = 2'147'483'648;  ///< of a mesh file, and of all buffers that it names
    std::uint64_t tomlBytes = 16'777'216;     ///< of a scene file: its parser takes some fifty times as much
    std::uint64_t triangles = 33'554'432;     ///< with those that are dropped for want of an area
    std::uint64_t objects = 1'000'000;
    std::uint64_t polygonSteps =
        500'000'000;                        ///< to cut polygons into triangles (triangulate()): some seconds
    std::uint64_t jsonValues = 16'777'216;  ///< of a glTF file, its keys among them
};

/// "more than the 1000000 objects that gnomon takes".
/// @param what  empty where it has been named before
inline std::string moreThan(std::uint64_t most, std::string_view what = {}) {
    return fmt::format("more than the {}{}{} that gnomon takes", most, what.empty() ? "" : " ", what);
}

}  // namespace gnomon
