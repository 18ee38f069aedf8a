#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace gnomon {

/// Items in one bucket per vertex, each bucket sorted.
template <class Item>
class Buckets {
  public:
    /// @param each calls its argument with (vertex, item) for all items
    template <class Each>
    Buckets(std::size_t vertices, const Each& each) : m_begins(vertices + 1, 0) {
        each([&](std::uint32_t vertex, const Item&) { ++m_begins[vertex + 1]; });
        std::partial_sum(m_begins.begin(), m_begins.end(), m_begins.begin());
        m_items.resize(m_begins.back());
        std::vector<std::size_t> next(m_begins.begin(), m_begins.end() - 1);
        each([&](std::uint32_t vertex, const Item& item) { m_items[next[vertex]++] = item; });
        for (std::size_t v = 0; v < vertices; ++v)
            std::sort(m_items.begin() + std::ptrdiff_t(m_begins[v]),
                      m_items.begin() + std::ptrdiff_t(m_begins[v + 1]));
    }

    /// Calls @p run with (vertex, items) for each run of items of a bucket with the same @p key.
    template <class Key, class Run>
    void forEachRun(const Key& key, const Run& run) const {
        for (std::uint32_t v = 0; v + 1 < m_begins.size(); ++v)
            for (std::size_t i = m_begins[v], end = i; i < m_begins[v + 1]; i = end) {
                while (end < m_begins[v + 1] && key(m_items[end]) == key(m_items[i])) ++end;
                run(v, std::span(m_items).subspan(i, end - i));
            }
    }

  private:
    std::vector<std::size_t> m_begins;
    std::vector<Item> m_items{};
};

}  // namespace gnomon
