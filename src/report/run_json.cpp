#include "report/run_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "matrix/cell_json.h"
#include "report/cause_picture.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

/// A dictionary of values, and for each cell which one it has.
class Dictionary {
  public:
    void add(const Json& value) {
        const auto [at, isNew] = m_known.try_emplace(value.dump(), m_values.size());
        if (isNew) m_values.push_back(value);
        m_indices.push_back(at->second);
    }
    Json json() const { return {{"dictionary", m_values}, {"values", m_indices}}; }

  private:
    std::map<std::string, std::size_t> m_known{};
    Json m_values = Json::array();
    std::vector<std::size_t> m_indices{};
};

/// One column: numbers and truths as they are, where every cell has one, else a dictionary.
Json columnOf(const std::vector<Json>& values) {
    const bool isPlain = std::all_of(values.begin(), values.end(),
                                     [](const Json& v) { return v.is_number() || v.is_boolean(); });
    if (isPlain) return {{"values", values}};
    Dictionary dictionary;
    for (const Json& value : values) dictionary.add(value);
    return dictionary.json();
}

/// By cell, its drawing; -1: none.
std::vector<int> drawingsOf(std::size_t cells, const RunPictures& pictures) {
    std::vector<int> drawings(cells, -1);
    for (std::size_t d = 0; d < pictures.drawings.size(); ++d)
        for (const std::size_t cell : pictures.drawings[d].cells) drawings[cell] = int(d);
    return drawings;
}

/// The passes of a cell for people; "" where the report has none.
std::string planOf(std::size_t cell, int drawing, const RunPictures& pictures) {
    const auto refused = pictures.refusedPlans.find(cell);
    if (refused != pictures.refusedPlans.end()) return refused->second;
    return drawing < 0 ? "" : pictures.drawings[std::size_t(drawing)].plan;
}

Json cellsJson(const std::vector<Cell>& cells, const RunPictures& pictures) {
    std::vector<std::string> names;
    std::map<std::string, std::vector<Json>> columns;
    for (std::size_t i = 0; i < cells.size(); ++i)
        for (auto& [key, value] : flatCell(cells[i])) {
            auto [at, isNew] = columns.try_emplace(key);
            if (isNew) names.push_back(key), at->second.resize(cells.size());
            at->second[i] = std::move(value);
        }
    Json json = Json::object();
    for (const std::string& name : names) json[name] = columnOf(columns[name]);

    const std::vector<int> drawings = drawingsOf(cells.size(), pictures);
    Dictionary plans;
    for (std::size_t i = 0; i < cells.size(); ++i) plans.add(planOf(i, drawings[i], pictures));
    json["drawing"] = {{"values", drawings}};
    json["plan"] = plans.json();
    return {{"count", cells.size()}, {"columns", json}};
}

/// Values in the order in which they first come, each once.
template <class Value>
std::vector<Value> distinct(const std::vector<Cell>& cells, Value Cell::*member) {
    std::vector<Value> values;
    std::set<Value> known;
    for (const Cell& cell : cells)
        if (known.insert(cell.*member).second) values.push_back(cell.*member);
    return values;
}

Json profileJson(const std::string& id, const RunSources& sources) {
    const auto at = sources.profiles.find(id);
    if (at == sources.profiles.end()) return {{"id", id}};
    const Profile& profile = at->second;
    Json limits = Json::array();
    for (const Profile::Fact& fact : profile.facts)
        limits.push_back({{"what", fact.key},
                          {"value", fact.value},
                          {"source", fact.source},
                          {"grade", name(fact.grade)}});
    Json json{{"id", id}, {"name", profile.title}};
    if (profile.year) json["year"] = profile.year;
    json["limits"] = limits;
    return json;
}

/// Of a method that is chosen frame by frame only its id and shade hold for all cells.
Json methodJson(const Cell& cell) {
    const Axes& a = cell.axes;
    const NamedMethod* row = findMethod(cell.method);
    Json json{{"id", cell.method}};
    if (cell.drawnBy.empty() && !a.automatic) {
        json["store"] = name(a.store);
        json["arithmetic"] = name(a.arithmetic);
        if (a.arithmetic == Arithmetic::Double) json["levels"] = a.levels;
        json["count"] = name(a.count);
        json["silhouette"] = name(a.silhouette);
        json["mask_scale"] = 1.0 / a.maskDivisor;
        json["apply"] = name(a.apply);
    }
    json["shade"] = name(a.shade);
    json["source"] = row ? row->source : "";
    if (row) json["summary"] = row->summary;
    return json;
}

Json methodsJson(const std::vector<Cell>& cells) {
    Json methods = Json::array();
    std::set<std::string> known;
    for (const Cell& cell : cells)
        if (known.insert(cell.method).second) methods.push_back(methodJson(cell));
    return methods;
}

Json scenesJson(const std::vector<Cell>& cells) {
    Json scenes = Json::array();
    for (const std::string& id : distinct(cells, &Cell::scene)) {
        std::set<int> frames;
        for (const Cell& cell : cells)
            if (cell.scene == id) frames.insert(cell.frame);
        scenes.push_back({{"id", id}, {"frames", frames}});
    }
    return scenes;
}

