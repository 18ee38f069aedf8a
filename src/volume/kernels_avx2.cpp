#include "volume/kernels.h"

#if defined(__x86_64__)
#include <immintrin.h>

#include <bit>

#define GNOMON_AVX2 __attribute__((target("avx2,fma,popcnt")))

namespace gnomon {
namespace {

GNOMON_AVX2 void face(const PlaneView& planes, const glm::vec4& light, float bound, std::size_t words,
                      std::uint64_t* lit, std::uint64_t* away) {
    const __m256 x = _mm256_set1_ps(light.x), y = _mm256_set1_ps(light.y), z = _mm256_set1_ps(light.z),
                 w = _mm256_set1_ps(light.w);
    const __m256 above = _mm256_set1_ps(bound), below = _mm256_set1_ps(-bound);
    for (std::size_t word = 0; word < words; ++word) {
        std::uint64_t litWord = 0, awayWord = 0;
        for (int part = 0; part < 64; part += 8) {
            const std::size_t t = 64 * word + part;
            __m256 height = _mm256_mul_ps(_mm256_loadu_ps(planes.d + t), w);
            height = _mm256_fmadd_ps(_mm256_loadu_ps(planes.x + t), x, height);
            height = _mm256_fmadd_ps(_mm256_loadu_ps(planes.y + t), y, height);
            height = _mm256_fmadd_ps(_mm256_loadu_ps(planes.z + t), z, height);
            const int aboveMask = _mm256_movemask_ps(_mm256_cmp_ps(height, above, _CMP_GT_OQ));
            const int belowMask = _mm256_movemask_ps(_mm256_cmp_ps(height, below, _CMP_LT_OQ));
            litWord |= std::uint64_t(unsigned(aboveMask)) << part;
            awayWord |= std::uint64_t(unsigned(belowMask)) << part;
        }
        lit[word] = litWord;
        away[word] = awayWord;
    }
}

/// Each of the low 8 bits three times.
std::uint32_t tripled(std::uint32_t bits) {
    bits = (bits | bits << 8) & 0x00f00f;
    bits = (bits | bits << 4) & 0x0c30c3;
    bits = (bits | bits << 2) & 0x249249;
    return bits * 7;
}

/// 8 triangles have 24 walks: three vectors. Where no triangle is a cap nothing is read.
GNOMON_AVX2 std::size_t outline(const std::uint32_t* across, const std::uint64_t* caps, std::size_t first,
                                std::size_t last, std::uint32_t* walks) {
    const int* words = reinterpret_cast<const int*>(caps);
    const __m256i thirtyOne = _mm256_set1_epi32(31);
    std::uint32_t* out = walks;
    for (std::size_t word = first; word < last; ++word) {
        for (int part = 0; part < 64; part += 8) {
            const auto triangles = static_cast<std::uint32_t>(caps[word] >> part & 0xff);
            if (triangles == 0) continue;
            const std::uint32_t walking = tripled(triangles);
            for (int v = 0; v < 24; v += 8) {
                const std::size_t walk = 3 * (64 * word + part) + v;
                const __m256i other = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(across + walk));
                const __m256i bits = _mm256_i32gather_epi32(words, _mm256_srli_epi32(other, 5), 4);
                // The bit asked for becomes the sign: shifted left by 31 minus its place.
                const __m256i signs = _mm256_sllv_epi32(bits, _mm256_andnot_si256(other, thirtyOne));
                const auto capsAcross = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(signs)));
                for (std::uint32_t ends = walking >> v & 0xff & ~capsAcross; ends != 0; ends &= ends - 1)
                    *out++ = static_cast<std::uint32_t>(walk + std::countr_zero(ends));
            }
        }
    }
    return static_cast<std::size_t>(out - walks);
}

}  // namespace

Kernels avx2Kernels() {
    return {"avx2", face, outline, portableKernels().list};
}

}  // namespace gnomon

#else

namespace gnomon {
Kernels avx2Kernels() {
    return {};
}
}  // namespace gnomon

#endif
