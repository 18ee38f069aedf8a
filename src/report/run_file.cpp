#include "report/run_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "gl/device.h"
#include "matrix/cell_json.h"
#include "matrix/merge.h"
#include "matrix/stored_cell.h"
#include "predict/causes.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

/// Some four million cells; a store (--out) has no such limit.
constexpr std::uintmax_t kMostRunBytes = 4'294'967'296;
constexpr int kLargestSide = 8192;  ///< of a window, pixels: as --size takes it

/// The elements of a JSON array, one after the other, as text: a run is too large to be held as one value.
class Elements {
  public:
    Elements(const std::string& file, const std::string& text) : m_file(file), m_text(text) {
        skipSpace();
        if (m_at == m_text.size()) fail("an empty file, no run");
        if (m_text[m_at] == '{') fail(whyNoArray());
        if (m_text[m_at] != '[') fail("no run: it begins with '[' (gnomon matrix --format json writes one)");
        ++m_at;
        skipSpace();
        if (m_at < m_text.size() && m_text[m_at] == ']') finish();
    }

    bool atEnd() const { return m_done; }

    /// The next element; line() is its first line then.
    std::string next() {
        skipSpace();
        m_elementLine = m_line;
        const std::size_t begin = m_at;
        int depth = 0;
        bool quoted = false;
        for (; m_at < m_text.size(); ++m_at) {
            const char c = m_text[m_at];
            if (c == '\n') ++m_line;
            if (quoted) {
                if (c == '\\') ++m_at;
                quoted = c != '"';
                continue;
            }
            if (depth == 0 && (c == ',' || c == ']')) break;
            quoted = c == '"';
            depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        }
        if (m_at >= m_text.size()) fail("the file ends in the middle of a run");
        std::string element = m_text.substr(begin, m_at - begin);
        if (m_text[m_at] == ']')
            finish();
        else
            ++m_at;
        return element;
    }

    int line() const { return m_elementLine; }

    [[noreturn]] void fail(const std::string& what) const {
        throw RunError(fmt::format("{}:{}: {}", m_file, m_line, what));
    }

  private:
    void skipSpace() {
        for (; m_at < m_text.size() && std::string(" \t\r\n").find(m_text[m_at]) != std::string::npos; ++m_at)
            m_line += m_text[m_at] == '\n';
    }
    void finish() {
        ++m_at;
        skipSpace();
        if (m_at < m_text.size()) fail("more after the end of the run");
        m_done = true;
    }
    std::string whyNoArray() const {
        const Json json = Json::parse(m_text, nullptr, false);
        if (json.is_object() && json.contains("format"))
            return fmt::format("a run of format {}: this gnomon reads lists of cells only",
                               json["format"].dump());
        return "no run, but one object: a run is a list of cells";
    }

    std::string m_file{};
    const std::string& m_text;
    std::size_t m_at = 0;
    int m_line = 1, m_elementLine = 1;
    bool m_done = false;
};

bool isCause(const std::string& word) {
    for (int c = 1; c < kCauses; ++c)
        if (word == name(Cause(c))) return true;
    return false;
}

std::string kindOf(const Json& json) {
    if (json.is_number()) return "a number";
    if (json.is_string()) return "a text";
    if (json.is_boolean()) return "true or false";
    if (json.is_array()) return "a list";
    if (json.is_object()) return "an object";
    return "null";
}

/// Keys that some cells have and others lack, each with a value of its kind.
const Json& furtherKeys() {
    static const Json keys{{"levels", 0},  {"start", ""},    {"overflow", ""},   {"caps", ""},
                           {"clip", ""},   {"offset", 0},    {"map_size", 0},    {"map_bias", 0},
                           {"dither", ""}, {"drawn_by", ""}, {"blend_unit", ""}, {"view", Json::object()},
                           {"proof", ""},  {"error", ""}};
    return keys;
}

/// What is wrong with the keys of @p json, which should be those of @p like; "" if nothing is.
std::string keyFault(const Json& json, const Json& like, const Json& further, const std::string& where) {
    for (const auto& [key, value] : like.items()) {
        if (!json.contains(key)) return fmt::format("no '{}{}'", where, key);
        const Json& mine = json.at(key);
        if (kindOf(mine) != kindOf(value))
            return fmt::format("'{}{}' is {}, not {}", where, key, kindOf(mine), kindOf(value));
        if (!value.is_object() || value.empty()) continue;
        if (std::string fault = keyFault(mine, value, Json::object(), where + key + "."); !fault.empty())
            return fault;
    }
    for (const auto& [key, value] : json.items()) {
        if (like.contains(key)) continue;
        if (!further.contains(key)) return fmt::format("unknown key '{}{}'", where, key);
        if (kindOf(value) != kindOf(further.at(key)))
            return fmt::format("'{}{}' is {}, not {}", where, key, kindOf(value), kindOf(further.at(key)));
    }
    return {};
}

