#include "matrix/boundary.h"

#include <algorithm>

namespace gnomon {
namespace {

using Words = std::vector<std::uint64_t>;

/// A set of pixels, 64 to a word, each row from a word of its own.
struct Pixels {
    int width = 0, height = 0;
    std::size_t words = 0;  ///< per row
    Words bits{};

    std::uint64_t used(std::size_t word) const {
        return word + 1 == words && width % 64 ? (std::uint64_t(1) << (width % 64)) - 1 : ~std::uint64_t(0);
    }

    /// Adds what is within @p reach along the row.
    void growAlongRows(int reach) {
        Words row(words);
        for (int y = 0; y < height; ++y) {
            std::uint64_t* const out = &bits[std::size_t(y) * words];
            for (int left = reach; left > 0; left -= std::min(left, 63)) {
                std::copy(out, out + words, row.begin());
                for (std::size_t w = 0; w < words; ++w) {
                    const std::uint64_t before = w > 0 ? row[w - 1] : 0;
                    const std::uint64_t after = w + 1 < words ? row[w + 1] : 0;
                    for (int s = 1; s <= std::min(left, 63); ++s) {
                        out[w] |= row[w] << s | before >> (64 - s);
                        out[w] |= row[w] >> s | after << (64 - s);
                    }
                    out[w] &= used(w);
                }
            }
        }
    }

    /// Adds what is within @p reach along the column.
    void growAlongColumns(int reach) {
        const Words before = bits;
        for (int y = 0; y < height; ++y) {
            std::uint64_t* const out = &bits[std::size_t(y) * words];
            for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach); ++v)
                for (std::size_t w = 0; w < words; ++w) out[w] |= before[std::size_t(v) * words + w];
        }
    }
};

}  // namespace

Boundary::Boundary(const Truth& truth, int reach) : m_words((std::size_t(truth.width) + 63) / 64) {
    Pixels shadow{truth.width, truth.height, m_words, Words(m_words * std::size_t(truth.height))};
    Pixels other = shadow;
    for (int y = 0; y < truth.height; ++y) {
        const Shadow* const row = &truth.shadow[std::size_t(y) * truth.width];
        for (std::size_t w = 0; w < m_words; ++w) {
            std::uint64_t bits = 0;
            for (int k = 0; k < std::min(64, truth.width - int(64 * w)); ++k)
                bits |= std::uint64_t(row[64 * w + k] == Shadow::InShadow) << k;
            shadow.bits[std::size_t(y) * m_words + w] = bits;
            other.bits[std::size_t(y) * m_words + w] = ~bits & other.used(w);
        }
    }
    for (Pixels* const side : {&shadow, &other}) {
        side->growAlongRows(reach);
        side->growAlongColumns(reach);
    }
    m_bits = std::move(shadow.bits);
    for (std::size_t i = 0; i < m_bits.size(); ++i) m_bits[i] &= other.bits[i];
}

}  // namespace gnomon
