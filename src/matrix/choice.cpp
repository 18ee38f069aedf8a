#include "matrix/choice.h"

#include <algorithm>
#include <tuple>

namespace gnomon {
namespace {

constexpr int kMostLevels = 7;  ///< that 8 bits can double

/// What the Lab simulates, until this goes.
class Simulating {
  public:
    Simulating(Lab& lab, const Effects& effects) : m_lab(lab), m_before(lab.simulated()) {
        lab.simulate(effects);
    }
    ~Simulating() { m_lab.simulate(m_before); }
    Simulating(const Simulating&) = delete;
    Simulating& operator=(const Simulating&) = delete;

  private:
    Lab& m_lab;
    std::optional<Effects> m_before;
};

std::size_t passesOf(const Option& option) {
    return option.plan.plan.passes.size();
}

}  // namespace

std::vector<Option> options(Lab& lab, const Profile& profile, Shade shade, int width, int height, int frame) {
    std::vector<Option> found;
    for (const NamedMethod& row : namedMethods()) {
        if (row.axes.store == Store::None || row.axes.automatic) continue;
        Option option{.method = row.id, .axes = row.axes};
        option.axes.shade = shade;
        const auto lacks = [&](const Axes& axes) {
            return lab.missingFor(profile, axes, lab.plan(profile, axes, width, height, frame));
        };
        if (option.axes.arithmetic == Arithmetic::Double) {
            // As many levels as may nest, or fewer where these are exact too.
            const int most = std::clamp(lab.nesting(option.axes, width, height, frame).levels,
                                        row.axes.levels, kMostLevels);
            for (Axes more = option.axes; more.levels <= most; ++more.levels) {
                if (!lacks(more).empty()) break;
                option.axes = more;
                if (more.levels == most) break;
                const MinimalPlan plan = lab.minimalPlan(profile, more, width, height, frame);
                if (lab.wrongPixels(profile, plan, width, height, frame) == 0) break;
            }
        }
        option.missing = lacks(option.axes);
        if (option.missing.empty()) {
            option.plan = lab.minimalPlan(profile, option.axes, width, height, frame);
            option.amount = sumOf(lab.amounts(profile, option.plan, width, height, frame));
            if (hasModelRates(profile)) option.cost = lab.cost(profile, option.plan, width, height, frame);
        }
        found.push_back(std::move(option));
    }
    std::stable_sort(found.begin(), found.end(), [](const Option& a, const Option& b) {
        const auto key = [](const Option& o) {
            return std::tuple(!o.missing.empty(), rankedNs(o.cost), o.amount.pixels.total(),
                              o.amount.vertices, passesOf(o));
        };
        return key(a) < key(b);
    });
    return found;
}

Choice choose(Lab& lab, const Profile& profile, const std::vector<Option>& options, int width, int height,
              int frame) {
    const auto end = std::find_if(options.begin(), options.end(),
                                  [](const Option& option) { return !option.missing.empty(); });
    if (end == options.begin()) return {.option = options.front()};
    for (auto option = options.begin(); option != end; ++option) {
        if (option->axes.store == Store::DepthMap) continue;
        if (lab.wrongPixels(profile, option->plan, width, height, frame) == 0)
            return {.option = *option, .proof = Proof::Predicted};
    }
    const Simulating needed(lab, Effects::none());
    const Option* best = nullptr;
    int fewest = 0;
    for (auto option = options.begin(); option != end; ++option) {
        const Cell cell = lab.run(profile, option->axes, width, height, frame);
        if (cell.verdict == Verdict::Exact) return {.option = *option, .proof = Proof::Drawn};
        const int wrong = cell.wrongEdge + cell.wrongInterior;
        if (cell.verdict != Verdict::Failed && (!best || wrong < fewest)) best = &*option, fewest = wrong;
    }
    return {.option = best ? *best : options.front(), .proof = Proof::None, .wrong = fewest};
}

Axes chosenAxes(Lab& lab, const Profile& profile, const Axes& axes, int width, int height, int frame) {
    if (!axes.automatic) return axes;
    const auto all = options(lab, profile, axes.shade, width, height, frame);
    return choose(lab, profile, all, width, height, frame).option.axes;
}

}  // namespace gnomon
