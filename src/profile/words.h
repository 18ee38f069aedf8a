#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "profile/profile.h"

namespace gnomon {

/// The spellings of all words of one kind, in the order of the enumeration.
/// @tparam Word  BlendFactor, BlendEquation, Compare, StencilOp, WriteMask, FrameTexture, BlendUnit,
/// DitherMode, DepthEncoding or Evidence
template <class Word>
std::span<const std::string> names();

/// The word spelt @p spelling; none if there is no such word. The inverse of name().
template <class Word>
std::optional<Word> fromName(std::string_view spelling) {
    const auto all = names<Word>();
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i] == spelling) return static_cast<Word>(i);
    return {};
}

/// @p word in capitals, as OpenGL and chips spell it.
std::string upperCase(std::string word);

/// All colour formats that a profile may name: red, green, blue and alpha bits from the name's digits.
std::span<const ColourFormat> knownColourFormats();

}  // namespace gnomon
