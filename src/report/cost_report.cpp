#include "report/cost_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gl/stopwatch.h"
#include "report/cost_notes.h"
#include "report/json_csv.h"
#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

std::string number(auto value) {
    return fmt::format("{}", value);
}

std::string orDash(const std::optional<double>& value, int digits) {
    if (!value) return "-";
    return std::isinf(*value) ? "inf" : fmt::format("{:.{}f}", *value, digits);
}

std::string distanceText(const ErrorSum& error, double distance) {
    return error.measured ? fmt::format("{:.1f}", distance) : "-";
}

/// "*" on the frontier of time, "+" on that of touched pixels.
std::string marksOf(const CostRow& row) {
    return fmt::format("{}{}", row.onTimeFrontier ? "*" : "", row.onTouchedFrontier ? "+" : "");
}

bool isOnGpu(const CostStudy& study) {
    return study.clock == name(DrawClock::Gpu);
}

/// With what an automatic method has chosen, if that was always the same.
std::string nameOf(const CostRow& row) {
    if (row.drawnBy.empty() || row.drawnBy.find(',') != std::string::npos) return row.setting.name;
    return fmt::format("{} ({})", row.setting.name, row.drawnBy);
}

std::string errorTable(const CostStudy& study, std::size_t width) {
    std::vector<std::vector<std::string>> table{
        {"setting", "edge", "inside", "mean px", "max px", "RMS", "PSNR", "time", "quartiles"}};
    if (isOnGpu(study)) table[0].push_back("ms");
    table[0].push_back("");
    for (const CostRow& row : study.rows) {
        if (!row.isDrawn()) continue;
        const ErrorSum& e = row.error;
        table.push_back({nameOf(row), number(e.edge), number(e.interior), distanceText(e, e.meanDistance()),
                         distanceText(e, e.largestDistance), orDash(e.rms(), 2), orDash(e.psnr(), 1),
                         fmt::format("{:.2f}", row.ratio.median),
                         fmt::format("{:.2f}-{:.2f}", row.ratio.low, row.ratio.high)});
        if (isOnGpu(study)) table.back().push_back(fmt::format("{:.3f}", row.ms.median));
        table.back().push_back(marksOf(row));
    }
    return alignColumns(table, width);
}

/// All of one frame; touched pixels as multiples of the window's.
std::string countTable(const CostStudy& study, std::size_t width) {
    std::vector<std::vector<std::string>> table{
        {"setting", "passes", "vertices", "clear", "scene", "volume", "rectangle", "copy", "touched", ""}};
    const double frames = double(study.frames.size());
    for (const CostRow& row : study.rows) {
        if (!row.isDrawn()) continue;
        const PassCounts& p = row.passes;
        const TouchedPixels& t = row.amount.pixels;
        const auto mean = [&](auto sum) { return fmt::format("{:.3g}", double(sum) / frames); };
        const auto windows = [&](std::int64_t pixels) {
            return fmt::format("{:.2f}", double(pixels) / (frames * study.width * study.height));
        };
        table.push_back(
            {nameOf(row),
             fmt::format("{}/{}/{}/{}", mean(p.scene), mean(p.volume), mean(p.rectangle), mean(p.copy)),
             fmt::format("{:.0f}", double(row.amount.vertices) / frames), windows(t.clear), windows(t.scene),
             windows(t.volume), windows(t.rectangle), windows(t.copy), windows(t.total()),
             row.onTouchedFrontier ? "+" : ""});
    }
    return alignColumns(table, width);
}

/// All of one frame. Times by resource only where the chip has the rates.
std::string chipTable(const CostStudy& study, std::size_t width) {
    std::vector<std::string> head{"setting", "MB", "bus MB"};
    if (study.hasModelRates)
        for (const char* name : {"fill", "bandwidth", "triangles", "bus", "ms", "limit", ""})
            head.push_back(name);
    std::vector<std::vector<std::string>> table{head};
    const double frames = double(study.frames.size());
    for (const CostRow& row : study.rows) {
        if (!row.isDrawn()) continue;
        const ModelSum& m = row.model;
        const auto megabytes = [&](std::int64_t bytes) {
            return bytes ? fmt::format("{:.2f}", double(bytes) / (frames * 1e6)) : "-";
        };
        std::vector<std::string> line{nameOf(row), megabytes(m.bytes), megabytes(m.busBytes)};
        if (study.hasModelRates) {
            for (const double ms : {m.fillMs, m.bandwidthMs, m.triangleMs, m.busMs, m.ms})
                line.push_back(msText(ms / frames));
            line.push_back(limitText(m.limit));
            line.push_back(row.onModelFrontier ? "#" : "");
        }
        table.push_back(line);
    }
    return alignColumns(table, width);
}

