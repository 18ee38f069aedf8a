#include "profile/prove.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace gnomon {
namespace {

constexpr int kNever = std::numeric_limits<int>::max();
constexpr std::array kDriftAfter{1, 8, 64};

/// What a front (up) and a back face (down) make of each code, in one cell of the dither matrix.
struct Steps {
    int cell = 0;
    std::vector<int> up{}, down{};
};

std::pair<MaskOperation, MaskOperation> operationsOf(MaskArithmetic arithmetic, MaskMeans means) {
    using enum MaskOperation;
    switch (arithmetic) {
        case MaskArithmetic::Double:
            return {Double, Halve};
        case MaskArithmetic::Halve:
            return {Halve, Double};
        case MaskArithmetic::Parity:
            if (means == MaskMeans::LogicOp) return {InvertBits, InvertBits};
            return {Invert, Invert};
        case MaskArithmetic::Count:
            if (means == MaskMeans::AddWrap) return {IncrementWrap, DecrementWrap};
            return {Increment, Decrement};
    }
    return {};
}

/// The cells that a dither matrix has.
std::vector<int> cellsOf(DitherMode mode) {
    std::set<int> cells;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) cells.insert(ditherCell(mode, x, y));
    return {cells.begin(), cells.end()};
}

std::vector<Steps> stepsOf(const MaskClaim& claim, int half) {
    const auto [up, down] = operationsOf(claim.arithmetic, claim.means);
    std::vector<Steps> all;
    for (const int cell : cellsOf(claim.channel.dither)) {
        FrameChannel channel = claim.channel;
        channel.cell = cell;
        Steps steps{.cell = cell};
        for (int code = 0; code <= largestCode(channel.bits); ++code) {
            steps.up.push_back(*apply(channel, up, code, half));
            steps.down.push_back(*apply(channel, down, code, half));
        }
        all.push_back(std::move(steps));
    }
    return all;
}

/// A place in the drawing of one pixel.
struct State {
    int code = 0;
    int open = 0;        ///< fronts less backs; negative only in any order
    bool backs = false;  ///< fronts first: a back has been drawn
};

/// All places, as numbers, with at most @p most volumes open.
class Places {
  public:
    Places(int codes, int most) : m_codes(codes), m_most(most) {}
    std::size_t count() const { return std::size_t(2) * std::size_t(2 * m_most + 1) * std::size_t(m_codes); }
    std::size_t indexOf(const State& s) const {
        const int row = (s.backs ? 2 * m_most + 1 : 0) + s.open + m_most;
        return std::size_t(row) * std::size_t(m_codes) + std::size_t(s.code);
    }
    int most() const { return m_most; }

  private:
    int m_codes, m_most;
};

/// Calls @p visit(next, crossings, volumes) for each way on from @p state.
template <class Visit>
void forEachNext(const Steps& steps, DrawOrder order, int most, const State& state, Visit visit) {
    const auto up = [&](int code) { return steps.up[std::size_t(code)]; };
    const auto down = [&](int code) { return steps.down[std::size_t(code)]; };
    const int once = up(state.code), there = down(once);
    const bool mayOpen = state.open < most;
    switch (order) {
        case DrawOrder::Volume:
            if (!mayOpen) return;
            visit(State{once, state.open + 1}, "D", 1);
            visit(State{there, state.open}, "DH", 1);
            return;
        case DrawOrder::FrontsFirst:
            if (!state.backs && mayOpen) visit(State{once, state.open + 1}, "D", 1);
            if (state.open > 0) visit(State{down(state.code), state.open - 1, true}, "H", 0);
            return;
        case DrawOrder::PerTriangle:
            if (mayOpen) visit(State{once, state.open + 1}, "D", 1);
            if (state.open > -most) visit(State{down(state.code), state.open - 1}, "H", 0);
            return;
        case DrawOrder::NearerOnly:
            if (!mayOpen) return;
            visit(State{up(there), state.open + 1}, "DHD", 1);
            visit(State{there, state.open}, "DH", 1);
            visit(State{up(down(there)), state.open}, "DHHD", 1);
            return;
    }
}

