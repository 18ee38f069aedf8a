#pragma once

#include <cstdint>
#include <optional>

#include "cost/touched.h"
#include "profile/profile.h"

namespace gnomon {

/// What one pass moves and draws on a chip, counted.
///
/// A fragment reads the depth word where the depth or the stencil test looks at it; one that passes its tests
/// writes the words that the pass changes, and reads the colour word first where blending, a logic operation
/// or a channel mask that splits a byte needs it. A stencil lies in the depth word. A clear writes each word
/// once. A copy by the chip reads the frame and writes the texture; by the host it is read back and sent
/// again; a chip that samples its frame where it lies copies nothing.
///
/// Not here: textures that are sampled, scan-out, page misses, caches, vertices on the bus.
///
/// Source: derived; with 16 bits a blended, depth-tested fragment moves 6 bytes, with 32 bits 12, a stencil
/// fragment 8, and one that fails the depth test 2 or 4.
struct PassTraffic {
    std::int64_t fragments = 0;  ///< pixels that take the chip's time: all that are rasterised, or copied
    std::int64_t passed = 0;     ///< of the fragments of a draw: those that passed all tests
    std::int64_t triangles = 0;
    std::int64_t depthRead = 0, depthWritten = 0;    ///< bytes
    std::int64_t colourRead = 0, colourWritten = 0;  ///< bytes
    std::int64_t textureWritten = 0;                 ///< bytes, of a copy by the chip
    std::int64_t busBytes = 0;                       ///< read back by the host, and sent again

    /// In the frame buffer's memory.
    std::int64_t bytes() const {
        return depthRead + depthWritten + colourRead + colourWritten + textureWritten;
    }
    bool operator==(const PassTraffic&) const = default;
};

/// @param amount  of the pass
/// @param passed  fragments that passed all tests, as counted; nothing: it is not known, and all are taken to
///                have passed, so that the bytes are at least what is moved
PassTraffic trafficOf(const Pass& pass, const Profile& profile, const DrawnAmount& amount,
                      std::optional<std::int64_t> passed = {});

}  // namespace gnomon
