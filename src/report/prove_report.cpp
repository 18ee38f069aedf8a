#include "report/prove_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "profile/pixel.h"
#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

/// Longer counterexamples are shortened in the text.
constexpr std::size_t kShownCrossings = 16;

std::string orAny(const std::optional<int>& value) {
    return value ? fmt::format("{}", *value) : "any";
}

std::string orNone(const std::optional<int>& value) {
    return value ? fmt::format("{}", *value) : "-";
}

/// "DDDHH", or "256D 3H" where that is long.
std::string shortened(const std::string& crossings) {
    if (crossings.empty()) return "none drawn";
    if (crossings.size() <= kShownCrossings) return crossings;
    std::vector<std::string> runs;
    for (std::size_t i = 0; i < crossings.size();) {
        const std::size_t end = std::min(crossings.find_first_not_of(crossings[i], i), crossings.size());
        runs.push_back(fmt::format("{}{}", end - i, crossings[i]));
        i = end;
    }
    if (runs.size() <= 6) return fmt::format("{}", fmt::join(runs, " "));
    return fmt::format("{}... ({} crossings)", crossings.substr(0, kShownCrossings), crossings.size());
}

std::string shortened(const std::vector<int>& codes) {
    if (codes.size() <= kShownCrossings + 1) return fmt::format("{}", fmt::join(codes, " "));
    return fmt::format("{} ... {}", fmt::join(codes.begin(), codes.begin() + 4, " "),
                       fmt::join(codes.end() - 3, codes.end(), " "));
}

/// "0", or "-8..3": a lit pixel's code after so many volumes, less the start.
std::string range(const MaskProof::Drift& drift) {
    if (drift.lowest == drift.highest) return fmt::format("{}", drift.lowest);
    return fmt::format("{}..{}", drift.lowest, drift.highest);
}

/// All cells of one row but the counterexample's codes, in the order of the head.
std::vector<std::string> cellsOf(const ProofRow& r) {
    std::vector<std::string> cells{r.profile,
                                   r.store,
                                   r.format,
                                   fmt::format("{}", r.claim.channel.bits),
                                   name(r.claim.channel.unit),
                                   r.grade ? name(*r.grade) : "",
                                   name(r.claim.channel.dither),
                                   name(r.claim.arithmetic),
                                   r.levels ? fmt::format("{}", *r.levels) : "",
                                   name(r.claim.means),
                                   name(r.claim.order)};
    if (!r.proof) return cells;
    const MaskProof& p = *r.proof;
    cells.insert(cells.end(),
                 {orAny(p.depth), orAny(p.volumes), orNone(p.period), fmt::format("{}", p.choice.start),
                  usesHalfConstant(r.claim) ? fmt::format("{}", p.choice.half) : "-",
                  fmt::format("{}{}", shadowIsBright(r.claim.arithmetic) ? ">=" : "<", p.choice.threshold),
                  orNone(p.lightInShadow), orNone(p.darknessOutside)});
    for (const MaskProof::Drift& drift : p.drift) cells.push_back(range(drift));
    return cells;
}

const std::vector<std::string> kHead{
    "profile", "store", "format",   "bits",    "unit",    "evidence", "dither",         "arithmetic",
    "levels",  "by",    "order",    "depth",   "volumes", "period",   "start",          "half",
    "shadow",  "light", "darkness", "drift_1", "drift_8", "drift_64", "counterexample", "codes"};

/// Lit and shadow differ in every state of the cycle but the first.
bool isExactInItsCycle(const MaskProof& proof) {
    return proof.period && proof.depth == *proof.period - 1;
}

std::string reachOf(const std::optional<int>& depth, const std::optional<int>& volumes) {
    if (!depth) return "exact";
    if (*depth > 0) return fmt::format("up to {} open", *depth);
    if (volumes.value_or(1) > 0) return fmt::format("up to {} in all", *volumes);
    return "never";
}

std::string reachOf(const MaskProof& proof) {
    if (isExactInItsCycle(proof)) return fmt::format("exact modulo {}", *proof.period);
    return reachOf(proof.depth, proof.volumes);
}

/// ProofRows of one chip, store, arithmetic and means.
using ProofRows = std::vector<const ProofRow*>;