/// Whether all that matters of the open volumes is that there is one: no later crossing depends on them.
bool forgetsOpen(DrawOrder order) {
    return order == DrawOrder::Volume || order == DrawOrder::NearerOnly;
}

/// The fewest volumes with which a pixel, lit or in shadow, ends with each code.
struct Reached {
    std::vector<int> lit, shadow;
};

/// The fewest volumes of a wrong pixel for each threshold 0..codes; kNever if there is none.
std::vector<int> failuresOf(const Reached& reached, MaskArithmetic arithmetic) {
    const std::size_t codes = reached.lit.size();
    const auto& below =
        shadowIsBright(arithmetic) ? reached.shadow : reached.lit;  // wrong below the threshold
    const auto& above = shadowIsBright(arithmetic) ? reached.lit : reached.shadow;
    std::vector<int> failures(codes + 1, kNever);
    int least = kNever;
    for (std::size_t t = 0; t <= codes; ++t) {
        failures[t] = least;
        if (t < codes) least = std::min(least, below[t]);
    }
    least = kNever;
    for (std::size_t t = codes; t-- > 0;) {
        least = std::min(least, above[t]);
        failures[t] = std::min(failures[t], least);
    }
    return failures;
}

bool allFail(const Reached& reached, MaskArithmetic arithmetic) {
    const auto failures = failuresOf(reached, arithmetic);
    return std::find(failures.begin(), failures.end(), kNever) == failures.end();
}

/// Breadth first by volumes. Ends when nothing is new, when every threshold has failed, or after @p volumes.
Reached explore(const Steps& steps, const MaskClaim& claim, int start, int most, int volumes = kNever) {
    const std::size_t codes = steps.up.size();
    // Without a bound on the nesting, one open volume stands for any number.
    const bool forgets = most == kMostNesting && forgetsOpen(claim.order);
    const Places places(int(codes), forgets ? 1 : most);
    std::vector<bool> seen(places.count());
    Reached reached{std::vector<int>(codes, kNever), std::vector<int>(codes, kNever)};
    std::vector<State> level, next;
    const auto enter = [&](State s, std::vector<State>& into) {
        if (forgets) s.open = std::min(s.open, 1);
        const std::size_t index = places.indexOf(s);
        if (seen[index]) return;
        seen[index] = true;
        into.push_back(s);
    };
    enter({start, 0, false}, level);
    for (int n = 0; !level.empty() && n <= volumes; ++n) {
        // Backs cost no volume, so that the level grows while it is walked.
        for (std::size_t i = 0; i < level.size(); ++i) {
            const State s = level[i];
            if (s.open >= 0) {
                auto& codesOf = s.open > 0 ? reached.shadow : reached.lit;
                codesOf[std::size_t(s.code)] = std::min(codesOf[std::size_t(s.code)], n);
            }
            forEachNext(steps, claim.order, most, s,
                        [&](const State& to, const char*, int cost) { enter(to, cost == 0 ? level : next); });
        }
        if (allFail(reached, claim.arithmetic)) break;
        level = std::move(next);
        next.clear();
    }
    return reached;
}

/// As explore(), over all cells.
Reached exploreCells(const std::vector<Steps>& cells, const MaskClaim& claim, int start, int most,
                     int volumes = kNever) {
    Reached all = explore(cells.front(), claim, start, most, volumes);
    for (std::size_t i = 1; i < cells.size(); ++i) {
        const Reached one = explore(cells[i], claim, start, most, volumes);
        for (std::size_t c = 0; c < all.lit.size(); ++c) {
            all.lit[c] = std::min(all.lit[c], one.lit[c]);
            all.shadow[c] = std::min(all.shadow[c], one.shadow[c]);
        }
    }
    return all;
}

/// What each threshold is good for.
struct Limits {
    std::vector<int> depth, volumes;  ///< kNever: any
};

