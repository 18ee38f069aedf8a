#pragma once

#include <cstddef>
#include <string_view>

namespace gnomon {

/// Parts that a key of a TOML file may have here, "a.b.c" has three. toml++ (3.3) bounds how deep values
/// nest, but not this: each part is a table in a table, and to destroy them takes the stack.
constexpr std::size_t kMostKeyParts = 16;

/// The first line of @p toml whose key has more parts, from 1; 0 if there is none. Syntax errors are left to
/// the parser.
std::size_t lineOfDeepKey(std::string_view toml);

}  // namespace gnomon