/// "up to 5 open in 5 bits, up to 6 open in 6 bits": of units of one width the one that reaches least.
std::string reachInWords(const ProofRows& rows) {
    std::map<int, const MaskProof*> worst;
    const auto reach = [](const MaskProof& p) {
        constexpr int kAny = std::numeric_limits<int>::max();
        return std::pair(p.depth.value_or(kAny), p.volumes.value_or(kAny));
    };
    for (const ProofRow* r : rows) {
        const MaskProof*& known = worst[r->claim.channel.bits];
        if (!known || reach(*r->proof) < reach(*known)) known = &*r->proof;
    }
    std::vector<std::pair<std::string, std::vector<int>>> texts;
    for (const auto& [bits, proof] : worst) {
        const std::string text = reachOf(*proof);
        if (texts.empty() || texts.back().first != text) texts.push_back({text, {}});
        texts.back().second.push_back(bits);
    }
    if (texts.size() == 1) return texts.front().first;
    std::vector<std::string> parts;
    for (const auto& [text, bits] : texts)
        parts.push_back(fmt::format("{} in {} bits", text, fmt::join(bits, " and ")));
    return fmt::format("{}", fmt::join(parts, ", "));
}

/// Whether the figures of @p row are shown: the best start's, unless there are only those of asked levels.
bool isShown(const ProofRow& row, const ProofRows& rows) {
    return !row.levels ||
           std::none_of(rows.begin(), rows.end(), [](const ProofRow* r) { return !r->levels; });
}

std::string halfInWords(const ProofRows& rows) {
    std::set<int> halves;
    bool notTheOther = false;
    for (const ProofRow* r : rows) {
        if (!usesHalfConstant(r->claim) || !isShown(*r, rows)) continue;
        halves.insert(r->proof->choice.half);
        notTheOther = notTheOther || r->proof->otherHalf;
    }
    if (halves.empty()) return "";
    const std::string not127 = halves.size() == 1 && notTheOther && halves.contains(128) ? ", not 127" : "";
    return fmt::format("half = {}{}", fmt::join(halves, " or "), not127);
}

std::string driftInWords(const ProofRows& rows) {
    MaskProof::Drift all;
    for (const ProofRow* r : rows)
        for (const MaskProof::Drift& drift : r->proof->drift) {
            if (drift.volumes < all.volumes) continue;
            if (drift.volumes > all.volumes) all = drift;
            all.lowest = std::min(all.lowest, drift.lowest);
            all.highest = std::max(all.highest, drift.highest);
        }
    if (all.lowest == 0 && all.highest == 0) return "no drift";
    return fmt::format("drifts by {} codes in {} volumes", range(all), all.volumes);
}

/// "1 up to 1 open, 2 to 5 exact", or "2 up to 32 in all, drifts by -64 codes in 64 volumes".
std::string levelsInWords(const ProofRows& rows) {
    std::map<int, ProofRows> byLevel;
    for (const ProofRow* r : rows) byLevel[*r->levels].push_back(r);
    struct Run {
        int first = 0, last = 0;
        std::string text{};
    };
    std::vector<Run> runs;
    for (const auto& [levels, ofLevel] : byLevel) {
        const std::string reach = reachInWords(ofLevel), drift = driftInWords(ofLevel);
        const std::string text = drift == "no drift" ? reach : fmt::format("{}, {}", reach, drift);
        if (runs.empty() || runs.back().text != text) runs.push_back({levels, levels, text});
        runs.back().last = levels;
    }
    std::vector<std::string> parts;
    for (const Run& run : runs)
        parts.push_back(run.first == run.last ? fmt::format("{}: {}", run.first, run.text)
                                              : fmt::format("{} to {}: {}", run.first, run.last, run.text));
    return fmt::format("{}", fmt::join(parts, "; "));
}

/// What one mode of dithering gives: a line for all orders, and for double one per width with its levels in
/// the first order.
std::string modeInWords(const std::string& mode, const ProofRows& rows, std::size_t width) {
    std::vector<std::string> parts;
    ProofRows first;
    std::map<int, ProofRows> levelsOfBits;
    for (int o = 0; o < kDrawOrders; ++o) {
        ProofRows ofOrder;
        for (const ProofRow* r : rows)
            if (r->claim.order == DrawOrder(o) && isShown(*r, rows)) ofOrder.push_back(r);
        if (ofOrder.empty()) continue;
        if (first.empty()) {
            first = ofOrder;
            for (const ProofRow* r : rows)
                if (r->claim.order == DrawOrder(o) && !isShown(*r, rows))
                    levelsOfBits[r->claim.channel.bits].push_back(r);
        }
        parts.push_back(fmt::format("{} {}", name(DrawOrder(o)), reachInWords(ofOrder)));
    }
    const std::string half = halfInWords(rows);
    const std::string head = fmt::format("{}{}{}", mode, mode.empty() || half.empty() ? "" : ", ", half);
    std::string text = "  " +
                       wrapText(fmt::format("{}{}{}; {}", head, head.empty() ? "" : ": ",
                                            fmt::join(parts, "; "), driftInWords(first)),
                                6, width) +
                       "\n";
    for (const auto& [bits, ofBits] : levelsOfBits)
        text += "    " +
                wrapText(fmt::format("{} bits, {} by levels: {}", bits, name(first.front()->claim.order),
                                     levelsInWords(ofBits)),
                         8, width) +
                "\n";
    return text;
}