/// Exact for the threshold @p only; without it, exact for the best thresholds, and never too little for
/// others.
Limits limitsOf(const std::vector<Steps>& cells, const MaskClaim& claim, int start,
                std::optional<int> only = {}) {
    const auto failures = [&](int most) {
        return failuresOf(exploreCells(cells, claim, start, most), claim.arithmetic);
    };
    const auto someSurvive = [&](const std::vector<int>& failed) {
        if (only) return failed[std::size_t(*only)] == kNever;
        return std::find(failed.begin(), failed.end(), kNever) != failed.end();
    };
    const std::vector<int> unbounded = failures(kMostNesting);
    Limits limits{std::vector<int>(unbounded.size(), kNever), unbounded};
    for (int& v : limits.volumes)
        if (v != kNever) --v;
    if (someSurvive(unbounded)) return limits;

    // More open volumes only add states, so that a threshold which fails goes on failing: the bound is found
    // by doubling, then by halving.
    const auto survives = [&](int most) {
        const std::vector<int> failed = most == kMostNesting ? unbounded : failures(most);
        for (std::size_t t = 0; t < failed.size(); ++t)
            if (failed[t] != kNever) limits.depth[t] = std::min(limits.depth[t], most - 1);
        return someSurvive(failed);
    };
    if (!survives(0)) return limits;
    int good = 0, bad = 1;
    while (survives(bad)) {
        good = bad;
        bad = std::min(2 * bad, kMostNesting);
    }
    while (bad - good > 1) {
        const int middle = (good + bad) / 2;
        (survives(middle) ? good : bad) = middle;
    }
    return limits;
}

/// The fewest crossings that end in a wrong pixel.
std::optional<Counterexample> shortest(const std::vector<Steps>& cells, const MaskClaim& claim,
                                       const MaskChoice& choice) {
    const bool bright = shadowIsBright(claim.arithmetic);
    const auto isWrong = [&](const State& s) {
        return s.open >= 0 && (s.open > 0) != ((s.code >= choice.threshold) == bright);
    };
    struct Node {
        State state{};
        std::size_t from = 0;
        const char* crossings = "";
        std::size_t length = 0;
    };
    std::optional<Counterexample> best;
    for (const Steps& steps : cells) {
        const Places places(int(steps.up.size()), kMostNesting);
        std::vector<bool> seen(places.count());
        std::vector<Node> nodes;
        // By length: a whole volume is two crossings, so that it waits one round.
        std::vector<std::vector<Node>> rounds(1);
        rounds[0].push_back({{choice.start, 0, false}});
        std::optional<std::size_t> wrong;
        for (std::size_t length = 0; length < rounds.size() && !wrong; ++length) {
            if (best && length >= best->crossings.size()) break;
            const std::vector<Node> round = std::move(rounds[length]);
            for (const Node& node : round) {
                const std::size_t index = places.indexOf(node.state);
                if (seen[index]) continue;
                seen[index] = true;
                nodes.push_back(node);
                if (isWrong(node.state)) {
                    wrong = nodes.size() - 1;
                    break;
                }
                const std::size_t from = nodes.size() - 1;
                forEachNext(steps, claim.order, kMostNesting, node.state,
                            [&](const State& to, const char* crossings, int) {
                                const std::size_t then = length + std::char_traits<char>::length(crossings);
                                if (rounds.size() <= then) rounds.resize(then + 1);
                                rounds[then].push_back({to, from, crossings, then});
                            });
            }
        }
        if (!wrong) continue;
        Counterexample found{.cell = steps.cell};
        for (std::size_t at = *wrong; nodes[at].length > 0; at = nodes[at].from)
            found.crossings.insert(0, nodes[at].crossings);
        found.codes.push_back(choice.start);
        for (const char c : found.crossings)
            found.codes.push_back((c == 'D' ? steps.up : steps.down)[std::size_t(found.codes.back())]);
        best = std::move(found);
    }
    return best;
}

/// The mask's code after the rectangles that bring a lit pixel to 1 and a shadow to 0 (Roettger et al.
/// 2002, 4.2 and 4.4, black shadows); none where the unit lacks one.
std::optional<int> normalised(const FrameChannel& channel, const MaskClaim& claim, const MaskChoice& choice,
                              int code) {
    std::vector<MaskOperation> rectangles;
    if (claim.arithmetic == MaskArithmetic::Double) {
        const int levels =
            int(std::lround(std::log2(double(largestCode(channel.bits)) / std::max(choice.start, 1))));
        rectangles.assign(std::size_t(std::max(levels - 1, 0)), MaskOperation::Double);
        rectangles.insert(rectangles.end(), {MaskOperation::Invert, MaskOperation::Double});
    } else if (claim.arithmetic == MaskArithmetic::Halve) {
        rectangles = {MaskOperation::Invert, MaskOperation::Double, MaskOperation::Invert};
    } else {
        return {};
    }
    for (const MaskOperation operation : rectangles) {
        const auto next = apply(channel, operation, code, choice.half);
        if (!next) return {};
        code = *next;
    }
    return code;
}

