#include "report/mesh_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "method/method.h"
#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

/// Volume polygons of a level with 262 lights (Aldridge and Woods, section 2.6): one volume per triangle, and
/// the signed edge counter.
constexpr std::size_t kPublishedPerTriangle = 4'440'000, kPublishedWinding = 2'405'000;
constexpr const char* kPublishedSource = "Aldridge and Woods, section 2.6";

/// Objects beyond these are folded in the text: a level has hundreds.
constexpr std::size_t kShownObjects = 12;

struct Quantity {
    const char* name;
    std::function<std::size_t(const Topology&)> of;
};

const std::vector<Quantity>& quantities() {
    static const std::vector<Quantity> all = {
        {"triangles", [](const Topology& t) { return t.triangles; }},
        {"vertices", [](const Topology& t) { return t.vertices; }},
        {"edges", [](const Topology& t) { return t.edges; }},
        {"boundary_edges", [](const Topology& t) { return t.boundaryEdges(); }},
        {"non_manifold_edges", [](const Topology& t) { return t.nonManifoldEdges(); }},
        {"max_valence", [](const Topology& t) { return std::size_t(t.maxValence()); }},
        {"winding_conflicts", [](const Topology& t) { return t.windingConflicts; }},
        {"unbalanced_edges", [](const Topology& t) { return t.unbalancedEdges; }},
        {"duplicates", [](const Topology& t) { return t.duplicates; }},
        {"duplicates_same_way", [](const Topology& t) { return t.duplicatesSameWay; }},
        {"t_junctions", [](const Topology& t) { return t.tJunctions; }},
        {"components", [](const Topology& t) { return t.components; }},
        {"bow_ties", [](const Topology& t) { return t.bowTies; }},
    };
    return all;
}

bool isSame(const Topology& a, const Topology& b) {
    return std::all_of(quantities().begin(), quantities().end(),
                       [&](const Quantity& q) { return q.of(a) == q.of(b); });
}

std::string wordsOf(const Edge& edge) {
    return fmt::format("({}, {}, {}) to ({}, {}, {})", edge[0].x, edge[0].y, edge[0].z, edge[1].x, edge[1].y,
                       edge[1].z);
}

/// "3: 12, 4: 7"
std::string valencesOf(const Topology& t) {
    std::vector<std::string> words;
    for (const auto& [valence, count] : t.valences)
        if (valence > 2) words.push_back(fmt::format("{}: {}", valence, count));
    return fmt::format("{}", fmt::join(words, ", "));
}

std::string ratio(std::size_t over, std::size_t under) {
    return under == 0 ? "-" : fmt::format("{:.3f}", double(over) / double(under));
}

std::string topologyText(const MeshFacts& mesh, std::size_t width) {
    std::vector<const Topology*> columns{&mesh.file};
    std::vector<std::vector<std::string>> rows{{"all casters as one mesh", "file"}};
    const auto addColumn = [&](const std::string& head, const Topology& topology) {
        if (isSame(topology, *columns.back())) return;
        columns.push_back(&topology);
        rows[0].push_back(head);
    };
    addColumn("as drawn", mesh.drawn);
    addColumn("object by object", mesh.byObject);
    const auto addRow = [&](const std::string& head, const auto& of) {
        rows.push_back({head});
        for (const Topology* column : columns) rows.back().push_back(of(*column));
    };
    const auto addNumber = [&](const std::string& head, const auto& of) {
        addRow(head, [&](const Topology& t) { return fmt::format("{}", of(t)); });
    };
    addNumber("triangles", [](const Topology& t) { return t.triangles; });
    addNumber("  duplicates, the same way round", [](const Topology& t) { return t.duplicatesSameWay; });
    addNumber("  duplicates, reversed", [](const Topology& t) { return t.duplicates - t.duplicatesSameWay; });
    addNumber("vertices", [](const Topology& t) { return t.vertices; });
    addNumber("  further fans at a vertex", [](const Topology& t) { return t.bowTies; });
    addNumber("unique edges", [](const Topology& t) { return t.edges; });
    addNumber("  boundary: one triangle", [](const Topology& t) { return t.boundaryEdges(); });
    if (mesh.file.boundaryEdges() + mesh.byObject.boundaryEdges() > 0)
        addNumber("    T-junctions: vertices inside them", [](const Topology& t) { return t.tJunctions; });
    addNumber("  non-manifold: three or more", [](const Topology& t) { return t.nonManifoldEdges(); });
    if (std::any_of(columns.begin(), columns.end(), [](auto* t) { return t->nonManifoldEdges() > 0; }))
        addRow("    triangles: edges", valencesOf);
    addNumber("  winding conflicts of two triangles", [](const Topology& t) { return t.windingConflicts; });
    addNumber("  directions that do not cancel", [](const Topology& t) { return t.unbalancedEdges; });
    addNumber("connected pieces", [](const Topology& t) { return t.components; });
    addNumber("Euler characteristic", [](const Topology& t) { return t.euler(); });

    std::string text = alignColumns(rows, width);
    const auto example = [&](const char* what, const std::optional<Edge>& edge) {
        if (edge) text += fmt::format("{}: for example {}\n", what, wordsOf(*edge));
    };
    example("boundary", mesh.file.boundaryEdge);
    example("non-manifold", mesh.file.nonManifoldEdge);
    example("winding conflict", mesh.file.conflictEdge);
    text += fmt::format("degenerate: {} triangles repeat a vertex and are left out; {} have no area{}\n",
                        mesh.repeatedVertex, mesh.flat,
                        mesh.flat == 0 ? "" : ": in the file's column, but not drawn");
    return text;
}

