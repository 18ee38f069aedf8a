#include "matrix/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <tuple>

#include "matrix/cell_json.h"

namespace gnomon {
namespace {

/// How bad an outcome is: its verdict, then its wrong pixels. Refused compares with nothing but exact.
std::tuple<int, long> badness(const std::string& outcome) {
    static const std::array<std::string, 5> kOrder{"exact", "edge", "wrong", "refused", "failed"};
    const std::string word = outcome.substr(0, outcome.find_first_of(" :"));
    const auto rank = std::find(kOrder.begin(), kOrder.end(), word) - kOrder.begin();
    char* end = nullptr;
    const char* numbers = outcome.c_str() + word.size();
    long pixels = std::strtol(numbers, &end, 10);
    if (*end == '+') pixels += std::strtol(end + 1, nullptr, 10);
    return {int(rank), pixels};
}

CheckClass classOf(const std::string& expected, const std::string& found) {
    if (found == expected) return CheckClass::Expected;
    const bool isRefused = expected.starts_with(name(Verdict::Refused));
    const bool isSound = found.find("unpredicted") == std::string::npos;
    const bool isBetter = isRefused ? found == name(Verdict::Exact)
                                    : badness(found) < badness(expected) && !found.starts_with("refused");
    return isBetter && isSound ? CheckClass::Improved : CheckClass::Unexpected;
}

/// What the repetitions found of a cell; each once.
std::string differences(const std::vector<const Cell*>& repetitions) {
    std::vector<std::string> outcomes, digests;
    const auto addOnce = [](std::vector<std::string>& list, const std::string& text) {
        if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
    };
    for (const Cell* cell : repetitions) {
        addOnce(outcomes, outcomeOf(*cell));
        addOnce(digests, fmt::format("{} of digest {}", outcomeOf(*cell), cell->digest));
    }
    if (outcomes.size() > 1) return fmt::format("{}", fmt::join(outcomes, " / "));
    return fmt::format("{}", fmt::join(digests, " / "));
}

}  // namespace

const std::string& name(CheckClass what) {
    static const std::array<std::string, kCheckClasses> names{"expected", "unexpected", "improved", "missing",
                                                              "flaky"};
    return names[std::size_t(what)];
}

std::size_t CheckResult::count(CheckClass what) const {
    return std::size_t(std::count_if(cells.begin(), cells.end(),
                                     [&](const CheckedCell& cell) { return cell.what == what; }));
}

bool CheckResult::isGood() const {
    return count(CheckClass::Expected) == cells.size();
}

CheckResult checkCells(const Expectations& expectations, const std::vector<std::vector<Cell>>& runs,
                       bool isWhole) {
    CheckResult result;
    std::set<std::string> places;
    for (std::size_t i = 0; i < runs.front().size(); ++i) {
        const Cell& cell = runs.front()[i];
        CheckedCell one{.place = placeOf(cell), .found = outcomeOf(cell), .cell = cell};
        one.expected = expectations.outcomeAt(one.place);
        if (const auto line = expectations.cells.find(one.place); line != expectations.cells.end())
            one.why = line->second.why;
        one.what = classOf(one.expected, one.found);
        std::vector<const Cell*> repetitions;
        for (const std::vector<Cell>& run : runs) repetitions.push_back(&run[i]);
        const bool isSame = std::all_of(repetitions.begin() + 1, repetitions.end(), [&](const Cell* other) {
            return withoutTimes(*other) == withoutTimes(cell);
        });
        if (!isSame) one.what = CheckClass::Flaky, one.found = differences(repetitions);
        places.insert(one.place);
        result.cells.push_back(std::move(one));
    }
    for (const auto& [place, line] : expectations.cells) {
        if (places.contains(place)) continue;
        if (isWhole)
            result.cells.push_back({.what = CheckClass::Missing,
                                    .place = place,
                                    .expected = line.outcome,
                                    .found = "no such cell in this run",
                                    .why = line.why});
        else
            ++result.outside;
    }
    return result;
}

}  // namespace gnomon