void measureResidue(const std::vector<Steps>& cells, const MaskClaim& claim, MaskProof& proof) {
    const int depth = proof.depth.value_or(kMostNesting), count = proof.volumes.value_or(kNever);
    if (depth < 0 || count <= 0) return;
    const int most = depth == 0 ? kMostNesting : depth, volumes = depth == 0 ? count : kNever;
    int light = 0, darkness = 0;
    for (const Steps& steps : cells) {
        FrameChannel channel = claim.channel;
        channel.cell = steps.cell;
        const Reached reached = explore(steps, claim, proof.choice.start, most, volumes);
        for (int code = 0; code <= largestCode(channel.bits); ++code) {
            const auto after = normalised(channel, claim, proof.choice, code);
            if (!after) return;
            if (reached.shadow[std::size_t(code)] != kNever) light = std::max(light, *after);
            if (reached.lit[std::size_t(code)] != kNever)
                darkness = std::max(darkness, largestCode(channel.bits) - *after);
        }
    }
    proof.lightInShadow = light;
    proof.darknessOutside = darkness;
}

std::vector<MaskProof::Drift> driftOf(const std::vector<Steps>& cells, int start) {
    std::vector<MaskProof::Drift> all;
    for (const int volumes : kDriftAfter) {
        int lowest = kNever, highest = -kNever;
        for (const Steps& steps : cells) {
            int code = start;
            for (int i = 0; i < volumes; ++i) code = steps.down[std::size_t(steps.up[std::size_t(code)])];
            lowest = std::min(lowest, code - start);
            highest = std::max(highest, code - start);
        }
        all.push_back({volumes, lowest, highest});
    }
    return all;
}

/// MaskProof::period, over all cells; none where they differ.
std::optional<int> periodOf(const std::vector<Steps>& cells, int start) {
    std::optional<int> period;
    for (const Steps& steps : cells) {
        int code = start, length = 0;
        do {
            const int next = steps.up[std::size_t(code)];
            if (steps.down[std::size_t(next)] != code) return {};
            code = next;
            if (++length > int(steps.up.size())) return {};
        } while (code != start);
        if (period && *period != length) return {};
        period = length;
    }
    return period;
}

std::optional<int> limit(int value) {
    return value == kNever ? std::nullopt : std::optional(value);
}

MaskProof complete(const std::vector<Steps>& cells, const MaskClaim& claim, const MaskChoice& choice,
                   int depth, int volumes) {
    MaskProof proof{.choice = choice, .depth = limit(depth), .volumes = limit(volumes)};
    proof.counterexample = shortest(cells, claim, choice);
    measureResidue(cells, claim, proof);
    proof.drift = driftOf(cells, choice.start);
    proof.period = periodOf(cells, choice.start);
    return proof;
}

}  // namespace

const std::string& name(MaskArithmetic word) {
    static const std::array<std::string, kMaskArithmetics> kNames{"double", "halve", "parity", "count"};
    return kNames[std::size_t(word)];
}

const std::string& name(MaskMeans word) {
    static const std::array<std::string, kMaskMeans> kNames{"blend", "add_wrap", "logic_op"};
    return kNames[std::size_t(word)];
}

const std::string& name(DrawOrder word) {
    static const std::array<std::string, kDrawOrders> kNames{"volume", "fronts-first", "per-triangle",
                                                             "nearer-only"};
    return kNames[std::size_t(word)];
}

bool canDraw(const FrameChannel& channel, MaskArithmetic arithmetic, MaskMeans means) {
    const auto [up, down] = operationsOf(arithmetic, means);
    return apply(channel, up, 0).has_value() && apply(channel, down, 0).has_value();
}

