#include "report/cost_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

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

/// With what an automatic method has chosen, if that was always the same.
std::string nameOf(const CostRow& row) {
    if (row.drawnBy.empty() || row.drawnBy.find(',') != std::string::npos) return row.setting.name;
    return fmt::format("{} ({})", row.setting.name, row.drawnBy);
}

std::string errorTable(const CostStudy& study) {
    std::vector<std::vector<std::string>> table{
        {"setting", "edge", "inside", "mean px", "max px", "RMS", "PSNR", "time", "quartiles", ""}};
    for (const CostRow& row : study.rows) {
        if (!row.isDrawn()) continue;
        const ErrorSum& e = row.error;
        table.push_back({nameOf(row), number(e.edge), number(e.interior), distanceText(e, e.meanDistance()),
                         distanceText(e, e.largestDistance), orDash(e.rms(), 2), orDash(e.psnr(), 1),
                         fmt::format("{:.2f}", row.ratio.median),
                         fmt::format("{:.2f}-{:.2f}", row.ratio.low, row.ratio.high), marksOf(row)});
    }
    return alignColumns(table);
}

/// All of one frame; touched pixels as multiples of the window's.
std::string countTable(const CostStudy& study) {
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
    return alignColumns(table);
}

/// Settings of which the same is said share a line.
std::string undrawnText(const CostStudy& study) {
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
        text += fmt::format("  {}\n", wrapText(fmt::format("{}: lacks {}", fmt::join(names, "; "), want), 4));
    return text.empty() ? text : fmt::format("Refused\n{}\n", text);
}

std::string framesText(const std::vector<int>& frames) {
    if (frames.size() == 1) return fmt::format("frame {}", frames.front());
    return fmt::format("{} frames, {} to {}", frames.size(), frames.front(), frames.back());
}

std::string costText(const CostStudy& study) {
    std::string text = fmt::format("{} on {}, {}x{}, {}: what accuracy costs\n\n", study.scene, study.profile,
                                   study.width, study.height, framesText(study.frames));
    const auto paragraph = [&](const std::string& words) {
        text += fmt::format("{}\n\n", wrapText(words, 0));
    };
    text += fmt::format("{}\n", errorTable(study));
    paragraph(fmt::format(
        "edge, inside: wrong pixels at the true boundary of shadows, and away from it{}. mean px, max px: "
        "their distance from that boundary, in pixels. RMS (levels of 255) and PSNR (dB): the image against "
        "the one that truth gives. time: of this processor, as a multiple of the unshadowed frame "
        "({:.2f} ms of it here; never the chip's time): median and quartiles of {} rounds, the best of {} "
        "drawings in each. On a frontier, where no other is both cheaper and more exact: * of time, + of "
        "touched pixels.",
        study.frames.size() > 1 ? ", in all frames" : "", study.unshadowedMs, study.repeats,
        kDrawingsPerRound));
    text += fmt::format("{}\n", countTable(study));
    paragraph(
        "The same on every machine, for one frame. passes: scene/volume/rectangle/copy. clear to touched: "
        "pixels that are rasterised, by what is drawn there (copy: texels), and all of them, as multiples of "
        "the window's.");
    text += undrawnText(study);
    if (study.framesCompared < int(study.frames.size()))
        paragraph(
            fmt::format("RMS and PSNR are of {} of {} frames: in the others no method was exact to "
                        "compare with.",
                        study.framesCompared, study.frames.size()));
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
}

Json orNull(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json rowJson(const CostStudy& study, const CostRow& row) {
    Json missing = Json::array();
    for (const Missing& m : row.missing) missing.push_back({{"what", m.what}, {"source", m.source}});
    const Axes& axes = row.setting.way.axes;
    Json json{
        {"setting", row.setting.name},
        {"method", methodId(axes)},
        {"drawn_by", row.drawnBy},
        {"profile", study.profile},
        {"depth_bits", row.setting.way.profile.depthBits.empty() ? 0 : row.setting.way.profile.depthBits[0]},
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
    json["time_ratio"] = {{"median", row.ratio.median}, {"low", row.ratio.low}, {"high", row.ratio.high}};
    json["unshadowed_ms"] = study.unshadowedMs;
    json["repeats"] = study.repeats;
    json["frontier"] = {{"time", row.onTimeFrontier}, {"touched", row.onTouchedFrontier}};
    return json;
}

std::string costCsv(const CostStudy& study) {
    std::string text = csvLine({"setting",
                                "method",
                                "drawn_by",
                                "profile",
                                "fidelity",
                                "scene",
                                "width",
                                "height",
                                "frames",
                                "missing",
                                "wrong_edge",
                                "wrong_interior",
                                "tied",
                                "distance_mean",
                                "distance_largest",
                                "rms",
                                "psnr",
                                "scene_passes",
                                "volume_passes",
                                "rectangles",
                                "copies",
                                "vertices",
                                "touched_clear",
                                "touched_scene",
                                "touched_volume",
                                "touched_rectangle",
                                "touched_copy",
                                "touched",
                                "time_ratio",
                                "time_ratio_low",
                                "time_ratio_high",
                                "time_frontier",
                                "touched_frontier"});
    for (const CostRow& row : study.rows) {
        std::vector<std::string> lacks;
        for (const Missing& m : row.missing) lacks.push_back(m.what);
        if (!row.failure.empty()) lacks.push_back(row.failure);
        std::vector<std::string> fields{row.setting.name,
                                        methodId(row.setting.way.axes),
                                        row.drawnBy,
                                        study.profile,
                                        name(row.setting.way.fidelity.fidelity),
                                        study.scene,
                                        number(study.width),
                                        number(study.height),
                                        fmt::format("{}", fmt::join(study.frames, " ")),
                                        fmt::format("{}", fmt::join(lacks, "; "))};
        const ErrorSum& e = row.error;
        const TouchedPixels& t = row.amount.pixels;
        const auto optional = [](const std::optional<double>& value) { return value ? number(*value) : ""; };
        const auto distance = [&](double value) { return e.measured ? number(value) : ""; };
        if (row.isDrawn())
            for (const std::string& field : {number(e.edge),
                                             number(e.interior),
                                             number(e.tied),
                                             distance(e.meanDistance()),
                                             distance(e.largestDistance),
                                             optional(e.rms()),
                                             optional(e.psnr()),
                                             number(row.passes.scene),
                                             number(row.passes.volume),
                                             number(row.passes.rectangle),
                                             number(row.passes.copy),
                                             number(row.amount.vertices),
                                             number(t.clear),
                                             number(t.scene),
                                             number(t.volume),
                                             number(t.rectangle),
                                             number(t.copy),
                                             number(t.total()),
                                             number(row.ratio.median),
                                             number(row.ratio.low),
                                             number(row.ratio.high),
                                             number(int(row.onTimeFrontier)),
                                             number(int(row.onTouchedFrontier))})
                fields.push_back(field);
        fields.resize(33);
        text += csvLine(fields);
    }
    return text;
}

}  // namespace

std::string showCost(const CostStudy& study, Format format) {
    if (format == Format::Text) return costText(study);
    if (format == Format::Csv) return costCsv(study);
    Json all = Json::array();
    for (const CostRow& row : study.rows) all.push_back(rowJson(study, row));
    return all.dump(2) + "\n";
}

}  // namespace gnomon
