#include "matrix/digest.h"

#include <fmt/format.h>

namespace gnomon {
namespace {

class Digest {
  public:
    void add(std::uint8_t byte) { m_hash = (m_hash ^ byte) * 1099511628211ull; }
    std::string text() const { return fmt::format("{:016x}", m_hash); }

  private:
    std::uint64_t m_hash = 14695981039346656037ull;
};

}  // namespace

std::string digestOf(const Rendered& rendered) {
    Digest digest;
    for (const std::vector<bool>& mask : rendered.masks)
        for (const bool shadow : mask) digest.add(shadow);
    for (const std::uint8_t byte : rendered.image.data) digest.add(byte);
    return digest.text();
}

}  // namespace gnomon
