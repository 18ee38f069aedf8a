#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// @p bytes as one raw DEFLATE stream (RFC 1951, no header), as small as zlib makes it; the same for the same
/// bytes.
std::string deflated(std::string_view bytes);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);
/// Its inverse.
/// @throws std::runtime_error if @p text isn't base64
std::string fromBase64(std::string_view text);

}  // namespace gnomon