/// One paragraph per chip, store, arithmetic and means: without dithering, and with the driver's default.
std::string inWords(const std::vector<ProofRow>& rows, std::size_t width) {
    std::vector<std::pair<std::string, ProofRows>> groups;
    for (const ProofRow& r : rows) {
        if (!r.proof) continue;
        // Units are what is known of one chip, but the PS2's two are a choice.
        const bool wraps = r.claim.channel.unit == BlendUnit::GsWrap;
        const std::string by = r.claim.means != MaskMeans::Blend ? fmt::format(" by {}", name(r.claim.means))
                               : wraps ? fmt::format(" by {}", name(BlendUnit::GsWrap))
                                       : "";
        const std::string about = fmt::format("{} {} {}{}", r.profile, r.store, name(r.claim.arithmetic), by);
        if (groups.empty() || groups.back().first != about) {
            const auto at = std::find_if(groups.begin(), groups.end(),
                                         [&](const auto& group) { return group.first == about; });
            if (at != groups.end()) {
                at->second.push_back(&r);
                continue;
            }
            groups.push_back({about, {}});
        }
        groups.back().second.push_back(&r);
    }
    std::string text;
    for (const auto& [about, all] : groups) {
        ProofRows off, byDefault;
        for (const ProofRow* r : all) {
            if (r->claim.channel.dither == DitherMode::Off) off.push_back(r);
            if (r->isDefaultDither && r->claim.channel.dither != DitherMode::Off) byDefault.push_back(r);
        }
        text += about + "\n";
        if (off.empty() && byDefault.empty())
            text +=
                modeInWords(fmt::format("dither {}", name(all.front()->claim.channel.dither)), all, width);
        if (!off.empty()) text += modeInWords(byDefault.empty() ? "" : "dither off", off, width);
        if (!byDefault.empty())
            text += modeInWords(
                fmt::format("dither {}, the driver's default", name(byDefault.front()->claim.channel.dither)),
                byDefault, width);
    }
    return text;
}

Json jsonOf(const std::optional<int>& value) {
    return value ? Json(*value) : Json();
}

Json jsonOf(const ProofRow& r) {
    Json row{{"profile", r.profile},
             {"store", r.store},
             {"format", r.format},
             {"bits", r.claim.channel.bits},
             {"unit", name(r.claim.channel.unit)},
             {"evidence", r.grade ? Json(name(*r.grade)) : Json()},
             {"dither", name(r.claim.channel.dither)},
             {"default_dither", r.isDefaultDither},
             {"arithmetic", name(r.claim.arithmetic)},
             {"levels", jsonOf(r.levels)},
             {"by", name(r.claim.means)},
             {"order", name(r.claim.order)}};
    if (!r.proof) {
        row["refused"] = r.refused;
        row["source"] = r.source;
        return row;
    }
    const MaskProof& p = *r.proof;
    row["depth"] = jsonOf(p.depth);
    row["volumes"] = jsonOf(p.volumes);
    row["period"] = jsonOf(p.period);
    row["verdict"] = verdictOf(r);
    row["start"] = p.choice.start;
    row["half"] = usesHalfConstant(r.claim) ? Json(p.choice.half) : Json();
    row["other_half"] = Json();
    if (p.otherHalf)
        row["other_half"] = {{"half", 255 - p.choice.half},
                             {"depth", jsonOf(p.otherHalf->depth)},
                             {"volumes", jsonOf(p.otherHalf->volumes)}};
    row["threshold"] = p.choice.threshold;
    row["shadow_is"] = shadowIsBright(r.claim.arithmetic) ? "at or above" : "below";
    row["light_in_shadow"] = jsonOf(p.lightInShadow);
    row["darkness_outside"] = jsonOf(p.darknessOutside);
    row["drift"] = Json::array();
    for (const MaskProof::Drift& d : p.drift)
        row["drift"].push_back({{"volumes", d.volumes}, {"lowest", d.lowest}, {"highest", d.highest}});
    row["counterexample"] = Json();
    if (const auto& c = p.counterexample)
        row["counterexample"] = {{"crossings", c->crossings}, {"codes", c->codes}, {"cell", c->cell}};
    return row;
}

}  // namespace