/// Adds to what is said of a cell or drawing how it came out otherwise than its run has it.
void addFaults(Json& json, const CellDrawing& drawing) {
    if (!drawing.differs.empty()) json["differs"] = drawing.differs;
    if (!drawing.error.empty()) json["error"] = drawing.error;
}

Json drawingJson(const CellDrawing& drawing, const std::vector<Cell>& cells) {
    const Cell& cell = cells[drawing.cells.front()];
    Json pictures = Json::object(), strip = Json::array();
    for (const auto& [what, picture] : drawing.pictures) pictures[what] = picture;
    for (const StripFrame& frame : drawing.strip) {
        Json buffers = Json::object();
        for (const auto& [buffer, picture] : frame.buffers) buffers[buffer] = picture;
        strip.push_back(
            {{"pass", frame.pass}, {"title", frame.title}, {"why", frame.why}, {"buffers", buffers}});
    }
    Json json{{"width", cell.width}, {"height", cell.height}, {"chunk", drawing.chunk},
              {"frame", cell.frame}, {"pictures", pictures},  {"strip", strip}};
    addFaults(json, drawing);
    return json;
}

Json causesJson() {
    Json causes = Json::array();
    for (int c = 1; c < kCauses; ++c) {
        const std::array<std::uint8_t, 3> colour = colourOf(Cause(c));
        causes.push_back({{"name", name(Cause(c))},
                          {"colour", fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2])}});
    }
    return causes;
}

/// Nodes are values of the mask, edges crossings.
Json statesJson(const MaskStates& graph) {
    Json nodes = Json::array(), edges = Json::array();
    for (const MaskState& state : graph.states)
        nodes.push_back({{"id", fmt::format("{}", state.code)},
                         {"label", fmt::format("{}", state.code)},
                         {"kind", meaning(state)}});
    for (const MaskStep& step : graph.steps)
        edges.push_back({{"from", fmt::format("{}", step.from)},
                         {"to", fmt::format("{}", step.to)},
                         {"label", meaning(step, graph)}});
    return {{"profile", graph.profile},
            {"method", graph.method},
            {"title", graph.title},
            {"nodes", nodes},
            {"edges", edges}};
}

}  // namespace

std::vector<std::pair<std::string, Json>> flatCell(const Cell& cell) {
    std::vector<std::pair<std::string, Json>> flat;
    const Json json = toJson(cell);
    for (const auto& [key, value] : json.items()) {
        if (key == "cell") continue;
        if (!value.is_object() || key == "causes" || key == "view") {
            flat.emplace_back(key, value);
            continue;
        }
        for (const auto& [inner, number] : value.items())
            flat.emplace_back(fmt::format("{}.{}", key, inner), number);
    }
    return flat;
}

Json runJson(const Report& report) {
    const std::vector<Cell>& cells = report.cells;
    Json profiles = Json::array(), drawings = Json::array(), packed = Json::array(), states = Json::array();
    for (const std::string& id : distinct(cells, &Cell::profile))
        profiles.push_back(profileJson(id, report.sources));
    for (const CellDrawing& drawing : report.pictures.drawings)
        drawings.push_back(drawingJson(drawing, cells));
    for (const PackedPicture& p : report.pictures.pictures)
        packed.push_back({{"chunk", p.chunk},
                          {"offset", p.offset},
                          {"width", p.width},
                          {"height", p.height},
                          {"planes", p.planes},
                          {"kind", name(p.kind)},
                          {"base", p.base}});
    for (const MaskStates& graph : report.states) states.push_back(statesJson(graph));
    Json compare;
    if (report.before)
        compare = {{"old", {{"command", report.before->command}, {"program", report.before->program}}},
                   {"changes", changesJson(report.changes)}};
    return {{"format", 1},
            {"command", report.title.command},
            {"program", report.title.program},
            {"profiles", profiles},
            {"methods", methodsJson(cells)},
            {"scenes", scenesJson(cells)},
            {"cells", cellsJson(cells, report.pictures)},
            {"drawings", drawings},
            {"causes", causesJson()},
            {"pictures", packed},
            {"states", states},
            {"compare", compare}};
}

Json wordsJson(const Report& report) {
    Json json = runJson(report), cells = Json::array();
    for (const char* key : {"drawings", "pictures"}) json.erase(key);
    const std::vector<int> drawings = drawingsOf(report.cells.size(), report.pictures);
    for (std::size_t i = 0; i < report.cells.size(); ++i) {
        Json cell = toJson(report.cells[i]);
        if (std::string plan = planOf(i, drawings[i], report.pictures); !plan.empty())
            cell["plan"] = std::move(plan);
        if (drawings[i] >= 0) addFaults(cell, report.pictures.drawings[std::size_t(drawings[i])]);
        cells.push_back(std::move(cell));
    }
    json["cells"] = std::move(cells);
    return json;
}

}  // namespace gnomon