bool usesHalfConstant(const MaskClaim& claim) {
    return takesHalfConstant(claim.channel.unit) &&
           (claim.arithmetic == MaskArithmetic::Double || claim.arithmetic == MaskArithmetic::Halve);
}

bool shadowIsBright(MaskArithmetic arithmetic) {
    return arithmetic == MaskArithmetic::Double || arithmetic == MaskArithmetic::Count;
}

std::vector<int> startsOf(const MaskClaim& claim, std::optional<int> levels) {
    const int most = largestCode(claim.channel.bits);
    std::vector<int> starts;
    switch (claim.arithmetic) {
        case MaskArithmetic::Double:
            if (levels) return {std::max(int(std::lround(double(most) / (1 << *levels))), 1)};
            // From above: fewer levels cost fewer rectangles.
            for (int code = most - 1; code > 0; --code) starts.push_back(code);
            return starts;
        case MaskArithmetic::Halve:
            for (int code = most; code > most / 2; --code) starts.push_back(code);
            return starts;
        case MaskArithmetic::Parity:
            return {most, 0};
        case MaskArithmetic::Count:
            // In the middle, counts may go below the start; from 0 there is most room above.
            return {0, (most + 1) / 2};
    }
    return starts;
}

MaskProof prove(const MaskClaim& claim, const MaskChoice& choice) {
    assert(canDraw(claim.channel, claim.arithmetic, claim.means));
    assert(choice.threshold >= 0 && choice.threshold <= largestCode(claim.channel.bits) + 1);
    const auto cells = stepsOf(claim, choice.half);
    const Limits limits = limitsOf(cells, claim, choice.start, choice.threshold);
    const auto t = std::size_t(choice.threshold);
    return complete(cells, claim, choice, limits.depth[t], limits.volumes[t]);
}

MaskProof bestProof(const MaskClaim& claim, const std::vector<int>& starts) {
    assert(canDraw(claim.channel, claim.arithmetic, claim.means) && !starts.empty());
    // All choices that reach as far as any.
    std::pair best{-2, -2};
    std::array<std::pair<int, int>, 2> bestOf{best, best};  // of 128, of 127
    std::vector<MaskChoice> equals;
    std::map<int, std::vector<Steps>> cellsOfHalf;
    for (const int half : {128, 127}) {
        if (half == 127 && !usesHalfConstant(claim)) break;
        const auto& cells = cellsOfHalf[half] = stepsOf(claim, half);
        for (const int start : starts) {
            const Limits limits = limitsOf(cells, claim, start);
            const auto valueOf = [&](std::size_t t) { return std::pair(limits.depth[t], limits.volumes[t]); };
            std::size_t first = 0;
            for (std::size_t t = 0; t < limits.depth.size(); ++t)
                if (valueOf(t) > valueOf(first)) first = t;
            auto& bestOfHalf = bestOf[half == 128 ? 0 : 1];
            bestOfHalf = std::max(bestOfHalf, valueOf(first));
            if (valueOf(first) < best) continue;
            if (valueOf(first) > best) equals.clear();
            best = valueOf(first);
            std::size_t last = first;
            while (last + 1 < limits.depth.size() && valueOf(last + 1) == best) ++last;
            equals.push_back({start, half, int((first + last + 1) / 2)});
        }
    }

    // Of these the one whose normalisation leaves least.
    const auto residueOf = [&](const MaskChoice& choice) {
        MaskProof proof{.choice = choice, .depth = limit(best.first), .volumes = limit(best.second)};
        measureResidue(cellsOfHalf.at(choice.half), claim, proof);
        return proof.lightInShadow.value_or(0) + proof.darknessOutside.value_or(0);
    };
    MaskChoice choice = equals.front();
    if (equals.size() > 1) {
        int least = residueOf(choice);
        for (const MaskChoice& other : equals)
            if (const int residue = residueOf(other); residue < least) {
                least = residue;
                choice = other;
            }
    }
    MaskProof proof = complete(cellsOfHalf.at(choice.half), claim, choice, best.first, best.second);
    const auto& other = bestOf[choice.half == 128 ? 1 : 0];
    if (usesHalfConstant(claim) && other < best)
        proof.otherHalf = {{.depth = limit(other.first), .volumes = limit(other.second)}};
    return proof;
}

}  // namespace gnomon
