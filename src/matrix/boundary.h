#pragma once

#include <cstdint>
#include <vector>

#include "truth/truth.h"

namespace gnomon {

/// The pixels near the true boundary between shadow and no shadow: those with both within a few pixels,
/// diagonally too. Found for 64 pixels at a time.
class Boundary {
  public:
    /// @param reach  pixels along each axis
    Boundary(const Truth& truth, int reach);

    bool isNear(int x, int y) const {
        return m_bits[std::size_t(y) * m_words + std::size_t(x) / 64] >> (x % 64) & 1;
    }

  private:
    std::size_t m_words = 0;  ///< per row
    std::vector<std::uint64_t> m_bits{};
};

}  // namespace gnomon
