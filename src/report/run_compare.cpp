#include "report/run_compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "report/run_json.h"
#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kShownCells = 4;

/// Keys in which two runs may differ although nothing else has changed.
const std::set<std::string>& timeKeys() {
    static const std::set<std::string> keys{"cpu_ms", "unshadowed_ms", "clock", "device"};
    return keys;
}

/// What differs, on either side; a key that one side lacks is null there.
std::pair<Json, Json> differences(const Cell& before, const Cell& after) {
    Json a = Json::object(), b = Json::object();
    const auto old = flatCell(before), now = flatCell(after);
    const auto valueIn = [](const auto& flat, const std::string& key) {
        const auto at = std::find_if(flat.begin(), flat.end(), [&](const auto& e) { return e.first == key; });
        return at == flat.end() ? Json() : at->second;
    };
    for (const auto& [key, value] : old)
        if (!timeKeys().contains(key))
            if (Json other = valueIn(now, key); other != value) a[key] = value, b[key] = std::move(other);
    for (const auto& [key, value] : now)
        if (!timeKeys().contains(key) && valueIn(old, key).is_null() && !value.is_null())
            a[key] = nullptr, b[key] = value;
    return {a, b};
}

/// "mask clamps, own cap and side within a few depth quanta"; "none".
std::string causeNames(const Cell& cell) {
    std::vector<std::string> names;
    for (const auto& cause : cell.causes) names.push_back(cause.first);
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

std::string limitNames(const Cell& cell) {
    std::vector<std::string> names;
    for (const Missing& m : cell.missing) names.push_back(m.what);
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

std::string passesText(const Cell& cell) {
    const PassCounts& p = cell.passes;
    return fmt::format("{}/{}/{}/{}", p.scene, p.volume, p.rectangle, p.copy);
}

/// How grave a change is, from 0, and its name.
std::pair<int, std::string> causeOf(const Cell& a, const Cell& b, const Json& differs) {
    const auto change = [](const char* what, const std::string& old, const std::string& now) {
        return fmt::format("{}: {} -> {}", what, old, now);
    };
    const int before = a.wrongEdge + a.wrongInterior, after = b.wrongEdge + b.wrongInterior;
    if (a.verdict != b.verdict) {
        const std::string verdicts = change("verdict", name(a.verdict), name(b.verdict));
        // What made it wrong, or has gone that did.
        const Cell& worse = after >= before ? b : a;
        return {0, worse.causes.empty() ? verdicts : fmt::format("{} ({})", verdicts, causeNames(worse))};
    }
    if (a.error != b.error) return {1, "failed otherwise"};
    if (a.missing != b.missing) {
        const std::string old = limitNames(a), now = limitNames(b);
        return {2, old == now ? "sources of limits" : change("limits", old, now)};
    }
    if (before != after) return {3, after > before ? "more wrong pixels" : "fewer wrong pixels"};
    if (a.wrongEdge != b.wrongEdge) return {4, "wrong pixels elsewhere"};
    if (causeNames(a) != causeNames(b)) return {5, change("causes", causeNames(a), causeNames(b))};
    if (a.causes != b.causes) return {6, "causes of other numbers of pixels"};
    if (a.unpredicted != b.unpredicted) return {7, "unpredicted pixels"};
    if (!(a.passes == b.passes)) return {8, change("passes", passesText(a), passesText(b))};
    if (a.digest != b.digest) return {9, "picture or mask, as right as before"};
    if (a.tiedTruth != b.tiedTruth || a.tiedCount != b.tiedCount) return {10, "tied pixels"};
    std::vector<std::string> keys;
    for (const auto& [key, value] : differs.items()) keys.push_back(key.substr(0, key.find('.')));
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return {11, fmt::format("other {}", fmt::join(keys, ", "))};
}

/// "exact, 0 wrong", for a cell that stands in one run only.
Json wholeOf(const Cell& cell) {
    Json json = Json::object();
    for (const auto& [key, value] : flatCell(cell)) json[key] = value;
    return json;
}

std::string plain(const Json& value) {
    return value.is_null() ? "" : value.is_string() ? std::string(value) : value.dump();
}

/// A value for people: what a chip lacks and why pixels are wrong in words.
std::string words(const std::string& key, const Json& value) {
    std::vector<std::string> parts;
    if (key == "missing" && value.is_array())
        for (const Json& m : value) parts.push_back(fmt::format("{}", plain(m.at("what"))));
    else if (key == "causes" && value.is_object())
        for (const auto& [cause, pixels] : value.items())
            parts.push_back(fmt::format("{} ({})", cause, plain(pixels)));
    else
        return value.is_null()     ? "none"
               : value.is_string() ? fmt::format("\"{}\"", plain(value))
                                   : plain(value);
    return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

/// What was asked of a cell besides what its id has, where it is not the default: "; fidelity chip".
std::string choicesOf(const Json& cell) {
    const Json usual = wholeOf(Cell{});
    std::string text;
    for (const char* key : {"shade", "fidelity", "dither", "blend_unit", "effects", "view"})
        if (cell.contains(key) && (!usual.contains(key) || cell.at(key) != usual.at(key)))
            text += fmt::format("; {} {}", key, plain(cell.at(key)));
    return text;
}

std::string changeText(const CellChange& change) {
    if (change.before.is_null() || change.after.is_null()) {
        const Json& cell = change.before.is_null() ? change.after : change.before;
        return fmt::format("{}: {}{}", change.cell, plain(cell.at("verdict")), choicesOf(cell));
    }
    std::vector<std::string> parts;
    for (const auto& [key, old] : change.before.items())
        parts.push_back(fmt::format("{} {} -> {}", key, words(key, old), words(key, change.after.at(key))));
    return fmt::format("{}: {}", change.cell, fmt::join(parts, "; "));
}

std::string changesText(const std::vector<ChangeGroup>& groups, std::size_t before, std::size_t after,
                        std::size_t width) {
    std::size_t all = 0;
    for (const ChangeGroup& group : groups) all += group.cells.size();
    std::string text = fmt::format("{} cells before, {} after: ", before, after);
    text += all == 0 ? "no answer has changed\n" : fmt::format("{} differ\n", all);
    for (const ChangeGroup& group : groups) {
        const std::size_t count = group.cells.size();
        text += fmt::format(
            "\n{}\n",
            wrapText(fmt::format("{} ({} cell{})", group.cause, count, count == 1 ? "" : "s"), 2, width));
        for (std::size_t i = 0; i < std::min(count, kShownCells); ++i)
            text += fmt::format("  {}\n", wrapText(changeText(group.cells[i]), 4, width));
        if (count > kShownCells) text += fmt::format("  and {} more\n", count - kShownCells);
    }
    return text;
}

/// A row of each value that differs; a cell of one run only has one, with its verdict.
std::string changesCsv(const std::vector<ChangeGroup>& groups) {
    std::string text = csvLine({"cause", "cell", "key", "old", "new"});
    for (const ChangeGroup& group : groups)
        for (const CellChange& change : group.cells) {
            if (change.before.is_null() || change.after.is_null()) {
                const auto verdict = [](const Json& cell) {
                    return cell.is_null() ? "" : plain(cell.at("verdict"));
                };
                text += csvLine(
                    {group.cause, change.cell, "verdict", verdict(change.before), verdict(change.after)});
                continue;
            }
            for (const auto& [key, old] : change.before.items())
                text += csvLine({group.cause, change.cell, key, plain(old), plain(change.after.at(key))});
        }
    return text;
}

}  // namespace

std::vector<ChangeGroup> changesBetween(const std::vector<Cell>& before, const std::vector<Cell>& after) {
    std::map<std::string, const Cell*> known;
    for (const Cell& cell : before) known.emplace(cell.question(), &cell);
    std::map<std::pair<int, std::string>, std::vector<CellChange>> groups;
    for (const Cell& cell : after) {
        const auto at = known.find(cell.question());
        if (at == known.end()) {
            groups[{13, "only in the new run"}].push_back({cell.id(), nullptr, wholeOf(cell)});
            continue;
        }
        const Cell& old = *at->second;
        known.erase(at);
        auto [a, b] = differences(old, cell);
        if (a.empty()) continue;
        const auto cause = causeOf(old, cell, a);
        groups[cause].push_back({cell.id(), std::move(a), std::move(b)});
    }
    for (const Cell& cell : before)
        if (known.contains(cell.question()))
            groups[{12, "only in the old run"}].push_back({cell.id(), wholeOf(cell), nullptr});
    std::vector<ChangeGroup> list;
    for (auto& [cause, cells] : groups) list.push_back({cause.second, std::move(cells)});
    return list;
}

std::string showChanges(const std::vector<ChangeGroup>& groups, std::size_t cellsBefore,
                        std::size_t cellsAfter, const Page& page) {
    if (page.format == Format::Csv) return changesCsv(groups);
    if (page.format == Format::Text) return changesText(groups, cellsBefore, cellsAfter, page.width);
    const Json json{{"old", {{"cells", cellsBefore}}},
                    {"new", {{"cells", cellsAfter}}},
                    {"changes", changesJson(groups)}};
    return json.dump(2) + "\n";
}

Json changesJson(const std::vector<ChangeGroup>& groups) {
    Json list = Json::array();
    for (const ChangeGroup& group : groups) {
        Json cells = Json::array();
        for (const CellChange& change : group.cells)
            cells.push_back({{"cell", change.cell}, {"old", change.before}, {"new", change.after}});
        list.push_back({{"cause", group.cause}, {"cells", cells}});
    }
    return list;
}

}  // namespace gnomon