/// Lists and objects whose keys are the cell's own.
std::string contentFault(const Json& json) {
    for (const Json& m : json.at("missing")) {
        if (!m.is_object()) return "'missing' has what is no object";
        const Json like{{"capability", ""}, {"what", ""}, {"source", ""}};
        if (std::string fault = keyFault(m, like, Json::object(), "missing."); !fault.empty()) return fault;
    }
    for (const Json& warning : json.at("warnings"))
        if (!warning.is_string()) return "'warnings' has what is no text";
    for (const auto& [cause, pixels] : json.at("causes").items())
        if (!pixels.is_number_integer()) return fmt::format("'causes.{}' is no whole number", cause);
    if (json.contains("view"))
        for (const auto& [flag, value] : json.at("view").items())
            if (!value.is_string()) return fmt::format("'view.{}' is no text", flag);
    return {};
}

/// The first number that is not what it should be.
std::string numberFault(const Json& json, const std::string& where) {
    for (const auto& [key, value] : json.items()) {
        if (value.is_object()) {
            if (std::string fault = numberFault(value, where + key + "."); !fault.empty()) return fault;
        }
        if (!value.is_number()) continue;
        const double number = value;
        const bool isShare = key == "mask_scale" || key == "map_bias" || key == "offset";
        const bool isTime = key == "cpu_ms" || key == "unshadowed_ms";
        const bool isWide = where == "touched." || key == "vertices";
        const double most = isTime ? 1e12 : isWide ? 9e15 : std::numeric_limits<int>::max();
        const bool isRight =
            isShare || ((isTime || number == std::floor(number)) && number >= 0 && number <= most);
        if (!isRight) return fmt::format("'{}{}' can't be {}", where, key, value.dump());
    }
    return {};
}

/// What a cell that was read can't be; "" if it can.
std::string cellFault(const Cell& c) {
    if (c.width < 1 || c.width > kLargestSide || c.height < 1 || c.height > kLargestSide)
        return fmt::format("a window of {}x{} is not within 1 to {} pixels", c.width, c.height, kLargestSide);
    if (c.fidelity != "gl" && c.fidelity != "chip")
        return fmt::format("no such fidelity '{}' (known: gl, chip)", c.fidelity);
    bool isDevice = false;
    for (int d = 0; d < kDevices; ++d) isDevice = isDevice || c.device == name(Device(d));
    if (!isDevice) return fmt::format("no such device '{}'", c.device);
    if (const auto why = contradiction(c.axes); why && !c.axes.automatic) return *why;
    const std::string drawn = methodId(c.axes);
    if (const std::string& named = c.drawnBy.empty() ? c.method : c.drawnBy; drawn != named)
        return fmt::format("no method '{}': the axes of this cell are those of '{}'", named, drawn);
    for (const std::string* word : {&c.profile, &c.method, &c.scene})
        if (word->empty()) return "a cell without profile, method or scene";
    return {};
}

/// Where the verdict of a drawn cell, its wrong pixels and their causes don't agree; "" if they do.
std::string verdictFault(const Cell& c) {
    if (c.verdict == Verdict::Refused || c.verdict == Verdict::Failed) return {};
    const Verdict follows = c.wrongInterior > 0 ? Verdict::Wrong
                            : c.wrongEdge > 0   ? Verdict::Edge
                                                : Verdict::Exact;
    if (follows != c.verdict)
        return fmt::format("the verdict is {}, but with {} wrong pixels at boundaries and {} away from them",
                           name(c.verdict), c.wrongEdge, c.wrongInterior);
    long caused = 0;
    for (const auto& [cause, pixels] : c.causes) {
        if (!isCause(cause)) return fmt::format("no such cause '{}'", cause);
        caused += pixels;
    }
    // Of several lights, a pixel may be wrong by more than one.
    if (c.lights == 1 && caused != c.wrongEdge + c.wrongInterior)
        return fmt::format("{} wrong pixels, but causes of {}", c.wrongEdge + c.wrongInterior, caused);
    return {};
}

/// What of @p json a cell does not keep; "" if it keeps all.
std::string lostFault(const Json& json, const Cell& cell) {
    const Json back = toJson(cell);
    for (const auto& [key, value] : json.items()) {
        if (!back.contains(key)) return fmt::format("'{}' does not belong to such a cell", key);
        // A list of what is shown keeps its order; an object need not.
        if (nlohmann::json(back.at(key)) != nlohmann::json(value))
            return fmt::format("'{}' is {}, but the rest of the cell says {}", key, value.dump(),
                               back.at(key).dump());
    }
    for (const auto& [key, value] : back.items())
        if (!json.contains(key)) return fmt::format("no '{}'", key);
    return {};
}