/// How the meshes that volumes are built of differ from the file; empty if they don't.
std::string differenceText(const MeshFacts& mesh) {
    const auto open = std::count_if(mesh.objects.begin(), mesh.objects.end(),
                                    [](const ObjectFacts& object) { return !object.topology.isBalanced(); });
    std::string text;
    if (mesh.leftOut > 0)
        text += fmt::format("{} object{} cast{} no shadow and {} left out.\n", mesh.leftOut,
                            mesh.leftOut == 1 ? "" : "s", mesh.leftOut == 1 ? "s" : "",
                            mesh.leftOut == 1 ? "is" : "are");
    if (mesh.file.isBalanced() && !mesh.drawn.isBalanced())
        text += "The file is closed, but without its triangles that have no area it is open.\n";
    if (mesh.drawn.isBalanced() && open > 0)
        text += fmt::format(
            "Closed as a whole, but {} of {} objects are open: volumes are built object by object.\n", open,
            mesh.objects.size());
    return text;
}

std::string objectsText(const MeshFacts& mesh, std::size_t width) {
    if (mesh.objects.size() < 2) return {};
    std::vector<std::vector<std::string>> rows{{"object", "name", "triangles", "boundary", "non-manifold",
                                                "conflicts", "not cancelling", "pieces", "kind"}};
    for (const ObjectFacts& object : mesh.objects) {
        if (rows.size() > kShownObjects) break;
        const Topology& t = object.topology;
        rows.push_back({fmt::format("{}", object.index), object.name, fmt::format("{}", t.triangles),
                        fmt::format("{}", t.boundaryEdges()), fmt::format("{}", t.nonManifoldEdges()),
                        fmt::format("{}", t.windingConflicts), fmt::format("{}", t.unbalancedEdges),
                        fmt::format("{}", t.components), describe(t)});
    }
    std::string text = fmt::format("\n{}", alignColumns(rows, width));
    if (mesh.objects.size() > kShownObjects)
        text +=
            fmt::format("... {} more objects (--format json has all)\n", mesh.objects.size() - kShownObjects);
    return text;
}

std::string verdictOf(const BuilderFacts& builder) {
    return builder.refusal ? "refused" : builder.limitation ? "may be wrong" : "right";
}

std::string buildersText(const MeshFacts& mesh, std::size_t width) {
    constexpr std::size_t kIndent = 29;
    std::string text = "\nsilhouette    this mesh\n------------  ------------\n";
    for (const BuilderFacts& builder : mesh.builders) {
        const std::string why = builder.refusal.value_or(builder.limitation.value_or(""));
        text += fmt::format("{:<14}{}", name(builder.silhouette), verdictOf(builder));
        if (!why.empty())
            text +=
                std::string(kIndent - 14 - verdictOf(builder).size(), ' ') + wrapText(why, kIndent, width);
        text += "\n";
    }
    if (mesh.awayRefusal)
        text += fmt::format("{:<14}{:<15}{}\n", "caps turned", "refused",
                            wrapText("away from the light: " + *mesh.awayRefusal, kIndent, width));
    return text;
}

std::size_t edgesOf(const VolumeCount& c) {
    return c.edges;
}
std::size_t sidesOf(const VolumeCount& c) {
    return c.sides;
}
std::size_t polygonsOf(const VolumeCount& c) {
    return c.polygons();
}
std::size_t trianglesOf(const VolumeCount& c) {
    return c.triangles();
}

