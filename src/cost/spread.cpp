#include "cost/spread.h"

#include <algorithm>
#include <cassert>

namespace gnomon {

Spread spreadOf(std::vector<double> figures) {
    if (figures.empty()) return {};
    std::sort(figures.begin(), figures.end());
    const auto at = [&](double share) {
        const double place = share * double(figures.size() - 1);
        const auto below = std::size_t(place);
        const auto above = std::min(below + 1, figures.size() - 1);
        return figures[below] + (place - double(below)) * (figures[above] - figures[below]);
    };
    return {.median = at(0.5), .low = at(0.25), .high = at(0.75)};
}

std::vector<double> ratios(std::span<const double> part, std::span<const double> whole) {
    assert(part.size() == whole.size());
    std::vector<double> all;
    for (std::size_t i = 0; i < part.size(); ++i) all.push_back(part[i] / whole[i]);
    return all;
}

}  // namespace gnomon
