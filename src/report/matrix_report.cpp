#include "report/matrix_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

#include "matrix/cell_json.h"
#include "report/device_listing.h"
#include "report/table.h"
#include "report/verdict_colour.h"

namespace gnomon {
namespace {

/// Values in the order in which they first came, each once.
template <class T>
void addOnce(std::vector<T>& list, const T& value) {
    if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

/// "a", "b", ..., "z", "aa", ...
std::string letterOf(std::size_t index) {
    std::string letters;
    for (++index; index > 0; index = (index - 1) / 26)
        letters = fmt::format("{}{}", char('a' + (index - 1) % 26), letters);
    return letters;
}

/// @p chips, some of @p all of a table; the others where they are fewer by far.
std::string chipsText(const std::vector<std::string>& chips, const std::vector<std::string>& all) {
    std::vector<std::string> others;
    for (const std::string& chip : all)
        if (std::find(chips.begin(), chips.end(), chip) == chips.end()) others.push_back(chip);
    if (chips.size() < 4 * others.size() || all.size() < 5) return fmt::format("{}", fmt::join(chips, " "));
    return others.empty() ? "all" : fmt::format("all but {}", fmt::join(others, " "));
}

/// The row of the table. The shade is no part of a method's name: where several run, the row says which.
std::string rowOf(const Cell& cell) {
    if (cell.axes.shade == Shade::Attenuated) return cell.method;
    return fmt::format("{} {}", cell.method, name(cell.axes.shade));
}

/// All frames of one method on one chip.
struct Entry {
    Verdict verdict = Verdict::Exact;
    bool chosen = false;
    int wrong = 0;
    PassCounts passes{};
    std::vector<Missing> missing{};
    std::map<std::string, int> causes{};
    std::string error{};
};

Entry merge(const std::vector<const Cell*>& cells) {
    Entry entry;
    for (const Cell* cell : cells) {
        entry.verdict = std::max(entry.verdict, cell->verdict);
        entry.chosen = entry.chosen || cell->chosen;
        entry.wrong += cell->wrongEdge + cell->wrongInterior;
        entry.passes = cell->passes;
        for (const Missing& m : cell->missing) addOnce(entry.missing, m);
        for (const auto& [cause, pixels] : cell->causes) entry.causes[cause] += pixels;
        if (!cell->error.empty()) entry.error = cell->error;
    }
    return entry;
}

/// Footnotes, lettered in the order in which they are first used; each with the chips that it holds for, by
/// source.
class Notes {
  public:
    std::string letter(const std::string& note, const std::string& source, const std::string& profile) {
        const auto found =
            std::find_if(m_notes.begin(), m_notes.end(), [&](const Note& n) { return n.text == note; });
        const auto at = std::size_t(found - m_notes.begin());
        if (found == m_notes.end()) m_notes.push_back({note, {}});
        auto& chips = m_notes[at].chips;
        auto ofSource =
            std::find_if(chips.begin(), chips.end(), [&](const auto& c) { return c.first == source; });
        if (ofSource == chips.end()) ofSource = chips.insert(chips.end(), {source, {}});
        addOnce(ofSource->second, profile);
        return letterOf(at);
    }
    /// @param all  the chips of the table
    std::string text(const std::vector<std::string>& all, std::size_t width) const {
        std::string out;
        for (std::size_t i = 0; i < m_notes.size(); ++i) {
            out += fmt::format("  {:<3}{}\n", letterOf(i), wrapText(m_notes[i].text, 5, width));
            for (const auto& [source, chips] : m_notes[i].chips)
                out += fmt::format("       {}\n",
                                   wrapText(fmt::format("{}: {}", chipsText(chips, all), source), 9, width));
        }
        return out;
    }

  private:
    struct Note {
        std::string text{};
        std::vector<std::pair<std::string, std::vector<std::string>>> chips{};  ///< source, chips
    };
    std::vector<Note> m_notes{};
};

std::string cellText(const Entry& e, const std::string& profile, Notes& notes, bool colours) {
    const auto word = [&](const char* text) { return inColour(text, e.verdict, colours); };
    const std::string passes =
        fmt::format(" {}/{}{}", e.passes.scene, e.passes.rectangle, e.chosen ? "*" : "");
    switch (e.verdict) {
        case Verdict::Exact:
            return word("exact") + passes;
        case Verdict::Edge:
            return fmt::format("{} {}{}", word("edge"), e.wrong, passes);
        case Verdict::Wrong:
            return fmt::format("{} {}{}", word("WRONG"), e.wrong, passes);
        case Verdict::Refused:
            break;
        case Verdict::Failed:
            return fmt::format("{} {}", word("FAILED"), notes.letter(e.error, "failed", profile));
    }
    std::vector<std::string> letters;
    for (const Missing& m : e.missing) letters.push_back(notes.letter(m.what, m.source, profile));
    std::sort(letters.begin(), letters.end(),
              [](const auto& a, const auto& b) { return std::pair(a.size(), a) < std::pair(b.size(), b); });
    return inColour(fmt::format("- {}", fmt::join(letters, ",")), e.verdict, colours);
}

/// A column of the table: chips that have the same entry in every row.
struct MatrixColumn {
    std::vector<std::string> chips{};
    std::vector<std::string> entries{};  ///< a row each

    /// "voodoo1", or "voodoo1 +3" for four chips.
    std::string head() const {
        return chips.size() == 1 ? chips[0] : fmt::format("{} +{}", chips[0], chips.size() - 1);
    }
};

/// Folds equal columns; each stands where its first chip stood.
std::vector<MatrixColumn> folded(const std::vector<MatrixColumn>& columns) {
    std::vector<MatrixColumn> groups;
    for (const MatrixColumn& column : columns) {
        const auto equal = std::find_if(groups.begin(), groups.end(),
                                        [&](const MatrixColumn& g) { return g.entries == column.entries; });
        if (equal == groups.end())
            groups.push_back(column);
        else
            equal->chips.insert(equal->chips.end(), column.chips.begin(), column.chips.end());
    }
    return groups;
}

/// @p chips by the heads of their columns, where all chips of a column are meant.
std::string headsText(const std::vector<std::string>& chips, const std::vector<MatrixColumn>& columns) {
    const auto isMeant = [&](const std::string& chip) {
        return std::find(chips.begin(), chips.end(), chip) != chips.end();
    };
    std::vector<std::string> words;
    for (const MatrixColumn& column : columns) {
        if (std::all_of(column.chips.begin(), column.chips.end(), isMeant))
            words.push_back(column.head());
        else
            std::copy_if(column.chips.begin(), column.chips.end(), std::back_inserter(words), isMeant);
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

/// The columns behind one of row heads, in as many blocks of at most @p widest columns of text as they need.
std::string blocksOf(const std::vector<std::string>& methods, const std::vector<MatrixColumn>& columns,
                     std::size_t widest) {
    std::size_t headWidth = std::string("method").size();
    for (const std::string& method : methods) headWidth = std::max(headWidth, method.size());

    std::string text;
    for (std::size_t at = 0; at < columns.size();) {
        std::vector<std::vector<std::string>> rows{{"method"}};
        for (const std::string& method : methods) rows.push_back({method});
        for (std::size_t width = headWidth; at < columns.size(); ++at) {
            std::size_t column = textWidth(columns[at].head());
            for (const std::string& entry : columns[at].entries) column = std::max(column, textWidth(entry));
            width += 2 + column;
            if (width > widest && rows[0].size() > 1) break;
            rows[0].push_back(columns[at].head());
            for (std::size_t r = 0; r < methods.size(); ++r) rows[r + 1].push_back(columns[at].entries[r]);
        }
        text += fmt::format("{}{}", text.empty() ? "" : "\n", alignColumns(rows, std::string::npos));
    }
    return text;
}

/// Where volumes may nest deeper than methods can count: a line for each warning, with the methods, chips and
/// frames of which not all are meant. Of warnings that differ only in how deep, the deepest.
std::string warningsOf(const std::vector<const Cell*>& cells, const std::vector<std::string>& methods,
                       const std::vector<MatrixColumn>& columns, const std::vector<int>& frames,
                       std::size_t width) {
    struct Line {
        std::string text{};
        std::vector<std::string> methods{}, chips{};
        std::vector<int> frames{};
    };
    std::vector<Line> lines;
    for (const std::string& method : methods) {
        std::map<std::string, Line> byLimit;
        std::vector<std::string> drawn;
        for (const Cell* cell : cells) {
            if (rowOf(*cell) != method) continue;
            if (cell->missing.empty()) addOnce(drawn, cell->profile);
            for (const std::string& warning : cell->warnings) {
                Line& line = byLimit[warning.substr(0, warning.find(';'))];
                if (std::pair(line.text.size(), line.text) < std::pair(warning.size(), warning))
                    line.text = warning;
                addOnce(line.chips, cell->profile);
                addOnce(line.frames, cell->frame);
            }
        }
        for (auto& limited : byLimit) {
            Line& line = limited.second;
            if (line.chips.size() == drawn.size()) line.chips.clear();  // all
            const auto same = std::find_if(lines.begin(), lines.end(), [&](const Line& other) {
                return other.text == line.text && other.chips == line.chips && other.frames == line.frames;
            });
            if (same == lines.end())
                lines.push_back({line.text, {method}, line.chips, line.frames});
            else
                same->methods.push_back(method);
        }
    }
    std::string text;
    for (const Line& line : lines) {
        std::vector<std::string> where;
        if (line.frames.size() < frames.size())
            where.push_back(
                fmt::format("frame{} {}", line.frames.size() > 1 ? "s" : "", fmt::join(line.frames, " ")));
        if (!line.chips.empty()) where.push_back(headsText(line.chips, columns));
        const std::string at = where.empty() ? "" : fmt::format(" ({})", fmt::join(where, "; "));
        text += fmt::format(
            "  {}\n",
            wrapText(fmt::format("{}: {}{}", fmt::join(line.methods, ", "), line.text, at), 5, width));
    }
    return text.empty() ? text : "\nVolumes may nest too deep\n" + text;
}

/// What automatic methods draw: a line for each method and how sure it is, with the chips and frames of which
/// not all are meant.
std::string choicesOf(const std::vector<const Cell*>& cells, const std::vector<MatrixColumn>& columns,
                      const std::vector<int>& frames, std::size_t width) {
    struct Line {
        std::string text{};
        std::vector<std::string> chips{};
        std::vector<int> frames{};
    };
    std::vector<Line> lines;
    for (const Cell* cell : cells) {
        if (cell->drawnBy.empty() || cell->verdict == Verdict::Refused) continue;
        const std::string sure = cell->proof == Proof::None ? ": no method is exact, this is the least wrong"
                                 : cell->proof == Proof::Drawn ? ": exact as drawn, not proved"
                                                               : "";
        const std::string text = fmt::format("{}: {}{}", rowOf(*cell), cell->drawnBy, sure);
        auto line = std::find_if(lines.begin(), lines.end(), [&](const Line& l) { return l.text == text; });
        if (line == lines.end()) line = lines.insert(lines.end(), {text, {}, {}});
        addOnce(line->chips, cell->profile);
        addOnce(line->frames, cell->frame);
    }
    std::string text;
    for (Line& line : lines) {
        std::sort(line.frames.begin(), line.frames.end());
        const std::string when =
            line.frames.size() < frames.size()
                ? fmt::format("frame{} {}; ", line.frames.size() > 1 ? "s" : "", fmt::join(line.frames, " "))
                : "";
        text += fmt::format(
            "  {}\n",
            wrapText(fmt::format("{} ({}{})", line.text, when, headsText(line.chips, columns)), 5, width));
    }
    return text.empty() ? text : "\nMethods that were chosen\n" + text;
}

/// One table with its legend and causes; what is refused or failed goes into @p notes.
std::string tableOf(const std::vector<const Cell*>& cells, Notes& notes, const Page& page) {
    std::vector<std::string> profiles, methods;
    std::vector<int> frames;
    std::map<std::pair<std::string, std::string>, std::vector<const Cell*>> entries;
    for (const Cell* cell : cells) {
        const std::string row = rowOf(*cell);
        addOnce(profiles, cell->profile);
        addOnce(methods, row);
        addOnce(frames, cell->frame);
        entries[{row, cell->profile}].push_back(cell);
    }

    std::vector<MatrixColumn> columns;
    for (const std::string& profile : profiles) columns.push_back({{profile}, {}});
    std::vector<std::pair<std::string, std::vector<std::string>>> causes;  // what, chips
    for (const std::string& method : methods) {
        std::map<std::string, std::vector<std::string>> causesHere;  // cause -> chips
        for (std::size_t i = 0; i < profiles.size(); ++i) {
            const Entry entry = merge(entries[{method, profiles[i]}]);
            columns[i].entries.push_back(cellText(entry, profiles[i], notes, page.colours));
            for (const auto& [cause, pixels] : entry.causes)
                causesHere[fmt::format("{}: {}", cause, pixels)].push_back(profiles[i]);
        }
        for (const auto& [cause, where] : causesHere)
            causes.emplace_back(fmt::format("{}: {}", method, cause), where);
    }
    const std::vector<MatrixColumn> groups = folded(columns);

    std::string text = fmt::format("{}, {}x{}, frame{} {}{}{}", cells[0]->scene, cells[0]->width,
                                   cells[0]->height, frames.size() > 1 ? "s" : "", fmt::join(frames, " "),
                                   cells[0]->fidelity == "chip" ? ", with the chips' own arithmetic" : "",
                                   deviceText(cells[0]->device));
    text = wrapText(text, 2, page.width) + "\n\n";
    text += blocksOf(methods, groups, page.width);
    std::string legend;
    for (const MatrixColumn& group : groups)
        if (group.chips.size() > 1)
            legend += fmt::format(
                "  {}\n",
                wrapText(fmt::format("{}: {}", group.head(), fmt::join(group.chips, " ")), 5, page.width));
    if (!legend.empty()) text += "\nChips that are alike in every row\n" + legend;
    if (!causes.empty()) text += "\nWrong pixels by cause\n";
    for (const auto& [cause, where] : causes)
        text += fmt::format("  {}\n",
                            wrapText(fmt::format("{} ({})", cause, headsText(where, groups)), 5, page.width));
    text += choicesOf(cells, groups, frames, page.width);
    text += warningsOf(cells, methods, groups, frames, page.width);
    return text;
}

/// Whether masks are as predicted; where not, which.
std::string predictionText(const std::vector<Cell>& cells, std::size_t width) {
    int drawn = 0, unpredicted = 0;
    std::vector<std::string> where;
    for (const Cell& cell : cells) {
        if (cell.verdict == Verdict::Refused || cell.verdict == Verdict::Failed) continue;
        ++drawn;
        unpredicted += cell.unpredicted;
        if (cell.unpredicted > 0) where.push_back(fmt::format("{} ({})", cell.id(), cell.unpredicted));
    }
    if (drawn == 0) return {};
    if (unpredicted == 0)
        return wrapText("Every untied pixel of every mask holds what exact arithmetic predicts.", 0, width) +
               "\n\n";
    constexpr std::size_t kMost = 8;
    const std::size_t all = where.size();
    if (all > kMost) where.resize(kMost);
    return wrapText(
               fmt::format("UNPREDICTED: {} untied pixels hold what exact arithmetic does not allow, in {} "
                           "of {} masks: {}{}",
                           unpredicted, all, drawn, fmt::join(where, ", "), all > kMost ? ", ..." : ""),
               2, width) +
           "\n\n";
}

}  // namespace

std::string matrixText(const std::vector<Cell>& cells, const Page& page) {
    std::vector<std::tuple<std::string, int, int, std::string>> keys;
    std::map<std::tuple<std::string, int, int, std::string>, std::vector<const Cell*>> tables;
    std::vector<std::string> profiles;
    for (const Cell& cell : cells) {
        const std::tuple key(cell.scene, cell.width, cell.height, cell.fidelity);
        addOnce(keys, key);
        tables[key].push_back(&cell);
        addOnce(profiles, cell.profile);
    }
    std::string text;
    Notes notes;
    for (const auto& key : keys) text += tableOf(tables[key], notes, page) + "\n";
    const std::string noteText = notes.text(profiles, page.width);
    if (!noteText.empty()) text += fmt::format("Notes: refused for want of\n{}\n", noteText);
    text += predictionText(cells, page.width);
    return text +
           wrapText(
               "exact: every untied pixel is as exact ray tracing says; edge, WRONG: wrong pixels in all "
               "frames, at the boundary of shadows or away from it; 2/3: scene passes / full-window "
               "rectangles; *: the path that gnomon takes on this chip; -: refused.",
               0, page.width) +
           "\n";
}

std::string matrixJson(const std::vector<Cell>& cells) {
    std::string text = "[";
    for (std::size_t i = 0; i < cells.size(); ++i)
        text += fmt::format("{}{}", i ? ",\n " : "", toJson(cells[i]).dump());
    return text + "]\n";
}

std::string matrixCsv(const std::vector<Cell>& cells) {
    std::string text = csvLine({"cell",
                                "profile",
                                "method",
                                "scene",
                                "store",
                                "arithmetic",
                                "levels",
                                "count",
                                "silhouette",
                                "mask_scale",
                                "apply",
                                "shade",
                                "width",
                                "height",
                                "frame",
                                "lights",
                                "fidelity",
                                "device",
                                "verdict",
                                "chosen",
                                "missing",
                                "causes",
                                "passes_scene",
                                "passes_volume",
                                "passes_rectangle",
                                "passes_copy",
                                "pixels",
                                "tied_truth",
                                "tied_count",
                                "wrong_edge",
                                "wrong_interior",
                                "unpredicted",
                                "nesting_fronts",
                                "nesting_overlap",
                                "nesting_levels",
                                "warnings",
                                "effects",
                                "drawn_by",
                                "proof",
                                "touched_pixels",
                                "vertices",
                                "clock",
                                "cpu_ms",
                                "unshadowed_ms",
                                "digest",
                                "error",
                                "missing_sources",
                                "touched_clear",
                                "touched_scene",
                                "touched_volume",
                                "touched_rectangle",
                                "touched_copy",
                                "start",
                                "overflow",
                                "caps",
                                "clip",
                                "offset",
                                "map_size",
                                "map_bias",
                                "dither",
                                "blend_unit",
                                "view"});
    for (const Cell& c : cells) {
        std::vector<std::string> missing, sources, causes, view;
        for (const Missing& m : c.missing) missing.push_back(m.what);
        for (const Missing& m : c.missing) sources.push_back(fmt::format("{}: {}", m.key, m.source));
        for (const auto& [flag, value] : c.view) view.push_back(fmt::format("--{} {}", flag, value));
        for (const auto& [cause, pixels] : c.causes) causes.push_back(fmt::format("{} {}", cause, pixels));
        const auto number = [](auto value) { return fmt::format("{}", value); };
        const bool isMap = c.axes.store == Store::DepthMap;
        text += csvLine({c.id(),
                         c.profile,
                         c.method,
                         c.scene,
                         name(c.axes.store),
                         name(c.axes.arithmetic),
                         c.axes.arithmetic == Arithmetic::Double ? number(c.axes.levels) : "",
                         name(c.axes.count),
                         name(c.axes.silhouette),
                         number(1.0 / c.axes.maskDivisor),
                         name(c.axes.apply),
                         name(c.axes.shade),
                         number(c.width),
                         number(c.height),
                         number(c.frame),
                         number(c.lights),
                         c.fidelity,
                         c.device,
                         name(c.verdict),
                         c.chosen ? "true" : "false",
                         fmt::format("{}", fmt::join(missing, "; ")),
                         fmt::format("{}", fmt::join(causes, "; ")),
                         number(c.passes.scene),
                         number(c.passes.volume),
                         number(c.passes.rectangle),
                         number(c.passes.copy),
                         number(c.pixels),
                         number(c.tiedTruth),
                         number(c.tiedCount),
                         number(c.wrongEdge),
                         number(c.wrongInterior),
                         number(c.unpredicted),
                         number(c.nesting.fronts),
                         number(c.nesting.overlap),
                         number(c.nesting.levels),
                         fmt::format("{}", fmt::join(c.warnings, "; ")),
                         toString(c.effects),
                         c.drawnBy,
                         c.drawnBy.empty() ? "" : name(c.proof),
                         number(c.touched.total()),
                         number(c.vertices),
                         c.clock,
                         fmt::format("{:.3f}", c.cpuMs),
                         fmt::format("{:.3f}", c.unshadowedMs),
                         c.digest,
                         c.error,
                         fmt::format("{}", fmt::join(sources, "; ")),
                         number(c.touched.clear),
                         number(c.touched.scene),
                         number(c.touched.volume),
                         number(c.touched.rectangle),
                         number(c.touched.copy),
                         name(c.axes.start),
                         name(c.axes.overflow),
                         name(c.axes.capFaces),
                         name(c.axes.clip),
                         number(c.axes.offset),
                         isMap ? number(c.axes.mapSize) : "",
                         isMap ? number(c.axes.mapBias) : "",
                         c.dithers ? "on" : "off",
                         c.blendUnit,
                         fmt::format("{}", fmt::join(view, " "))});
    }
    return text;
}

}  // namespace gnomon
