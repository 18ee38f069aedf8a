#include "report/reproduce_kolivand2011.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "report/spread_text.h"
#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

std::string jsonOf(const KolivandRun& run) {
    Json rows = Json::array();
    for (const KolivandRow& row : run.rows)
        rows.push_back(
            {{"status", row.status},
             {"method", row.method},
             {"silhouette", name(row.axes.silhouette)},
             {"published", {{"fps", row.published}, {"share", row.published / run.rows.front().published}}},
             {"share", spreadJson(row.share)},
             {"build_ms", spreadJson(spreadOf(row.buildMs))},
             {"frame_ms", spreadJson(spreadOf(row.totalMs))}});
    const Json all{{"paper", "kolivand2011"}, {"table", 1},
                   {"scene", run.scene},      {"triangles", run.triangles},
                   {"width", run.width},      {"height", run.height},
                   {"frames", run.frames},    {"repeats", run.repeats},
                   {"device", run.device},    {"rows", rows}};
    return Json::array({all}).dump(2) + "\n";
}

std::string csvOf(const KolivandRun& run) {
    std::string text =
        csvLine({"status", "method", "silhouette", "published_fps", "published_share", "share", "share_low",
                 "share_high", "build_ms", "frame_ms", "frame_ms_low", "frame_ms_high"});
    for (const KolivandRow& row : run.rows) {
        std::vector<std::string> fields{row.status, row.method, name(row.axes.silhouette)};
        const Spread build = spreadOf(row.buildMs), frame = spreadOf(row.totalMs);
        for (const double value :
             {row.published, row.published / run.rows.front().published, row.share.median, row.share.low,
              row.share.high, build.median, frame.median, frame.low, frame.high})
            fields.push_back(fmt::format("{}", value));
        text += csvLine(fields);
    }
    return text;
}

std::string claimsOf(const KolivandRun& run, std::size_t width) {
    const auto& rows = run.rows;
    const auto ratio = [&](std::size_t part, std::size_t whole) {
        return spreadOf(ratios(rows[whole].totalMs, rows[part].totalMs));
    };
    const auto line = [&](const std::string& claim, double published, const Spread& ours, bool holds) {
        const std::string text =
            fmt::format("- {}: {}; published {:.3f}, here {}", claim, holds ? "confirmed" : "not confirmed",
                        published, spreadText(ours));
        return fmt::format("{}\n", wrapText(text, 2, width));
    };
    // Within the spread and 5 percent, "as fast" is as fast.
    const Spread visible = ratio(2, 1), map = ratio(3, 1);
    return line("visible-non visible has a lower frame rate than triangular",
                rows[2].published / rows[1].published, visible, visible.high < 1) +
           line("shadow mapping has the frame rate of triangular", rows[3].published / rows[1].published, map,
                map.median > 0.95 && map.median < 1.05);
}

}  // namespace

std::vector<KolivandRow> kolivandTable1() {
    Axes triangular = findMethod("heidmann")->axes;
    triangular.silhouette = Silhouette::Triangular;
    Axes visible = triangular;
    visible.silhouette = Silhouette::Visible;
    return {
        {.status = "without shadow", .published = 71.47, .method = "none", .axes = findMethod("none")->axes},
        {.status = "triangular algorithm", .published = 69.93, .method = "heidmann", .axes = triangular},
        {.status = "visible-non visible algorithm",
         .published = 65.51,
         .method = "heidmann",
         .axes = visible},
        {.status = "shadow mapping",
         .published = 70.03,
         .method = "williams",
         .axes = findMethod("williams")->axes}};
}

void compareRates(std::vector<KolivandRow>& rows) {
    const std::vector<double>& unshadowed = rows.front().totalMs;
    for (KolivandRow& row : rows) row.share = spreadOf(ratios(unshadowed, row.totalMs));
}

std::string showKolivand(const KolivandRun& run, const Page& page) {
    if (page.format == Format::Json) return jsonOf(run);
    if (page.format == Format::Csv) return csvOf(run);
    std::vector<std::vector<std::string>> table{
        {"status", "method", "published", "share", "share here", "build, ms", "frame, ms"}};
    for (const KolivandRow& row : run.rows)
        table.push_back({row.status, row.method, fmt::format("{:.2f}", row.published),
                         fmt::format("{:.3f}", row.published / run.rows.front().published),
                         spreadText(row.share), fmt::format("{:.3g}", spreadOf(row.buildMs).median),
                         fmt::format("{:.3g}", spreadOf(row.totalMs).median)});
    return fmt::format(
               "Kolivand and Sunar 2011, Table 1, beside {} ({} triangles) at {}x{}, {} frames\non {}\n\n",
               run.scene, run.triangles, run.width, run.height, run.frames, run.device) +
           alignColumns(table, page.width) + "\n" + claimsOf(run, page.width) +
           wrapText(
               "Published: frames per second. Share: of the frame rate without shadow, here the median "
               "(quartiles) "
               "of rounds in which all four were drawn in turn. Build: the host's part of a frame. "
               "Comparable: "
               "the shares. Not comparable: the rates themselves (a Pentium 4 of 2.8 GHz with an NVIDIA "
               "card), "
               "and the scene, which the paper does not give.",
               0, page.width) +
           "\n";
}

}  // namespace gnomon