std::string chipWords(const CostStudy& study) {
    std::string words =
        "What the chip moves for one frame, counted: MB in its frame buffer's memory (millions of bytes), "
        "bus "
        "MB between it and the host.";
    if (study.hasModelRates)
        return words +
               " fill to bus: milliseconds that each would take alone, by the chip's peak rates; ms: the "
               "frame, "
               "each pass as long as the slowest of them (a model, the least it can take, not measured); "
               "limit: what most of that is. # on the frontier of ms.";
    std::vector<std::string> missing;
    for (const CostRow& row : study.rows)
        for (const std::string& what : row.model.missing)
            if (std::find(missing.begin(), missing.end(), what) == missing.end()) missing.push_back(what);
    return missing.empty() ? words
                           : fmt::format("{} No time by the model: {}.", words, fmt::join(missing, ", "));
}

/// Settings of which the same is said share a line.
std::string undrawnText(const CostStudy& study, std::size_t width) {
    std::vector<std::pair<std::string, std::vector<std::string>>> wants;
    for (const CostRow& row : study.rows) {
        if (row.isDrawn()) continue;
        std::vector<std::string> lacks;
        for (const Missing& m : row.missing) lacks.push_back(m.what);
        const std::string want =
            row.failure.empty() ? fmt::format("{}", fmt::join(lacks, "; ")) : "FAILED: " + row.failure;
        const auto same =
            std::find_if(wants.begin(), wants.end(), [&](const auto& other) { return other.first == want; });
        if (same == wants.end())
            wants.push_back({want, {row.setting.name}});
        else
            same->second.push_back(row.setting.name);
    }
    std::string text;
    for (const auto& [want, names] : wants)
        text += fmt::format("  {}\n",
                            wrapText(fmt::format("{}: lacks {}", fmt::join(names, "; "), want), 4, width));
    return text.empty() ? text : fmt::format("Refused\n{}\n", text);
}

std::string framesText(const std::vector<int>& frames) {
    if (frames.size() == 1) return fmt::format("frame {}", frames.front());
    if (frames.size() <= 12) return fmt::format("frames {}", fmt::join(frames, ", "));
    return fmt::format("{} frames of {} to {}", frames.size(), frames.front(), frames.back());
}

std::string costText(const CostStudy& study, std::size_t width) {
    std::string text = fmt::format("{} on {}, {}x{}, {}: what accuracy costs\n\n", study.scene, study.profile,
                                   study.width, study.height, framesText(study.frames));
    const auto paragraph = [&](const std::string& words) {
        text += fmt::format("{}\n\n", wrapText(words, 0, width));
    };
    if (std::none_of(study.rows.begin(), study.rows.end(),
                     [](const CostRow& row) { return row.isDrawn(); })) {
        text += undrawnText(study, width);
        text.pop_back();  // no paragraph follows
        return text;
    }
    text += fmt::format("{}\n", errorTable(study, width));
    paragraph(fmt::format(
        "edge, inside: wrong pixels at the true boundary of shadows, and away from it{}. mean px, max px: "
        "their distance from that boundary, in pixels. RMS (levels of 255) and PSNR (dB): the image against "
        "the one that truth gives. time: of this {}, as a multiple of the unshadowed frame "
        "({:.2f} ms of it here; never the chip's time; none is that frame measured once more): median and "
        "quartiles of {} round{}{}, the best of {} drawings in each{}. On a frontier, where no other is both "
        "cheaper and more exact: * of time, + of "
        "touched pixels.",
        study.frames.size() > 1 ? ", in all frames" : "", isOnGpu(study) ? "GPU" : "processor",
        study.unshadowedMs, study.repeats, study.repeats == 1 ? "" : "s",
        study.frames.size() > 1 ? " in each frame" : "", kDrawingsPerRound,
        isOnGpu(study) ? "; ms: the frame itself" : ""));
    text += fmt::format("{}\n", countTable(study, width));
    paragraph(
        "The same on every machine, for one frame. passes: scene/volume/rectangle/copy. clear to touched: "
        "pixels that are rasterised, by what is drawn there (copy: texels), and all of them, as multiples of "
        "the window's.");
    text += fmt::format("{}\n", chipTable(study, width));
    paragraph(chipWords(study));
    text += undrawnText(study, width);
    if (study.framesCompared < int(study.frames.size()))
        paragraph(
            fmt::format("RMS and PSNR are of {} of {} frames: in the others no method was exact to "
                        "compare with.",
                        study.framesCompared, study.frames.size()));
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
}

