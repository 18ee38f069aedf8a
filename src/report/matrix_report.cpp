#include "report/matrix_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "matrix/cell_json.h"
#include "report/table.h"

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
        addOnce(m_notes[at].chips[source], profile);
        return letterOf(at);
    }
    std::string text() const {
        std::string out;
        for (std::size_t i = 0; i < m_notes.size(); ++i) {
            out += fmt::format("  {:<3}{}\n", letterOf(i), wrapText(m_notes[i].text, 5));
            for (const auto& [source, chips] : m_notes[i].chips)
                out += fmt::format("       {}\n",
                                   wrapText(fmt::format("{}: {}", fmt::join(chips, " "), source), 9));
        }
        return out;
    }

  private:
    struct Note {
        std::string text{};
        std::map<std::string, std::vector<std::string>> chips{};  ///< by source
    };
    std::vector<Note> m_notes{};
};

std::string cellText(const Entry& e, const std::string& profile, Notes& notes) {
    const std::string passes =
        fmt::format(" {}/{}{}", e.passes.scene, e.passes.rectangle, e.chosen ? "*" : "");
    switch (e.verdict) {
        case Verdict::Exact:
            return "exact" + passes;
        case Verdict::Edge:
            return fmt::format("edge {}", e.wrong) + passes;
        case Verdict::Wrong:
            return fmt::format("WRONG {}", e.wrong) + passes;
        case Verdict::Refused:
            break;
        case Verdict::Failed:
            return fmt::format("FAILED {}", notes.letter(e.error, "failed", profile));
    }
    std::vector<std::string> letters;
    for (const Missing& m : e.missing) letters.push_back(notes.letter(m.what, m.source, profile));
    return fmt::format("- {}", fmt::join(letters, ","));
}

std::string tableOf(const std::vector<const Cell*>& cells) {
    std::vector<std::string> profiles, methods;
    std::vector<int> frames;
    std::map<std::pair<std::string, std::string>, std::vector<const Cell*>> entries;
    for (const Cell* cell : cells) {
        // The shade is no part of a method's name: where several run, the row says which.
        const std::string row =
            fmt::format("{}{}{}", cell->method, cell->axes.shade == Shade::Attenuated ? "" : " ",
                        cell->axes.shade == Shade::Attenuated ? "" : name(cell->axes.shade));
        addOnce(profiles, cell->profile);
        addOnce(methods, row);
        addOnce(frames, cell->frame);
        entries[{row, cell->profile}].push_back(cell);
    }

    Notes notes;
    std::vector<std::vector<std::string>> rows{{"method"}};
    rows[0].insert(rows[0].end(), profiles.begin(), profiles.end());
    std::vector<std::string> causes;
    for (const std::string& method : methods) {
        rows.push_back({method});
        std::map<std::string, std::vector<std::string>> causesHere;  // cause -> chips
        for (const std::string& profile : profiles) {
            const Entry entry = merge(entries[{method, profile}]);
            rows.back().push_back(cellText(entry, profile, notes));
            for (const auto& [cause, pixels] : entry.causes)
                causesHere[fmt::format("{}: {}", cause, pixels)].push_back(profile);
        }
        for (const auto& [cause, where] : causesHere)
            causes.push_back(fmt::format("{}: {} ({})", method, cause, fmt::join(where, " ")));
    }

    std::string text = fmt::format("{}, {}x{}, frame{} {}\n\n", cells[0]->scene, cells[0]->width,
                                   cells[0]->height, frames.size() > 1 ? "s" : "", fmt::join(frames, " "));
    text += alignColumns(rows);
    if (!notes.text().empty()) text += "\nNotes: refused for want of\n" + notes.text();
    if (!causes.empty()) text += "\nWrong pixels by cause\n";
    for (const std::string& cause : causes) text += fmt::format("  {}\n", wrapText(cause, 5));
    return text;
}

}  // namespace

std::string matrixText(const std::vector<Cell>& cells) {
    std::vector<std::tuple<std::string, int, int>> keys;
    std::map<std::tuple<std::string, int, int>, std::vector<const Cell*>> tables;
    for (const Cell& cell : cells) {
        const std::tuple key(cell.scene, cell.width, cell.height);
        addOnce(keys, key);
        tables[key].push_back(&cell);
    }
    std::string text;
    for (const auto& key : keys) text += tableOf(tables[key]) + "\n";
    text +=
        "exact: every untied pixel is as exact ray tracing says; edge, WRONG: wrong pixels in all frames, at "
        "the\n"
        "boundary of shadows or away from it; 2/3: scene passes / full-window rectangles; *: the path that "
        "gnomon\n"
        "takes on this chip; -: refused.\n";
    return text;
}

std::string matrixJson(const std::vector<Cell>& cells) {
    std::string text = "[";
    for (std::size_t i = 0; i < cells.size(); ++i)
        text += fmt::format("{}{}", i ? ",\n " : "", toJson(cells[i]).dump());
    return text + "]\n";
}

std::string matrixCsv(const std::vector<Cell>& cells) {
    std::string text = csvLine(
        {"cell",        "profile", "method",        "scene",        "store",         "arithmetic",
         "levels",      "count",   "silhouette",    "mask_scale",   "apply",         "shade",
         "width",       "height",  "frame",         "lights",       "fidelity",      "verdict",
         "chosen",      "missing", "causes",        "passes_scene", "passes_volume", "passes_rectangle",
         "passes_copy", "pixels",  "tied_truth",    "tied_count",   "wrong_edge",    "wrong_interior",
         "vertices",    "cpu_ms",  "unshadowed_ms", "digest",       "error"});
    for (const Cell& c : cells) {
        std::vector<std::string> missing, causes;
        for (const Missing& m : c.missing) missing.push_back(m.what);
        for (const auto& [cause, pixels] : c.causes) causes.push_back(fmt::format("{} {}", cause, pixels));
        const auto number = [](auto value) { return fmt::format("{}", value); };
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
                         number(c.vertices),
                         fmt::format("{:.3f}", c.cpuMs),
                         fmt::format("{:.3f}", c.unshadowedMs),
                         c.digest,
                         c.error});
    }
    return text;
}

}  // namespace gnomon
