#include "text/deep_key.h"

#include <algorithm>

namespace gnomon {
namespace {

/// Past the string that begins at @p at; one of a single line ends before the line's end at the latest.
std::size_t endOfString(std::string_view toml, std::size_t at) {
    const char quote = toml[at];
    const auto isTriple = [&](std::size_t i) {
        return toml.substr(i, 3) == std::string_view(quote == '"' ? "\"\"\"" : "'''");
    };
    const bool isLong = isTriple(at);
    for (at += isLong ? 3 : 1; at < toml.size(); ++at) {
        if (toml[at] == '\\' && quote == '"') {
            ++at;
        } else if (isLong && isTriple(at)) {
            at += 3;
            // Up to two quotes more are the string's own.
            for (int k = 0; k < 2 && at < toml.size() && toml[at] == quote; ++k) ++at;
            return at;
        } else if (!isLong && toml[at] == '\n') {
            return at;
        } else if (!isLong && toml[at] == quote) {
            return at + 1;
        }
    }
    return toml.size();
}

}  // namespace

std::size_t lineOfDeepKey(std::string_view toml) {
    constexpr std::string_view kSeparators = "\n=,[]{}";
    std::size_t line = 1, parts = 1;
    for (std::size_t at = 0; at < toml.size();) {
        const char c = toml[at];
        if (c == '"' || c == '\'') {
            const std::size_t end = std::min(endOfString(toml, at), toml.size());
            line += std::size_t(
                std::count(toml.begin() + std::ptrdiff_t(at), toml.begin() + std::ptrdiff_t(end), '\n'));
            at = end;
            continue;
        }
        if (c == '#') {
            at = std::min(toml.find('\n', at), toml.size());
            continue;
        }
        if (c == '.' && ++parts > kMostKeyParts) return line;
        if (kSeparators.find(c) != std::string_view::npos) parts = 1;
        line += c == '\n';
        ++at;
    }
    return 0;
}

}  // namespace gnomon