int depthBitsOf(const CostRow& row) {
    const auto& bits = row.setting.way.profile.depthBits;
    return bits.empty() ? 0 : int(bits[0]);
}

Json orNull(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json rowJson(const CostStudy& study, const CostRow& row) {
    Json missing = Json::array();
    for (const Missing& m : row.missing) missing.push_back({{"what", m.what}, {"source", m.source}});
    const Axes& axes = row.setting.way.axes;
    Json json{{"setting", row.setting.name},
              {"method", methodId(axes)},
              {"drawn_by", row.drawnBy},
              {"profile", study.profile},
              {"depth_bits", depthBitsOf(row)},
              {"fidelity", name(row.setting.way.fidelity.fidelity)},
              {"scene", study.scene},
              {"width", study.width},
              {"height", study.height},
              {"frames", study.frames},
              {"missing", missing},
              {"failure", row.failure}};
    if (!row.isDrawn()) return json;
    const ErrorSum& e = row.error;
    const TouchedPixels& t = row.amount.pixels;
    const auto distance = [&](double value) { return e.measured ? Json(value) : Json(nullptr); };
    json["wrong"] = {{"edge", e.edge}, {"interior", e.interior}};
    json["tied"] = e.tied;
    json["boundary_distance"] = {{"mean", distance(e.meanDistance())},
                                 {"largest", distance(e.largestDistance)}};
    json["image"] = {{"rms", orNull(e.rms())}, {"psnr", orNull(e.psnr())}};
    json["passes"] = {{"scene", row.passes.scene},
                      {"volume", row.passes.volume},
                      {"rectangle", row.passes.rectangle},
                      {"copy", row.passes.copy}};
    json["vertices"] = row.amount.vertices;
    json["touched"] = {{"clear", t.clear},         {"scene", t.scene}, {"volume", t.volume},
                       {"rectangle", t.rectangle}, {"copy", t.copy},   {"total", t.total()}};
    const ModelSum& m = row.model;
    json["bytes"] = m.bytes;
    json["bus_bytes"] = m.busBytes;
    // Counts are sums over the frames, times those of one.
    const double frames = double(study.frames.size());
    const auto rated = [&](double ms) { return study.hasModelRates ? Json(ms / frames) : Json(nullptr); };
    json["model"] = {{"ms", rated(m.ms)},
                     {"fill_ms", rated(m.fillMs)},
                     {"bandwidth_ms", rated(m.bandwidthMs)},
                     {"triangles_ms", rated(m.triangleMs)},
                     {"bus_ms", rated(m.busMs)},
                     {"limit", m.limit && study.hasModelRates ? Json(name(*m.limit)) : Json(nullptr)},
                     {"missing", m.missing}};
    json["device"] = study.device;
    json["clock"] = study.clock;
    json["ms"] = {{"median", row.ms.median}, {"low", row.ms.low}, {"high", row.ms.high}};
    json["time_ratio"] = {{"median", row.ratio.median}, {"low", row.ratio.low}, {"high", row.ratio.high}};
    json["unshadowed_ms"] = study.unshadowedMs;
    json["repeats"] = study.repeats;
    json["frontier"] = {
        {"time", row.onTimeFrontier}, {"touched", row.onTouchedFrontier}, {"model", row.onModelFrontier}};
    return json;
}

}  // namespace

std::string showCost(const CostStudy& study, const Page& page) {
    if (page.format == Format::Text) return costText(study, page.width);
    Json all = Json::array();
    for (const CostRow& row : study.rows) all.push_back(rowJson(study, row));
    return page.format == Format::Csv ? csvOf(all) : all.dump(2) + "\n";
}

}  // namespace gnomon