std::string verdictOf(const ProofRow& row) {
    if (!row.proof) return fmt::format("refused: {}", row.refused);
    const MaskProof& p = *row.proof;
    if (isExactInItsCycle(p))
        return fmt::format(
            "exact modulo {0}, in any order: wrong only where a multiple of {0} volumes are open", *p.period);
    std::string text = reachOf(p);
    if (!usesHalfConstant(row.claim)) return text;
    text += fmt::format(", half = {}", p.choice.half);
    if (p.otherHalf)
        text +=
            fmt::format(" ({}: {})", 255 - p.choice.half, reachOf(p.otherHalf->depth, p.otherHalf->volumes));
    return text;
}

std::string showProofs(const std::vector<ProofRow>& rows, const Page& page) {
    if (page.format == Format::Json) {
        Json all = Json::array();
        for (const ProofRow& row : rows) all.push_back(jsonOf(row));
        return all.dump(2) + "\n";
    }
    if (page.format == Format::Csv) {
        std::vector<std::string> head = kHead;
        head.insert(head.end(), {"refused", "source"});
        std::string text = csvLine(head);
        for (const ProofRow& r : rows) {
            std::vector<std::string> cells = cellsOf(r);
            cells.resize(kHead.size());
            if (r.proof && r.proof->counterexample) {
                cells[kHead.size() - 2] = r.proof->counterexample->crossings;
                cells[kHead.size() - 1] = fmt::format("{}", fmt::join(r.proof->counterexample->codes, " "));
            }
            cells.insert(cells.end(), {r.refused, r.source});
            text += csvLine(cells);
        }
        return text;
    }

    std::vector<std::vector<std::string>> table{kHead};
    std::string refusals;
    ProofRows proved;
    for (const ProofRow& r : rows)
        if (r.proof && r.claim.arithmetic == MaskArithmetic::Double) proved.push_back(&r);
    for (const ProofRow& r : rows) {
        if (r.proof && !isShown(r, proved)) continue;
        if (!r.proof) {
            const std::string line =
                wrapText(fmt::format("{} {} {}: refused, the chip lacks {} [{}]", r.profile, r.store,
                                     name(r.claim.arithmetic), r.refused, r.source),
                         2, page.width) +
                "\n";
            // Every order is refused alike.
            if (refusals.find(line) == std::string::npos) refusals += line;
            continue;
        }
        std::vector<std::string> cells = cellsOf(r);
        const auto& wrong = r.proof->counterexample;
        cells.push_back(wrong ? shortened(wrong->crossings) : "-");
        cells.push_back(wrong ? shortened(wrong->codes) : "");
        table.push_back(cells);
    }
    std::string text = inWords(rows, page.width);
    if (table.size() > 1) {
        const auto paragraph = [&](const char* words) {
            return fmt::format("{}\n", wrapText(words, 2, page.width));
        };
        text += "\n";
        text += paragraph(
            "exact: right for any number of volumes; up to N open: with no more of them open at a time; up "
            "to N "
            "in all: with no more of them on a ray; exact modulo N: in any order, but where a multiple of N "
            "are "
            "open. double is from the best start, and by levels from 2^-levels. The figures, of the best "
            "starts:");
        text += fmt::format("\n{}\n", alignColumns(table, page.width));
        for (const char* words :
             {"Every pixel is right with up to \"depth\" volumes open at one time, however many there are; "
              "and "
              "with up to \"volumes\" on its ray, however they overlap.",
              "period: the code depends on the open volumes alone, in any order, and so many make the start "
              "again. Codes are those of the channel.",
              "by: add_wrap are sums that keep their low bits, logic_op is the operation Invert; blend "
              "clamps.",
              "order: volume is one convex volume after the other, fronts, then backs; fronts-first is all "
              "fronts, then all backs; per-triangle is any order; nearer-only is zfail where no farther "
              "fragment "
              "passes.",
              "start, half, shadow: the best choice of the mask's first code, of the constant for 1/2, of a "
              "threshold. D is a front face, H a back face of a volume. shadow: the codes that are taken for "
              "shadow.",
              "light, darkness: what normalisation by blending leaves of light in a shadow and of darkness "
              "outside; where it is much, the mask needs a test of its value, or a table, instead.",
              "drift_N: a lit pixel's code after N volumes one after the other, less the start."})
            text += paragraph(words);
    }
    return refusals.empty() ? text : text + (text.empty() ? "" : "\n") + refusals;
}

}  // namespace gnomon
