#include "volume/kernels.h"

#if defined(__x86_64__)
#include <immintrin.h>

#include <bit>

#define GNOMON_AVX512 __attribute__((target("avx512f,bmi2,popcnt")))

namespace gnomon {
namespace {

GNOMON_AVX512 void face(const PlaneView& planes, const glm::vec4& light, float bound, std::size_t words,
                        std::uint64_t* lit, std::uint64_t* away) {
    const __m512 x = _mm512_set1_ps(light.x), y = _mm512_set1_ps(light.y), z = _mm512_set1_ps(light.z),
                 w = _mm512_set1_ps(light.w);
    const __m512 above = _mm512_set1_ps(bound), below = _mm512_set1_ps(-bound);
    for (std::size_t word = 0; word < words; ++word) {
        std::uint64_t litWord = 0, awayWord = 0;
        for (int part = 0; part < 64; part += 16) {
            const std::size_t t = 64 * word + part;
            __m512 height = _mm512_mul_ps(_mm512_loadu_ps(planes.d + t), w);
            height = _mm512_fmadd_ps(_mm512_loadu_ps(planes.x + t), x, height);
            height = _mm512_fmadd_ps(_mm512_loadu_ps(planes.y + t), y, height);
            height = _mm512_fmadd_ps(_mm512_loadu_ps(planes.z + t), z, height);
            litWord |= std::uint64_t(_mm512_cmp_ps_mask(height, above, _CMP_GT_OQ)) << part;
            awayWord |= std::uint64_t(_mm512_cmp_ps_mask(height, below, _CMP_LT_OQ)) << part;
        }
        lit[word] = litWord;
        away[word] = awayWord;
    }
}

/// 16 triangles have 48 walks: three vectors. Where no triangle is a cap nothing is read.
GNOMON_AVX512 std::size_t outline(const std::uint32_t* across, const std::uint64_t* caps, std::size_t first,
                                  std::size_t last, std::uint32_t* walks) {
    constexpr std::uint64_t kEveryThird = 0x249249249249;
    const __m512i one = _mm512_set1_epi32(1);
    const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    std::uint32_t* out = walks;
    for (std::size_t word = first; word < last; ++word) {
        for (int part = 0; part < 64; part += 16) {
            const std::uint64_t triangles = caps[word] >> part & 0xffff;
            if (triangles == 0) continue;
            const std::uint64_t walking = _pdep_u64(triangles, kEveryThird) * 7;
            for (int v = 0; v < 48; v += 16) {
                const auto mask = static_cast<__mmask16>(walking >> v);
                const std::size_t walk = 3 * (64 * word + part) + v;
                const __m512i other = _mm512_loadu_si512(across + walk);
                const __m512i bits = _mm512_mask_i32gather_epi32(
                    _mm512_setzero_si512(), mask, _mm512_maskz_srli_epi32(mask, other, 5), caps, 4);
                const __mmask16 ends =
                    _mm512_mask_testn_epi32_mask(mask, bits, _mm512_maskz_rolv_epi32(mask, one, other));
                if (ends == 0) continue;
                const __m512i numbers = _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(walk)), lanes);
                _mm512_mask_compressstoreu_epi32(out, ends, numbers);
                out += std::popcount(unsigned(ends));
            }
        }
    }
    return static_cast<std::size_t>(out - walks);
}

GNOMON_AVX512 std::size_t list(const std::uint64_t* set, std::size_t first, std::size_t last,
                               std::uint32_t* triangles) {
    const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    std::uint32_t* out = triangles;
    for (std::size_t word = first; word < last; ++word) {
        for (int part = 0; part < 64; part += 16) {
            const auto mask = static_cast<__mmask16>(set[word] >> part);
            const __m512i numbers =
                _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(64 * word + part)), lanes);
            // Never beyond the room for these words: what is written is at most 16 after as many as came
            // before.
            _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(mask, numbers));
            out += std::popcount(unsigned(mask));
        }
    }
    return static_cast<std::size_t>(out - triangles);
}

}  // namespace

Kernels avx512Kernels() {
    return {"avx512", face, outline, list};
}

}  // namespace gnomon

#else

namespace gnomon {
Kernels avx512Kernels() {
    return {};
}
}  // namespace gnomon

#endif
