#include "report/reproduce_usta2019.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "report/spread_text.h"
#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

/// "As fast as": within this share.
constexpr double kAsFast = 0.05;

std::string jsonOf(const UstaRun& run) {
    Json scenes = Json::array();
    for (const UstaScene& scene : run.scenes) {
        Json lines = Json::array();
        for (const UstaLine& line : scene.lines)
            lines.push_back({{"method", line.method},
                             {"called", line.called},
                             {"volumes", line.byShader ? "shader" : "host"},
                             {"ms", line.ms},
                             {"ratio", spreadJson(spreadOf(line.ratios))},
                             {"wrong", line.wrong},
                             {"frames_wrong", line.framesWrong}});
        scenes.push_back({{"scene", scene.scene}, {"triangles", scene.triangles}, {"lines", lines}});
    }
    const Json all{{"paper", "usta2019"},  {"figure", 4},          {"width", run.width},
                   {"height", run.height}, {"frames", run.frames}, {"repeats", run.repeats},
                   {"device", run.device}, {"scenes", scenes}};
    return Json::array({all}).dump(2) + "\n";
}

std::string csvOf(const UstaRun& run) {
    std::string text = csvLine({"scene", "method", "volumes", "frame", "ms", "ratio"});
    for (const UstaScene& scene : run.scenes)
        for (const UstaLine& line : scene.lines)
            for (std::size_t i = 0; i < line.ms.size(); ++i)
                text += csvLine({scene.scene, line.method, line.byShader ? "shader" : "host",
                                 fmt::format("{}", i), fmt::format("{:.4f}", line.ms[i]),
                                 fmt::format("{:.4f}", line.ratios[i])});
    return text;
}

const UstaLine* find(const UstaScene& scene, const std::string& method, bool byShader) {
    const auto at = std::find_if(scene.lines.begin(), scene.lines.end(), [&](const UstaLine& line) {
        return line.method == method && line.byShader == byShader;
    });
    return at == scene.lines.end() ? nullptr : &*at;
}

/// The methods from the fastest to the slowest, of those whose volumes are made the same way; "=" where the
/// quartiles of their ratio hold 1.
std::string orderOf(const UstaScene& scene, bool byShader) {
    std::vector<const UstaLine*> lines;
    for (const UstaLine& line : scene.lines)
        if (line.byShader == byShader) lines.push_back(&line);
    std::stable_sort(lines.begin(), lines.end(), [](const UstaLine* a, const UstaLine* b) {
        return spreadOf(a->ms).median < spreadOf(b->ms).median;
    });
    std::string text = lines.empty() ? "" : lines[0]->called;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const Spread ratio = spreadOf(ratios(lines[i]->ms, lines[i - 1]->ms));
        text += fmt::format("{}{}", ratio.low > 1 ? " < " : " = ", lines[i]->called);
    }
    return text;
}

std::string claimsOf(const UstaScene& scene) {
    std::string text = fmt::format("- order, volumes by the host: {}\n- order, volumes by the shader: {}\n",
                                   orderOf(scene, false), orderOf(scene, true));
    if (const UstaLine* atomic = find(scene, "atomiczp", true)) {
        const Spread ratio = spreadOf(atomic->ratios);
        text += fmt::format("- AtomicZP is as fast as Z-Pass (by the same shader, within {:.0f} %): {}, {}\n",
                            100 * kAsFast, std::abs(ratio.median - 1) <= kAsFast ? "confirmed" : "refuted",
                            spreadText(ratio));
    }
    for (const bool byShader : {true, false}) {
        const UstaLine* other = find(scene, "eisemann", byShader);
        if (!other) continue;
        const Spread ratio = spreadOf(other->ratios);
        text += fmt::format("- ++ZP is slower than Z-Pass ({}): {}, {}\n",
                            byShader ? "by the same shader" : "volumes by the host",
                            ratio.low > 1 ? "confirmed" : "not confirmed", spreadText(ratio));
    }
    if (const UstaLine* zfail = find(scene, "carmack", false)) {
        const Spread ratio = spreadOf(zfail->ratios);
        text += fmt::format("- Z-Fail is slower than Z-Pass (volumes by the host): {}, {}\n",
                            ratio.low > 1 ? "confirmed" : "not confirmed", spreadText(ratio));
    }
    return text;
}

}  // namespace

std::string showUsta(const UstaRun& run, const Page& page) {
    if (page.format == Format::Json) return jsonOf(run);
    if (page.format == Format::Csv) return csvOf(run);
    std::string text = fmt::format(
        "Usta et al. 2019, Figure 4: time of making the stencil mask, {}x{}, {} frames of each path\non {}\n",
        run.width, run.height, run.frames, run.device);
    for (const UstaScene& scene : run.scenes) {
        std::vector<std::vector<std::string>> table{
            {"method", "volumes by", "ms here", "to Z-Pass", "wrong pixels", "in frames"}};
        for (const UstaLine& line : scene.lines)
            table.push_back({line.called, line.byShader ? "shader" : "host", spreadText(spreadOf(line.ms)),
                             spreadText(spreadOf(line.ratios)), fmt::format("{}", line.wrong),
                             fmt::format("{}", line.framesWrong)});
        text += fmt::format("\n{} ({} triangles)\n\n{}\n{}", scene.scene, scene.triangles,
                            alignColumns(table, page.width), claimsOf(scene));
    }
    return text + "\n" +
           wrapText(
               fmt::format("Time: what the host builds and what the passes of the mask take, from the "
                           "first that draws volumes or casters to the last; median (quartiles) over the "
                           "frames, of each the median of {} rounds in which all methods were drawn in "
                           "turn. To Z-Pass: the ratio within a round, to the Z-Pass whose volumes are "
                           "made the same way.",
                           run.repeats),
               0, page.width) +
           "\n" +
           wrapText(
               "Comparable: order and ratios of the methods that share a builder; the paper makes all "
               "volumes in geometry shaders, on a GTX 1080 Ti. Not comparable: times, and the share of "
               "the geometry in them: a software rasteriser runs shaders on the host.",
               0, page.width) +
           "\n";
}

std::vector<Plot> ustaPlots(const UstaRun& run) {
    std::vector<Plot> plots;
    for (const UstaScene& scene : run.scenes) {
        // A panel for each: shaders take tens of times what the host takes.
        for (const bool byShader : {false, true}) {
            Plot plot{
                .title = fmt::format("Making the stencil mask of {}, volumes by the {}",
                                     std::filesystem::path(scene.scene).filename().string(),
                                     byShader ? "shader" : "host"),
                .subtitle = fmt::format("{} triangles, {}x{}; Usta et al. 2019, Figure 4; time on this "
                                        "machine, {}; of each frame the median of {} rounds",
                                        scene.triangles, run.width, run.height, run.device, run.repeats),
                .x = {.title = "frame of the camera path", .isWhole = true},
                .y = {.title = "milliseconds"}};
            for (const UstaLine& line : scene.lines) {
                if (line.byShader != byShader) continue;
                PlotSeries series{.name = line.called, .joined = true};
                for (std::size_t i = 0; i < line.ms.size(); ++i)
                    series.points.push_back({.x = double(i), .y = line.ms[i]});
                plot.series.push_back(std::move(series));
            }
            if (!plot.series.empty()) plots.push_back(std::move(plot));
        }
    }
    return plots;
}

}  // namespace gnomon
