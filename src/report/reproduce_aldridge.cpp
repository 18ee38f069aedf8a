#include "report/reproduce_aldridge.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "report/spread_text.h"
#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kPublishedLights = 262;
constexpr std::size_t kPublishedCrowdedEdges = 10'654;

/// How often @p whole holds @p part.
double times(double whole, double part) {
    return part > 0 ? whole / part : 0;
}

struct Compared {
    std::string what{};
    double published = 0, ours = 0;
    std::optional<Spread> spread{};
};

/// Brute force as a multiple of the counter.
std::vector<Compared> compared(const AldridgeRun& run) {
    const AldridgeRow &counter = run.rows[0], &brute = run.rows[1];
    const Spread time = spreadOf(ratios(brute.frameMs, counter.frameMs));
    return {{"edges", times(double(brute.publishedEdges), double(counter.publishedEdges)),
             times(double(brute.edges), double(counter.edges)), std::nullopt},
            {"polygons", times(double(brute.publishedPolygons), double(counter.publishedPolygons)),
             times(double(brute.polygons), double(counter.polygons)), std::nullopt},
            {"time of a frame", times(counter.publishedFps, brute.publishedFps), time.median, time}};
}

std::string jsonOf(const AldridgeRun& run) {
    Json rows = Json::array(), multiples = Json::array();
    for (const AldridgeRow& row : run.rows)
        rows.push_back({{"builder", row.builder},
                        {"published",
                         {{"fps", row.publishedFps},
                          {"edges", row.publishedEdges},
                          {"polygons", row.publishedPolygons}}},
                        {"edges", row.edges},
                        {"polygons", row.polygons},
                        {"frame_ms", spreadJson(spreadOf(row.frameMs))}});
    for (const Compared& c : compared(run)) {
        Json one{{"of", c.what}, {"published", c.published}, {"ours", c.ours}};
        if (c.spread) one["spread"] = spreadJson(*c.spread);
        multiples.push_back(one);
    }
    const Json all{{"paper", "aldridge"},
                   {"scene", run.scene},
                   {"triangles", run.triangles},
                   {"crowded_edges", run.crowdedEdges},
                   {"most_at_an_edge", run.mostAtAnEdge},
                   {"lights", run.lights},
                   {"timed_lights", run.timedLights},
                   {"width", run.width},
                   {"height", run.height},
                   {"repeats", run.repeats},
                   {"device", run.device},
                   {"rows", rows},
                   {"brute_force_over_counter", multiples}};
    return Json::array({all}).dump(2) + "\n";
}

}  // namespace

std::vector<AldridgeRow> aldridgeSection4() {
    return {{.builder = "counter",
             .publishedFps = 4.2,
             .publishedEdges = 385'077,
             .publishedPolygons = 2'405'000},
            {.builder = "brute force",
             .publishedFps = 2.3,
             .publishedEdges = 763'431,
             .publishedPolygons = 4'440'000}};
}

std::string showAldridge(const AldridgeRun& run, const Page& page) {
    if (page.format == Format::Json) return jsonOf(run);
    std::vector<std::vector<std::string>> table{
        {"builder", "edges published", "here", "polygons published", "here", "fps", "frame here, ms"}};
    for (const AldridgeRow& row : run.rows)
        table.push_back({row.builder, fmt::format("{}", row.publishedEdges), fmt::format("{}", row.edges),
                         fmt::format("{}", row.publishedPolygons), fmt::format("{}", row.polygons),
                         fmt::format("{}", row.publishedFps), spreadText(spreadOf(row.frameMs))});
    std::vector<std::vector<std::string>> multiples{{"brute force / counter", "published", "here"}};
    for (const Compared& c : compared(run))
        multiples.push_back({c.what, fmt::format("{:.2f}", c.published),
                             c.spread ? spreadText(*c.spread) : fmt::format("{:.2f}", c.ours)});
    if (page.format == Format::Csv) {
        std::string text;
        for (const auto& row : table) text += csvLine(row);
        return text;
    }
    return fmt::format("Aldridge and Woods, section 4, beside {} ({} triangles) at {}x{}\non {}\n\n",
                       run.scene, run.triangles, run.width, run.height, run.device) +
           alignColumns(table, page.width) + "\n" + alignColumns(multiples, page.width) + "\n" +
           fmt::format("Edges of three triangles or more: published {}, here {}, up to {} at one edge.\n",
                       kPublishedCrowdedEdges, run.crowdedEdges, run.mostAtAnEdge) +
           wrapText(
               fmt::format("Polygons: sides and both caps, published of {} lights, here of {} ({}). The "
                           "frame's time: volumes of {} of them built and drawn by z-fail in turn, median "
                           "(quartiles) of {} rounds.",
                           kPublishedLights, run.lights, run.where, run.timedLights, run.repeats),
               0, page.width) +
           "\n" +
           wrapText(
               "Comparable: brute force as a multiple of the counter. Not comparable: frame rates (a "
               "Radeon 9500), and the numbers themselves: the paper's lights have ranges, which leave "
               "most of its level out of each volume.",
               0, page.width) +
           "\n";
}

}  // namespace gnomon
