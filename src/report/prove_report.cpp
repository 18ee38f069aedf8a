#include "report/prove_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

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

bool shadowIsBright(MaskArithmetic arithmetic) {
    return arithmetic == MaskArithmetic::Double || arithmetic == MaskArithmetic::Count;
}

/// Whether a constant for 1/2 is part of the choice.
bool usesHalf(const MaskClaim& claim) {
    return takesHalfConstant(claim.channel.unit) &&
           (claim.arithmetic == MaskArithmetic::Double || claim.arithmetic == MaskArithmetic::Halve);
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
                                   name(r.claim.order)};
    if (!r.proof) return cells;
    const MaskProof& p = *r.proof;
    cells.insert(cells.end(),
                 {orAny(p.depth), orAny(p.volumes), fmt::format("{}", p.choice.start),
                  usesHalf(r.claim) ? fmt::format("{}", p.choice.half) : "-",
                  fmt::format("{}{}", shadowIsBright(r.claim.arithmetic) ? ">=" : "<", p.choice.threshold),
                  orNone(p.lightInShadow), orNone(p.darknessOutside)});
    for (const MaskProof::Drift& drift : p.drift) cells.push_back(range(drift));
    return cells;
}

const std::vector<std::string> kHead{
    "profile",    "store",    "format",  "bits",    "unit",     "evidence",       "dither",
    "arithmetic", "order",    "depth",   "volumes", "start",    "half",           "shadow",
    "light",      "darkness", "drift_1", "drift_8", "drift_64", "counterexample", "codes"};

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
             {"arithmetic", name(r.claim.arithmetic)},
             {"order", name(r.claim.order)}};
    if (!r.proof) {
        row["refused"] = r.refused;
        row["source"] = r.source;
        return row;
    }
    const MaskProof& p = *r.proof;
    row["depth"] = jsonOf(p.depth);
    row["volumes"] = jsonOf(p.volumes);
    row["start"] = p.choice.start;
    row["half"] = usesHalf(r.claim) ? Json(p.choice.half) : Json();
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

std::string showProofs(const std::vector<ProofRow>& rows, Format format) {
    if (format == Format::Json) {
        Json all = Json::array();
        for (const ProofRow& row : rows) all.push_back(jsonOf(row));
        return all.dump(2) + "\n";
    }
    if (format == Format::Csv) {
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
    for (const ProofRow& r : rows) {
        if (!r.proof) {
            const std::string line =
                wrapText(fmt::format("{} {} {}: refused, the chip lacks {} [{}]", r.profile, r.store,
                                     name(r.claim.arithmetic), r.refused, r.source),
                         2) +
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
    std::string text;
    if (table.size() > 1)
        text =
            alignColumns(table) +
            "\nEvery pixel is right with up to \"depth\" volumes open at one time, however many there are;\n"
            "and with up to \"volumes\" on its ray, however they overlap. Codes are those of the channel.\n"
            "D is a front face, H a back face of a volume. shadow: the codes that are taken for shadow.\n"
            "light, darkness: what normalisation by blending leaves of light in a shadow and of darkness\n"
            "outside; where it is much, the mask needs a test of its value, or a table, instead.\n"
            "drift_N: a lit pixel's code after N volumes one after the other, less the start.\n";
    return refusals.empty() ? text : text + (text.empty() ? "" : "\n") + refusals;
}

}  // namespace gnomon
