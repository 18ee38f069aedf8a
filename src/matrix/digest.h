#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "gl/renderer.h"

namespace gnomon {

/// A running digest: FNV-1a of 64 bits. It tells changes, and defends against nobody.
class Digest {
  public:
    void add(std::uint8_t byte) { m_hash = (m_hash ^ byte) * 1099511628211ull; }
    void add(std::uint64_t value);
    void add(std::int64_t value) { add(std::uint64_t(value)); }
    /// The bits of each; not a number is like itself.
    void add(std::span<const float> values);
    void add(float value) { add(std::span(&value, 1)); }
    /// With its length, so that neighbours don't run into one another.
    void add(std::string_view text);

    std::uint64_t value() const { return m_hash; }
    std::string text() const;  ///< 16 hexadecimal digits

  private:
    std::uint64_t m_hash = 14695981039346656037ull;
};

/// Over the masks and the image of a frame, as Digest::text().
std::string digestOf(const Rendered& rendered);

}  // namespace gnomon