Cell cellOf(const Json& json) {
    const auto refuseIf = [](const std::string& fault) {
        if (!fault.empty()) throw std::invalid_argument(fault);
    };
    static const Json like = [] {
        Json keys = toJson(Cell{});
        for (const char* key : {"levels", "error"}) keys.erase(key);
        return keys;
    }();
    if (!json.is_object()) throw std::invalid_argument(fmt::format("{}, not a cell", kindOf(json)));
    refuseIf(keyFault(json, like, furtherKeys(), ""));
    refuseIf(contentFault(json));
    refuseIf(numberFault(json, ""));
    const double scale = json.at("mask_scale");
    if (scale != 1 && scale != 0.5 && scale != 0.25)
        throw std::invalid_argument(fmt::format("'mask_scale' can't be {}", scale));
    if (!effectsFrom(json.at("effects")))
        throw std::invalid_argument(fmt::format("no such effects {}", json.at("effects").dump()));
    const Cell cell = cellFromJson(json);
    refuseIf(cellFault(cell));
    refuseIf(verdictFault(cell));
    refuseIf(lostFault(json, cell));
    return cell;
}

/// Messages stay one line, whatever the file holds.
std::string oneLine(std::string text) {
    constexpr std::size_t kLongest = 200;
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

}  // namespace

RunError RunRecord::error(std::size_t index, const std::string& what) const {
    if (lines[index] == 0) return RunError(fmt::format("{}: {}: {}", file, cells[index].id(), oneLine(what)));
    return RunError(fmt::format("{}:{}: {}", file, lines[index], oneLine(what)));
}

RunRecord parseRun(const std::string& file, const std::string& text) {
    RunRecord run{.file = file};
    Elements elements(file, text);
    std::map<std::string, std::size_t> known;
    while (!elements.atEnd()) {
        const std::string element = elements.next();
        run.lines.push_back(elements.line());
        const std::size_t index = run.lines.size() - 1;
        try {
            run.cells.push_back(cellOf(Json::parse(element)));
        } catch (const Json::parse_error& error) {
            const auto end = element.begin() + std::ptrdiff_t(std::min(error.byte, element.size()));
            run.lines.back() += int(std::count(element.begin(), end, '\n'));
            const std::string what = error.what();
            throw run.error(index, "no JSON: " + what.substr(what.find("] ") + 2));
        } catch (const std::exception& error) {
            throw run.error(index, error.what());
        }
        const auto [at, isNew] = known.try_emplace(run.cells.back().question(), index);
        if (!isNew)
            throw run.error(index, fmt::format("{} a second time, first in line {}", run.cells.back().id(),
                                               run.lines[at->second]));
    }
    if (run.cells.empty()) throw RunError(fmt::format("{}:1: a run without cells", file));
    return run;
}

/// What a run's folder holds.
static RunRecord readStored(const std::filesystem::path& folder) {
    RunRecord run{.file = folder.string()};
    const CellStore store = CellStore::toRead(folder);
    if (const std::string there = missingOf(store); !there.empty())
        throw RunError(fmt::format("{}: the run is not at its end: {} are there", run.file, there));
    store.forEach([&](const StoredCell& stored) {
        if (!cellIn(stored)) throw RunError(fmt::format("{}: cell {} is damaged", run.file, stored.place));
        try {
            run.cells.push_back(cellOf(Json::parse(stored.cell)));
        } catch (const std::exception& error) {
            throw RunError(fmt::format("{}: cell {}: {}", run.file, stored.place, oneLine(error.what())));
        }
        run.lines.push_back(0);
    });
    if (run.cells.empty()) throw RunError(fmt::format("{}: a run without cells", run.file));
    return run;
}

RunRecord readRun(const std::filesystem::path& file) {
    if (hasStore(file)) return readStored(file);
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        throw RunError(file.string() + ": is a folder without a run");
    if (const auto size = std::filesystem::file_size(file, error); !error && size > kMostRunBytes)
        throw RunError(fmt::format("{}: {} bytes, more than the {} that gnomon reads", file.string(), size,
                                   kMostRunBytes));
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    if (in) text << in.rdbuf();
    if (!in) {
        const bool isThere = std::filesystem::exists(file, error);
        const bool isEmpty = isThere && std::filesystem::file_size(file, error) == 0;
        throw RunError(file.string() + (isEmpty   ? ":1: an empty file, no run"
                                        : isThere ? ": can't be read"
                                                  : ": no such file"));
    }
    return parseRun(file.string(), text.str());
}

}  // namespace gnomon
