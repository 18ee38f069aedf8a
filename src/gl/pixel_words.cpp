#include "gl/pixel_words.h"

#include <algorithm>

#include "profile/blend.h"
#include "profile/pixel.h"

namespace gnomon {
namespace {

template <class Widen>
std::vector<std::uint8_t> expanded(std::span<const std::uint32_t> words, const BufferFormat& format,
                                   const ChipArithmetic& chip, Widen widen) {
    const bool gs = isGs(chip.unit);
    std::vector<std::uint8_t> bytes(4 * words.size());
    for (int c = 0; c < 4; ++c) {
        const int bits = channelBits(format, c), shift = channelShift(format, c);
        for (std::size_t i = 0; i < words.size(); ++i) {
            int value = 255;
            if (bits > 0) {
                const int code = int(words[i] >> shift & ((1u << bits) - 1));
                value = c == 3 && gs ? std::min(shifted(code, bits) * 255 / 128, 255) : widen(code, bits);
            }
            bytes[4 * i + std::size_t(c)] = std::uint8_t(value);
        }
    }
    return bytes;
}

}  // namespace

std::vector<std::uint8_t> bytesOf(std::span<const std::uint32_t> words, const BufferFormat& format,
                                  const ChipArithmetic& chip) {
    return expanded(words, format, chip, [](int code, int bits) { return replicated(code, bits); });
}

std::vector<std::uint8_t> texelsOf(std::span<const std::uint32_t> words, const BufferFormat& format,
                                   const ChipArithmetic& chip) {
    const bool shifts = isGs(chip.unit) || chip.unit == BlendUnit::Rdp;
    return expanded(words, format, chip, [&](int code, int bits) {
        return shifts ? shifted(code, bits) : replicated(code, bits);
    });
}

}  // namespace gnomon
