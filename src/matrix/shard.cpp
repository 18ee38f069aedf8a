#include "matrix/shard.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "matrix/cell_list.h"

namespace gnomon {
namespace {

constexpr std::size_t kUnitsPerShard = 4;  ///< what is needed to balance them

/// What a shard has or has not: profiles of one group, each that leaves the same rest.
struct ShardUnit {
    std::size_t group = 0, slice = 0;
    std::uint64_t cost = 0;  ///< whole numbers add up to the same in every order
};

/// The cost of a profile in a group, microseconds or pixels; what is not known costs the mean of its scene,
/// or of all.
class ExpectedCosts {
  public:
    explicit ExpectedCosts(const PastCosts& past) : m_past(past) {
        for (const auto& [key, seconds] : past) {
            m_scenes[std::get<0>(key)].add(seconds);
            m_all.add(seconds);
        }
    }

    std::uint64_t of(const CellGroup& group, const Profile& profile) const {
        if (m_past.empty()) return std::uint64_t(group.size.width) * std::uint64_t(group.size.height);
        const auto known =
            m_past.find({group.scene->id, group.size.width, group.size.height, group.frame, profile.id});
        const auto scene = m_scenes.find(group.scene->id);
        const double seconds = known != m_past.end()     ? known->second
                               : scene != m_scenes.end() ? scene->second.value()
                                                         : m_all.value();
        return std::uint64_t(std::llround(std::clamp(seconds, 0.0, 1e9) * 1e6));
    }

  private:
    struct Mean {
        double sum = 0;
        int count = 0;
        void add(double value) { sum += value, ++count; }
        double value() const { return sum / count; }
    };
    const PastCosts& m_past;
    std::map<std::string, Mean> m_scenes{};
    Mean m_all{};
};

/// Every cell is in one of these.
std::vector<ShardUnit> unitsOf(const CellList& list, std::size_t slices, const PastCosts& past) {
    const ExpectedCosts costs(past);
    const std::vector<Profile>& profiles = list.request().profiles;
    std::vector<ShardUnit> units;
    for (std::size_t group = 0; group < list.groups().size(); ++group)
        for (std::size_t slice = 0; slice < slices; ++slice) {
            ShardUnit unit{group, slice};
            for (std::size_t p = slice; p < profiles.size(); p += slices)
                unit.cost += costs.of(list.groups()[group], profiles[p]);
            units.push_back(unit);
        }
    std::stable_sort(units.begin(), units.end(),
                     [](const ShardUnit& a, const ShardUnit& b) { return a.cost > b.cost; });
    return units;
}

}  // namespace

std::vector<std::size_t> placesOf(const CellList& list, const Shard& shard, const PastCosts& past) {
    const auto shards = std::size_t(shard.count);
    const std::size_t profiles = list.request().profiles.size(), groups = list.groups().size();
    std::size_t slices = 1;
    if (shards > 1 && groups > 0 && profiles > 0)
        slices = std::clamp((kUnitsPerShard * shards + groups - 1) / groups, std::size_t(1), profiles);

    std::vector<std::uint64_t> loads(shards);
    std::vector<std::size_t> places;
    for (const ShardUnit& unit : unitsOf(list, slices, past)) {
        const auto least = std::min_element(loads.begin(), loads.end());
        *least += std::max<std::uint64_t>(unit.cost, 1);
        if (least - loads.begin() != shard.index - 1) continue;
        const std::size_t first = unit.group * list.perGroup();
        for (std::size_t i = 0; i < list.perGroup(); ++i)
            if (list.profileOf(first + i) % slices == unit.slice) places.push_back(first + i);
    }
    std::sort(places.begin(), places.end());
    return places;
}

}  // namespace gnomon
