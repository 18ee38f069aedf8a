#include <algorithm>
#include <tuple>

#include "matrix/advice.h"

namespace gnomon {
namespace {

bool isCheaper(const AdviceRow& a, const AdviceRow& b) {
    const auto key = [](const AdviceRow& row) {
        return std::tuple(!row.isDrawn(), rankedNs(row.cost), row.amount.pixels.total(), row.amount.vertices,
                          row.minimal.plan.passes.size());
    };
    if (!a.isDrawn() && !b.isDrawn()) return false;
    return key(a) < key(b);
}

}  // namespace

const AdviceRow* Advice::nextCheaper() const {
    for (std::size_t i = chosen.value_or(0); i-- > 0;)
        if (rows[i].cell.verdict != Verdict::Exact) return &rows[i];
    return nullptr;
}

std::vector<const AdviceRow*> Advice::cheaperUnproved() const {
    std::vector<const AdviceRow*> exact;
    for (std::size_t i = 0; i < chosen.value_or(0); ++i)
        if (rows[i].cell.verdict == Verdict::Exact) exact.push_back(&rows[i]);
    return exact;
}

const AdviceRow* Advice::leastWrong() const {
    const AdviceRow* best = nullptr;
    for (const AdviceRow& row : rows)
        if (row.isDrawn() && (!best || row.wrong() < best->wrong())) best = &row;
    return best;
}

Advice ranked(Advice advice) {
    std::stable_sort(advice.rows.begin(), advice.rows.end(), isCheaper);
    const auto isExact = [](const AdviceRow& row) { return row.cell.verdict == Verdict::Exact; };
    const auto isProved = [&](const AdviceRow& row) { return isExact(row) && !row.proof.empty(); };
    auto chosen = std::find_if(advice.rows.begin(), advice.rows.end(), isProved);
    if (chosen == advice.rows.end()) chosen = std::find_if(advice.rows.begin(), advice.rows.end(), isExact);
    advice.chosen.reset();
    if (chosen != advice.rows.end()) advice.chosen = std::size_t(chosen - advice.rows.begin());
    return advice;
}

}  // namespace gnomon
