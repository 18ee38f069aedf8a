#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

namespace gnomon {

/// The planes of triangles in structure-of-arrays form, padded to whole words of 64.
struct PlaneView {
    const float *x = nullptr, *y = nullptr, *z = nullptr, *d = nullptr;
};

/// The inner loops over all triangles of a mesh, once per instruction set; results don't differ by a bit.
/// Sets of triangles are bits: triangle t is bit t % 64 of word t / 64.
struct Kernels {
    std::string_view name{};

    /// Words [0, words) of the triangles whose height x lx + y ly + z lz + d lw is above @p bound (lit) or
    /// below -bound (away); neither where it is between or not a number. Any order of the additions and any
    /// fusing: the bound allows for both.
    void (*face)(const PlaneView& planes, const glm::vec4& light, float bound, std::size_t words,
                 std::uint64_t* lit, std::uint64_t* away) = nullptr;

    /// The walks of caps in words [first, last) across which there is no cap, in their order.
    /// @param across  Adjacency::across
    /// @param walks   has room for 192 walks for each word
    /// @return        number of walks
    std::size_t (*outline)(const std::uint32_t* across, const std::uint64_t* caps, std::size_t first,
                           std::size_t last, std::uint32_t* walks) = nullptr;

    /// The numbers of the triangles in words [first, last) of @p set, lowest first.
    /// @param triangles  has room for 64 for each word
    /// @return           how many
    std::size_t (*list)(const std::uint64_t* set, std::size_t first, std::size_t last,
                        std::uint32_t* triangles) = nullptr;
};

/// Those that this processor runs, fastest first; the last needs nothing of it.
std::span<const Kernels> kernels();

/// One for each instruction set; no functions where the program is built for another processor.
Kernels portableKernels();
Kernels avx2Kernels();
Kernels avx512Kernels();

}  // namespace gnomon
