#pragma once

#include <cstddef>

namespace gnomon {

constexpr std::size_t kMostKept = 12;  ///< of what is made for each light

/// The value of @p key in @p map, made by @p make if it is new; a map that grows too large is emptied first.
template <class Map, class Make>
auto& kept(Map& map, const typename Map::key_type& key, const Make& make) {
    const auto found = map.find(key);
    if (found != map.end()) return found->second;
    if (map.size() >= kMostKept) map.clear();
    return map.emplace(key, make()).first->second;
}

}  // namespace gnomon
