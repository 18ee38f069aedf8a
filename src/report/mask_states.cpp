#include "report/mask_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "gl/buffer_format.h"
#include "gl/chip_arithmetic.h"

namespace gnomon {
namespace {

/// What @p cell claims of its mask's channel; none where it doesn't double or halve in a buffer of its own
/// bits.
std::optional<MaskClaim> claimOf(const Cell& cell, const Profile& profile) {
    const Axes& a = cell.axes;
    const bool inColour = a.store == Store::Screen, inAlpha = a.store == Store::Alpha;
    const bool doubles = a.arithmetic == Arithmetic::Double, halves = a.arithmetic == Arithmetic::Halve;
    if (cell.verdict == Verdict::Refused || !(inColour || inAlpha) || !(doubles || halves)) return {};
    const BufferFormat format = bufferFormatOf(profile);
    FidelityChoice choice;
    if (cell.fidelity == name(Fidelity::Chip)) choice.fidelity = Fidelity::Chip;
    MaskClaim claim{.arithmetic = doubles ? MaskArithmetic::Double : MaskArithmetic::Halve};
    claim.channel = {.unit = arithmeticOf(profile, choice).unit, .bits = inAlpha ? format.alpha : format.red};
    if (claim.channel.bits < 2 || !canDraw(claim.channel, claim.arithmetic)) return {};
    return claim;
}

}  // namespace

std::string meaning(const MaskState& state) {
    const std::string what = state.isLit && state.isShadow ? "lit or in shadow"
                             : state.isShadow              ? "in shadow"
                                                           : "lit";
    if (!state.isStart) return what;
    return what == "lit" ? "start" : "start, " + what;
}

std::string meaning(const MaskStep& step, const MaskStates& graph) {
    const bool doubles = step.isFront == (graph.arithmetic == MaskArithmetic::Double);
    return fmt::format("{} face {}", step.isFront ? "front" : "back", doubles ? "doubles" : "halves");
}

MaskStates maskStates(const MaskClaim& claim, const MaskChoice& choice, int open) {
    using enum MaskOperation;
    const bool doubles = claim.arithmetic == MaskArithmetic::Double;
    const auto step = [&](bool isFront, int code) {
        const MaskOperation operation = isFront == doubles ? Double : Halve;
        return apply(claim.channel, operation, code, choice.half).value();
    };
    std::map<int, MaskState> states;
    std::set<std::tuple<int, bool, int>> steps;
    std::set<std::pair<int, int>> seen;
    std::vector<std::pair<int, int>> todo{{choice.start, 0}};  // code, open volumes
    while (!todo.empty()) {
        const auto [code, depth] = todo.back();
        todo.pop_back();
        if (!seen.emplace(code, depth).second) continue;
        MaskState& state = states[code];
        state.code = code;
        state.isStart = code == choice.start;
        (depth > 0 ? state.isShadow : state.isLit) = true;
        for (const bool isFront : {true, false}) {
            const int next = depth + (isFront ? 1 : -1);
            if (next < 0 || next > open) continue;
            const int to = step(isFront, code);
            steps.emplace(code, isFront, to);
            todo.emplace_back(to, next);
        }
    }
    MaskStates graph{.arithmetic = claim.arithmetic};
    for (const auto& entry : states) graph.states.push_back(entry.second);
    for (const auto& [from, isFront, to] : steps) graph.steps.push_back({from, to, isFront});
    graph.title =
        fmt::format("{} in {} bits{}, up to {} volumes open", name(claim.arithmetic), claim.channel.bits,
                    claim.channel.unit == BlendUnit::IdealRound
                        ? ""
                        : fmt::format(" of blend unit {}", name(claim.channel.unit)),
                    open);
    return graph;
}

std::vector<MaskStates> statesOf(const std::vector<Cell>& cells, const RunSources& sources) {
    std::vector<MaskStates> graphs;
    std::set<std::tuple<MaskClaim, int>> known;
    for (const Cell& cell : cells) {
        const auto profile = sources.profiles.find(cell.profile);
        if (profile == sources.profiles.end()) continue;
        const auto claim = claimOf(cell, profile->second);
        if (!claim) continue;
        const bool doubles = claim->arithmetic == MaskArithmetic::Double;
        const int levels = doubles ? cell.axes.levels : 0;
        if (levels > claim->channel.bits || !known.emplace(*claim, levels).second) continue;
        const auto starts = startsOf(*claim, doubles ? std::optional(levels) : std::nullopt);
        // One level more than it resolves, to show what it loses.
        MaskStates graph = maskStates(*claim, {.start = starts.front()}, doubles ? levels + 1 : 3);
        const auto isSame = [&](const MaskStates& other) {
            return other.title == graph.title && other.steps == graph.steps;
        };
        if (std::any_of(graphs.begin(), graphs.end(), isSame)) continue;
        graph.profile = cell.profile, graph.method = cell.method;
        graphs.push_back(std::move(graph));
    }
    return graphs;
}

}  // namespace gnomon
