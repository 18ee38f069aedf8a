#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "plan/plan.h"
#include "predict/crossings.h"

namespace gnomon {

/// The rectangles that bound a light's passes, on the pixels that are predicted: those of the mask, or of the
/// window where a mask of fewer pixels is explained; then they hold all that the mask's may hold.
class MaskBounds {
  public:
    MaskBounds() = default;
    MaskBounds(const Plan& plan, int light, const Crossings& crossings) {
        for (const MaskWindow& window : plan.windows)
            m_shadows.push_back(stretched(window.all, plan, crossings));
        for (const WindowRect& window : plan.windows[std::size_t(light)].volumes)
            m_volumes.push_back(stretched(window, plan, crossings));
        m_columns = runs(crossings.width, [](const WindowRect& r) { return std::pair(r.x, r.x + r.width); });
        m_rows = runs(crossings.height, [](const WindowRect& r) { return std::pair(r.y, r.y + r.height); });
    }

    /// By light
    const WindowRect& shadows(int light) const { return m_shadows[std::size_t(light)]; }
    /// By volume of the plan
    const WindowRect& volume(int index) const { return m_volumes[std::size_t(index)]; }

    /// Pixels of one region lie in the same rectangles.
    std::uint32_t region(const glm::ivec2& pixel) const {
        return (std::uint32_t(m_columns[std::size_t(pixel.x)]) << 16) | m_rows[std::size_t(pixel.y)];
    }

  private:
    static WindowRect stretched(const WindowRect& r, const Plan& plan, const Crossings& crossings) {
        if (r.empty() || (crossings.width == plan.maskWidth && crossings.height == plan.maskHeight)) return r;
        const auto low = [](int at, int to, int from) { return at * to / from; };
        const auto high = [](int at, int to, int from) { return (at * to + from - 1) / from; };
        const int x = low(r.x, crossings.width, plan.maskWidth),
                  y = low(r.y, crossings.height, plan.maskHeight);
        return {x, y, high(r.x + r.width, crossings.width, plan.maskWidth) - x,
                high(r.y + r.height, crossings.height, plan.maskHeight) - y};
    }

    /// For each of @p size columns or rows, how many borders lie at or before it.
    template <class Ends>
    std::vector<std::uint16_t> runs(int size, const Ends& endsOf) const {
        std::vector<std::uint16_t> run(std::size_t(size), 0);
        for (const auto* rectangles : {&m_shadows, &m_volumes})
            for (const WindowRect& r : *rectangles)
                for (const int end : {endsOf(r).first, endsOf(r).second})
                    if (!r.empty() && end > 0 && end < size) run[std::size_t(end)] = 1;
        std::partial_sum(run.begin(), run.end(), run.begin());
        return run;
    }

    std::vector<WindowRect> m_shadows{}, m_volumes{};
    std::vector<std::uint16_t> m_columns{}, m_rows{};  ///< rows from the bottom
};

}  // namespace gnomon