std::string wordsOf(const CountSpread& s) {
    return s.least == s.most ? fmt::format("{}", s.least)
                             : fmt::format("{} / {} / {}", s.least, s.median, s.most);
}

std::string lightsText(const MeshFacts& mesh, const LightSet& set, std::size_t width) {
    const std::string title = fmt::format("Volumes of each light (least / median / most): {}", set.title);
    std::string text = fmt::format("\n{}\n\n", wrapText(title, 0, width));
    std::vector<std::vector<std::string>> rows{{"silhouette", "edges", "sides", "polygons", "triangles"}};
    for (const BuilderFacts& builder : mesh.builders) {
        rows.push_back({name(builder.silhouette)});
        if (builder.refusal) {
            rows.back().push_back("refused");
            continue;
        }
        for (const auto of : {edgesOf, sidesOf, polygonsOf, trianglesOf})
            rows.back().push_back(wordsOf(spread(set, builder.silhouette, of)));
    }
    text += alignColumns(rows, width);
    const auto sums = [&](auto of) {
        const std::size_t each = spread(set, Silhouette::PerTriangle, of).sum;
        const std::size_t winding = spread(set, Silhouette::Winding, of).sum;
        return fmt::format("{} = {} / {}", ratio(each, winding), each, winding);
    };
    const std::string all = fmt::format("per-triangle / winding, of all lights: polygons {}; sides alone {}",
                                        sums(polygonsOf), sums(sidesOf));
    text += fmt::format("{}\n", wrapText(all, 2, width));
    return text;
}

std::string legend(std::size_t width) {
    const std::string text = fmt::format(
        "A side is a quad that hangs from an edge, as often as its weight; polygons are sides, "
        "light caps and far caps. Published, of a level with 262 lights: {} = {} / {} ({}); only "
        "the ratio compares.",
        ratio(kPublishedPerTriangle, kPublishedWinding), kPublishedPerTriangle, kPublishedWinding,
        kPublishedSource);
    return fmt::format("\n{}\n", wrapText(text, 0, width));
}

std::string meshText(const MeshFacts& mesh, std::size_t width) {
    std::string text = fmt::format("{}: {}\n\n", mesh.id, describe(mesh.file));
    text += topologyText(mesh, width);
    text += differenceText(mesh);
    text += objectsText(mesh, width);
    text += buildersText(mesh, width);
    for (const LightSet& set : mesh.lightSets) text += lightsText(mesh, set, width);
    return text;
}

Json topologyJson(const Topology& topology) {
    Json json;
    for (const Quantity& q : quantities()) json[q.name] = q.of(topology);
    Json valences = Json::object();
    for (const auto& [valence, count] : topology.valences) valences[fmt::format("{}", valence)] = count;
    json["edges_by_valence"] = valences;
    json["euler"] = topology.euler();
    json["genus"] = nullptr;
    if (const auto genus = topology.genus()) json["genus"] = *genus;
    json["balanced"] = topology.isBalanced();
    json["closed_manifold"] = topology.isClosedManifold();
    Json examples = Json::object();
    const auto example = [&](const char* key, const std::optional<Edge>& edge) {
        if (!edge) return;
        examples[key] = Json::array();
        for (const glm::vec3& p : *edge) examples[key].push_back({p.x, p.y, p.z});
    };
    example("boundary", topology.boundaryEdge);
    example("non_manifold", topology.nonManifoldEdge);
    example("winding_conflict", topology.conflictEdge);
    example("unbalanced", topology.unbalancedEdge);
    json["examples"] = examples;
    return json;
}

Json spreadJson(const CountSpread& s) {
    return {{"min", s.least}, {"median", s.median}, {"max", s.most}, {"sum", s.sum}};
}

Json lightSetJson(const MeshFacts& mesh, const LightSet& set) {
    Json positions = Json::array(), volumes = Json::array();
    for (const Light& light : set.lights)
        positions.push_back({light.position.x, light.position.y, light.position.z, light.position.w});
    for (const BuilderFacts& builder : mesh.builders) {
        if (builder.refusal) continue;
        const auto of = [&](auto quantity) { return spreadJson(spread(set, builder.silhouette, quantity)); };
        volumes.push_back({{"silhouette", name(builder.silhouette)},
                           {"edges", of(edgesOf)},
                           {"sides", of(sidesOf)},
                           {"polygons", of(polygonsOf)},
                           {"triangles", of(trianglesOf)}});
    }
    return {{"id", set.id}, {"title", set.title}, {"lights", positions}, {"volumes", volumes}};
}

