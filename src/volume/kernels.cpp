#include "volume/kernels.h"

#include <bit>
#include <vector>

namespace gnomon {
namespace {

void face(const PlaneView& planes, const glm::vec4& light, float bound, std::size_t words, std::uint64_t* lit,
          std::uint64_t* away) {
    for (std::size_t word = 0; word < words; ++word) {
        std::uint64_t above = 0, below = 0;
        for (std::size_t i = 0; i < 64; ++i) {
            const std::size_t t = 64 * word + i;
            const float height =
                planes.d[t] * light.w + planes.x[t] * light.x + planes.y[t] * light.y + planes.z[t] * light.z;
            above |= std::uint64_t(height > bound) << i;
            below |= std::uint64_t(height < -bound) << i;
        }
        lit[word] = above;
        away[word] = below;
    }
}

std::size_t outline(const std::uint32_t* across, const std::uint64_t* caps, std::size_t first,
                    std::size_t last, std::uint32_t* walks) {
    std::size_t count = 0;
    for (std::size_t word = first; word < last; ++word) {
        for (std::uint64_t rest = caps[word]; rest != 0; rest &= rest - 1) {
            const std::size_t triangle = 64 * word + std::countr_zero(rest);
            for (std::size_t walk = 3 * triangle; walk < 3 * triangle + 3; ++walk) {
                const std::uint32_t other = across[walk];
                walks[count] = static_cast<std::uint32_t>(walk);
                count += ~(caps[other / 64] >> (other % 64)) & 1;
            }
        }
    }
    return count;
}

std::size_t list(const std::uint64_t* set, std::size_t first, std::size_t last, std::uint32_t* triangles) {
    std::size_t count = 0;
    for (std::size_t word = first; word < last; ++word) {
        for (std::uint64_t rest = set[word]; rest != 0; rest &= rest - 1)
            triangles[count++] = static_cast<std::uint32_t>(64 * word + std::countr_zero(rest));
    }
    return count;
}

std::vector<Kernels> supported() {
    std::vector<Kernels> found;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("bmi2")) found.push_back(avx512Kernels());
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) found.push_back(avx2Kernels());
#endif
    found.push_back(portableKernels());
    return found;
}

}  // namespace

Kernels portableKernels() {
    return {"portable", face, outline, list};
}

std::span<const Kernels> kernels() {
    static const std::vector<Kernels> kKernels = supported();
    return kKernels;
}

}  // namespace gnomon
