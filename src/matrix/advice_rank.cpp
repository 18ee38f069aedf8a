#include <algorithm>
#include <tuple>

#include "matrix/advice.h"

namespace gnomon {
namespace {

bool isCheaper(const AdviceRow& a, const AdviceRow& b) {
    const auto key = [](const AdviceRow& row) {
        return std::tuple(!row.isDrawn(), row.amount.pixels.total(), row.amount.vertices,
                          row.minimal.plan.passes.size());
    };
    if (!a.isDrawn() && !b.isDrawn()) return false;
    return key(a) < key(b);
}

}  // namespace

const AdviceRow* Advice::nextCheaper() const {
    return chosen && *chosen > 0 ? &rows[*chosen - 1] : nullptr;
}

const AdviceRow* Advice::leastWrong() const {
    const AdviceRow* best = nullptr;
    for (const AdviceRow& row : rows)
        if (row.isDrawn() && (!best || row.wrong() < best->wrong())) best = &row;
    return best;
}

Advice ranked(Advice advice) {
    std::stable_sort(advice.rows.begin(), advice.rows.end(), isCheaper);
    const auto exact = std::find_if(advice.rows.begin(), advice.rows.end(),
                                    [](const AdviceRow& row) { return row.cell.verdict == Verdict::Exact; });
    advice.chosen.reset();
    if (exact != advice.rows.end()) advice.chosen = std::size_t(exact - advice.rows.begin());
    return advice;
}

}  // namespace gnomon
