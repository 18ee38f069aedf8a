#include "matrix/digest.h"

#include <fmt/format.h>

#include <bit>

namespace gnomon {

void Digest::add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) add(std::uint8_t(value >> (8 * byte)));
}

void Digest::add(std::span<const float> values) {
    for (const float value : values) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        for (int byte = 0; byte < 4; ++byte) add(std::uint8_t(bits >> (8 * byte)));
    }
}

void Digest::add(std::string_view text) {
    add(std::uint64_t(text.size()));
    for (const char c : text) add(std::uint8_t(c));
}

std::string Digest::text() const {
    return fmt::format("{:016x}", m_hash);
}

std::string digestOf(const Rendered& rendered) {
    Digest digest;
    for (const std::vector<bool>& mask : rendered.masks)
        for (const bool shadow : mask) digest.add(std::uint8_t(shadow));
    for (const std::uint8_t byte : rendered.image.data) digest.add(byte);
    return digest.text();
}

}  // namespace gnomon