Json orNull(const std::optional<std::string>& text) {
    return text ? Json(*text) : Json(nullptr);
}

Json meshJson(const MeshFacts& mesh) {
    Json objects = Json::array(), builders = Json::array(), lights = Json::array();
    for (const ObjectFacts& object : mesh.objects)
        objects.push_back({{"object", object.index},
                           {"name", object.name},
                           {"kind", describe(object.topology)},
                           {"topology", topologyJson(object.topology)}});
    for (const BuilderFacts& builder : mesh.builders)
        builders.push_back({{"silhouette", name(builder.silhouette)},
                            {"verdict", verdictOf(builder)},
                            {"refusal", orNull(builder.refusal)},
                            {"limitation", orNull(builder.limitation)}});
    for (const LightSet& set : mesh.lightSets) lights.push_back(lightSetJson(mesh, set));
    // The examples of a sum would be none.
    Json byObject = topologyJson(mesh.byObject);
    for (const char* key : {"genus", "closed_manifold", "examples", "euler"}) byObject.erase(key);
    return {{"mesh", mesh.id},
            {"kind", describe(mesh.file)},
            {"degenerate", {{"repeated_vertex", mesh.repeatedVertex}, {"zero_area", mesh.flat}}},
            {"file", topologyJson(mesh.file)},
            {"drawn", topologyJson(mesh.drawn)},
            {"by_object", byObject},
            {"objects", objects},
            {"objects_without_shadow", mesh.leftOut},
            {"silhouettes", builders},
            {"caps_turned_away_refusal", orNull(mesh.awayRefusal)},
            {"lights", lights},
            {"published",
             {{"per_triangle", kPublishedPerTriangle},
              {"winding", kPublishedWinding},
              {"source", kPublishedSource}}}};
}

std::string meshesCsv(const std::vector<MeshFacts>& meshes) {
    std::vector<std::string> head{"mesh", "kind", "repeated_vertex", "zero_area"};
    for (const Quantity& q : quantities()) head.push_back(q.name);
    for (const char* word : {"lights", "light_count", "silhouette", "verdict", "why"}) head.push_back(word);
    for (const char* quantity : {"edges", "sides", "polygons", "triangles"})
        for (const char* part : {"min", "median", "max", "sum"})
            head.push_back(fmt::format("{}_{}", quantity, part));
    std::string text = csvLine(head);

    for (const MeshFacts& mesh : meshes) {
        std::vector<std::string> common{mesh.id, describe(mesh.file), fmt::format("{}", mesh.repeatedVertex),
                                        fmt::format("{}", mesh.flat)};
        for (const Quantity& q : quantities()) common.push_back(fmt::format("{}", q.of(mesh.file)));
        const auto addLine = [&](const BuilderFacts& builder, const LightSet* set) {
            std::vector<std::string> fields = common;
            fields.push_back(set ? set->id : "");
            fields.push_back(fmt::format("{}", set ? set->lights.size() : 0));
            fields.push_back(name(builder.silhouette));
            fields.push_back(verdictOf(builder));
            fields.push_back(builder.refusal.value_or(builder.limitation.value_or("")));
            for (const auto of : {edgesOf, sidesOf, polygonsOf, trianglesOf}) {
                const auto s = set && !builder.refusal ? spread(*set, builder.silhouette, of) : CountSpread{};
                for (const std::size_t value : {s.least, s.median, s.most, s.sum})
                    fields.push_back(set && !builder.refusal ? fmt::format("{}", value) : "");
            }
            text += csvLine(fields);
        };
        for (const BuilderFacts& builder : mesh.builders) {
            if (mesh.lightSets.empty()) addLine(builder, nullptr);
            for (const LightSet& set : mesh.lightSets) addLine(builder, &set);
        }
    }
    return text;
}

}  // namespace

std::string showMeshes(const std::vector<MeshFacts>& meshes, const Page& page) {
    if (page.format == Format::Csv) return meshesCsv(meshes);
    if (page.format == Format::Json) {
        Json all = Json::array();
        for (const MeshFacts& mesh : meshes) all.push_back(meshJson(mesh));
        return all.dump(2) + "\n";
    }
    std::string text;
    for (const MeshFacts& mesh : meshes)
        text += fmt::format("{}{}", text.empty() ? "" : "\n", meshText(mesh, page.width));
    const bool hasVolumes = std::any_of(meshes.begin(), meshes.end(),
                                        [](const MeshFacts& mesh) { return !mesh.lightSets.empty(); });
    return hasVolumes ? text + legend(page.width) : text;
}

}  // namespace gnomon
