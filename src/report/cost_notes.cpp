#include "report/cost_notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

Json limitJson(const std::optional<Resource>& limit) {
    return limit ? Json(name(*limit)) : Json();
}

}  // namespace

std::string msText(double ms) {
    return ms > 0 ? fmt::format("{:.2f}", ms) : "-";
}

std::string limitText(const std::optional<Resource>& limit) {
    return limit ? name(*limit) : "-";
}

std::string costText(const CostNotes& notes, std::size_t width) {
    const FrameCost& cost = notes.minimal;
    std::string text;
    const auto line = [&](const std::string& words) {
        text += fmt::format("{}\n", wrapText(words, 2, width));
    };
    if (!notes.hasTimes()) {
        line(fmt::format("No time by the model: {}.", fmt::join(cost.missing, ", ")));
        return text;
    }
    line(fmt::format(
        "By a model of peak rates, not measured: at least {} ms, at most {:.1f} frames per second, "
        "limited by {}; the full plan at least {} ms.",
        msText(cost.ms()), cost.framesPerSecond(), limitText(cost.limit()), msText(notes.full.ms())));
    line(fmt::format("rates: {}", fmt::join(notes.rates, "; ")));
    line(cost.hostMs > 0
             ? fmt::format(
                   "the processor takes {} ms for the frame, as --host-ms says, beside the chip's {} ms",
                   msText(cost.hostMs), msText(cost.chipMs()))
             : std::string("left out: the processor's own work (--host-ms), sampled textures, scan-out"));
    for (const std::string& what : cost.missing) line(fmt::format("left out: {}", what));
    return text;
}

Json toJson(const PassCost& pass) {
    const PassTraffic& t = pass.traffic;
    return {{"ms", pass.ms()},
            {"limit", limitJson(pass.limit())},
            {"fill_ms", pass.fillMs},
            {"bandwidth_ms", pass.bandwidthMs},
            {"triangles_ms", pass.triangleMs},
            {"bus_ms", pass.busMs},
            {"fragments", t.fragments},
            {"passed", t.passed},
            {"bytes", t.bytes()},
            {"bus_bytes", t.busBytes}};
}

Json toJson(const FrameCost& frame) {
    const auto time = [&](double value) { return frame.ms() > 0 ? Json(value) : Json(); };
    return {{"ms", time(frame.ms())},
            {"chip_ms", time(frame.chipMs())},
            {"host_ms", frame.hostMs},
            {"frames_per_second", time(frame.framesPerSecond())},
            {"limit", limitJson(frame.limit())},
            {"bytes", frame.bytes()},
            {"missing", frame.missing}};
}

Json toJson(const CostNotes& notes) {
    Json json = toJson(notes.minimal);
    json["rates"] = notes.rates;
    json["full"] = toJson(notes.full);
    return json;
}

}  // namespace gnomon
