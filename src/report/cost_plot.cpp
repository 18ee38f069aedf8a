#include <fmt/format.h>

#include <algorithm>

#include "report/cost_report.h"

namespace gnomon {
namespace {

constexpr const char* kFrontier = "best bargains";

/// The kinds of methods, one colour each.
const std::vector<std::string> kMethodKinds{"no shadows",    "stencil",      "destination alpha",
                                            "colour buffer", "16-bit count", "shadow map",
                                            "smaller mask"};

/// Of what is drawn: an automatic method is of the kind that it has chosen, if that was always the same.
std::size_t kindOf(const CostRow& row) {
    const NamedMethod* chosen = findMethod(row.drawnBy);
    const Axes& axes = chosen ? chosen->axes : row.setting.way.axes;
    return axes.maskDivisor > 1 ? kMethodKinds.size() - 1 : std::size_t(axes.store);
}

/// Leaves of the labels of exact points that of the cheapest.
void nameCheapest(PlotSeries& series) {
    PlotPoint* cheapest = nullptr;
    for (PlotPoint& point : series.points) {
        if (point.y > 0 || point.label.empty()) continue;
        if (cheapest && !cheapest->marked && point.x < cheapest->x) cheapest->label.clear();
        if (!cheapest || point.x < cheapest->x)
            cheapest = &point;
        else if (!point.marked)
            point.label.clear();
    }
}

/// What a plot is about: the cost of a row, with its spread where it has one, and whether it is on the
/// frontier.
struct CostAxis {
    std::string title{}, cost{};
    std::string what{};  ///< "takes less time"
    double (*median)(const CostStudy&, const CostRow&) = nullptr;
    std::pair<double, double> (*ends)(const CostRow&) = nullptr;
    bool CostRow::*onFrontier = nullptr;
};

Plot costPlot(const CostStudy& study, const CostAxis& axis) {
    const double frames = double(study.frames.size());
    const auto errorOf = [&](const CostRow& row) { return row.error.wrong() / frames; };
    Plot plot{
        .title = fmt::format("{}: {}", study.scene, axis.title),
        .subtitle = fmt::format(
            "Every symbol is one way to draw the shadows of this scene on the chip \"{}\" ({}x{}, {}). "
            "The lower, the fewer pixels differ from exact ray tracing, on the bottom line none; the "
            "further left, {}. Filled symbols on the grey line are the best bargains: nothing else is "
            "both cheaper and more exact.",
            study.profile, study.width, study.height,
            study.frames.size() == 1 ? fmt::format("frame {}", study.frames.front())
                                     : fmt::format("mean of {} frames", study.frames.size()),
            axis.what),
        .x = {.title = axis.cost, .logarithmic = true},
        .y = {
            .title = "wrong pixels per frame", .logarithmic = true, .foot = "0: exact", .spreadsFoot = true}};

    for (std::size_t kind = 0; kind < kMethodKinds.size(); ++kind)
        plot.series.push_back({.name = kMethodKinds[kind], .look = kind});
    std::vector<const CostRow*> steps;
    for (const CostRow& row : study.rows) {
        if (!row.isDrawn()) continue;
        if (row.*axis.onFrontier) steps.push_back(&row);
        PlotPoint point{.x = axis.median(study, row), .y = errorOf(row), .marked = row.*axis.onFrontier};
        const bool isChip = row.setting.way.fidelity.fidelity == Fidelity::Chip;
        if (point.marked || row.setting.isNamed || (point.y > 0 && !isChip)) point.label = row.setting.name;
        if (axis.ends) std::tie(point.xLow, point.xHigh) = axis.ends(row);
        plot.series[kindOf(row)].points.push_back(point);
    }
    std::erase_if(plot.series, [](const PlotSeries& series) { return series.points.empty(); });
    // Many are exact.
    for (PlotSeries& series : plot.series) nameCheapest(series);

    PlotSeries frontier{.name = kFrontier, .stepped = true, .symbols = false};
    for (const CostRow* row : steps) frontier.points.push_back({axis.median(study, *row), errorOf(*row)});
    std::sort(frontier.points.begin(), frontier.points.end(), [](const PlotPoint& a, const PlotPoint& b) {
        return std::pair(a.x, -a.y) < std::pair(b.x, -b.y);
    });
    plot.series.insert(plot.series.begin(), std::move(frontier));
    return plot;
}

}  // namespace

std::vector<Plot> costPlots(const CostStudy& study) {
    const CostAxis time{
        .title = "what exact shadows cost in time",
        .cost =
            "time of a frame on this machine, as a multiple of the frame without shadows (bars: quartiles)",
        .what = "the less time this machine takes (not the chip)",
        .median = [](const CostStudy&, const CostRow& row) { return row.ratio.median; },
        .ends = [](const CostRow& row) { return std::pair(row.ratio.low, row.ratio.high); },
        .onFrontier = &CostRow::onTimeFrontier};
    const CostAxis touched{.title = "what exact shadows cost in pixels drawn",
                           .cost = "pixels rasterised per frame, as a multiple of the window",
                           .what = "the fewer pixels are rasterised, which is the same on every machine",
                           .median =
                               [](const CostStudy& s, const CostRow& row) {
                                   return double(row.amount.pixels.total()) /
                                          (double(s.width) * s.height * double(s.frames.size()));
                               },
                           .onFrontier = &CostRow::onTouchedFrontier};
    const CostAxis model{
        .title = "what exact shadows cost on the chip, by the model",
        .cost = "milliseconds of a frame by the chip's peak rates: the least that it can take, not measured",
        .what = "the less time the chip's fill rate, memory, triangle rate and bus allow",
        .median = [](const CostStudy& s,
                     const CostRow& row) { return row.model.ms / double(s.frames.size()); },
        .onFrontier = &CostRow::onModelFrontier};
    std::vector<Plot> plots{costPlot(study, time), costPlot(study, touched)};
    if (study.hasModelRates) plots.push_back(costPlot(study, model));
    return plots;
}

}  // namespace gnomon
