#include "report/plot_sheet.h"

#include <algorithm>
#include <cmath>

#include "report/plot_labels.h"
#include "report/plot_scale.h"

namespace gnomon {
namespace {

constexpr double kMargin = 24;
constexpr double kTitleSize = 19, kTextSize = 13, kSmallSize = 11.5;
constexpr PlotColour kInk{0.13, 0.13, 0.13}, kSoftInk{0.36, 0.36, 0.36}, kGrid{0.88, 0.88, 0.88},
    kFaintGrid{0.945, 0.945, 0.945}, kStep{0.55, 0.55, 0.55}, kStrip{0.95, 0.97, 0.95};

/// Breaks @p text at blanks into lines no wider than @p width.
std::vector<std::string> broken(PlotPen& pen, const std::string& text, double width) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        const std::string longer = line.empty() ? word : line + " " + word;
        if (!line.empty() && pen.widthOf(longer) > width) {
            lines.push_back(line);
            line = word;
        } else {
            line = longer;
        }
        at = end + 1;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

/// One plot in the rectangle from (0, top).
class Sheet {
  public:
    Sheet(PlotPen& pen, const Plot& plot, double top) : m_pen(pen), m_plot(plot), m_top(top) {}

    void draw() {
        makeScales();
        title();
        layOut();
        axes();
        legend();
        for (std::size_t i = 0; i < m_plot.series.size(); ++i) lines(i);
        for (std::size_t i = 0; i < m_plot.series.size(); ++i) points(i);
        labels();
    }

  private:
    PlotPen& m_pen;
    const Plot& m_plot;
    double m_top;
    PlotScale m_x{}, m_y{};
    PlotBox m_area{};  ///< between the axes
    double m_legendWidth = 0;

    std::vector<std::size_t>
        m_lanes{};  ///< of the foot's strip, from the top: the series with zeros; or none

    double atX(double value) const { return m_area.x + m_x.at(value) * m_area.width; }
    double atY(double value) const { return m_area.y + (1 - m_y.at(value)) * m_area.height; }

    /// Where a point of series number @p index stands.
    double atY(std::size_t index, double value) const {
        if (value != 0 || m_lanes.empty()) return atY(value);
        const auto lane = std::find(m_lanes.begin(), m_lanes.end(), index);
        // Steps go down through all lanes.
        if (lane == m_lanes.end()) return m_area.y + m_area.height;
        return laneY(double(lane - m_lanes.begin()));
    }

    double laneY(double lane) const {
        const double top = 2 * m_y.footAt * (1 - (lane + 0.5) / double(m_lanes.size()));
        return m_area.y + (1 - top) * m_area.height;
    }

    /// Steps are grey: they belong to all series, and take no colour from them.
    PlotLook lookOfSeries(std::size_t index) const {
        if (m_plot.series[index].stepped) return {kStep, PlotSymbol::Circle};
        if (m_plot.series[index].look) return plotLook(*m_plot.series[index].look);
        std::size_t before = 0;
        for (std::size_t i = 0; i < index; ++i) before += !m_plot.series[i].stepped;
        return plotLook(before);
    }

    void makeScales() {
        std::vector<double> xs, ys;
        const auto add = [](std::vector<double>& all, double value, double low, double high) {
            all.push_back(value);
            if (low != high) all.insert(all.end(), {low, high});
        };
        for (const PlotSeries& series : m_plot.series)
            for (const PlotPoint& point : series.points) {
                add(xs, point.x, point.xLow, point.xHigh);
                add(ys, point.y, point.yLow, point.yHigh);
            }
        m_x = plotScale(xs, m_plot.x.logarithmic, 9, m_plot.x.foot, m_plot.x.isWhole);
        m_y = plotScale(ys, m_plot.y.logarithmic, 7, m_plot.y.foot, m_plot.y.isWhole);
        if (m_y.hasFoot && m_plot.y.spreadsFoot) makeLanes();
    }

    void makeLanes() {
        for (std::size_t i = 0; i < m_plot.series.size(); ++i) {
            const PlotSeries& series = m_plot.series[i];
            const bool hasZeros = std::any_of(series.points.begin(), series.points.end(),
                                              [](const PlotPoint& point) { return point.y == 0; });
            if (series.symbols && hasZeros) m_lanes.push_back(i);
        }
        if (m_lanes.empty()) return;
        // Half of the height is enough for however many.
        m_y.footAt = std::min(0.25, 0.035 * double(m_lanes.size()));
        m_y.aboveFoot = 2 * m_y.footAt + 0.05;
    }

    void title() {
        double y = m_top + 34;
        m_pen.colour(kInk);
        m_pen.font(kTitleSize, true);
        for (const std::string& line : broken(m_pen, m_plot.title, kPlotWidth - 2 * kMargin)) {
            m_pen.text(kMargin, y, line);
            y += 25;
        }
        m_pen.colour(kSoftInk);
        m_pen.font(kTextSize);
        for (const std::string& line : broken(m_pen, m_plot.subtitle, kPlotWidth - 2 * kMargin)) {
            m_pen.text(kMargin, y, line);
            y += 18;
        }
        m_area.y = y + 4;
    }

    void layOut() {
        m_pen.font(kSmallSize);
        double widest = 0;
        for (const PlotTick& tick : m_y.ticks) widest = std::max(widest, m_pen.widthOf(tick.text));
        m_pen.font(kTextSize);
        for (const PlotSeries& series : m_plot.series)
            if (!series.name.empty())
                m_legendWidth = std::max(m_legendWidth, m_pen.widthOf(series.name) + 44);
        m_area.x = kMargin + 24 + widest + 8;
        m_area.width = kPlotWidth - kMargin - m_area.x - (m_legendWidth > 0 ? m_legendWidth + 14 : 0);
        m_area.height = m_top + kPlotHeight - 62 - m_area.y;
    }

    void axes() {
        const double right = m_area.x + m_area.width, bottom = m_area.y + m_area.height;
        m_pen.font(kSmallSize);
        double lastEnd = -1;
        for (const PlotTick& tick : m_x.ticks) {
            const double x = atX(tick.value);
            m_pen.colour(tick.text.empty() ? kFaintGrid : kGrid);
            m_pen.line(x, m_area.y, x, bottom, 1);
            // Between two numbers there is room.
            const double half = m_pen.widthOf(tick.text) / 2;
            if (tick.text.empty() || x - half < lastEnd + 6) continue;
            m_pen.colour(kInk);
            m_pen.text(x, bottom + 18, tick.text, Align::Centre);
            lastEnd = x + half;
        }
        if (!m_lanes.empty()) {
            m_pen.colour(kStrip);
            m_pen.fill({m_area.x, bottom - 2 * m_y.footAt * m_area.height, m_area.width,
                        2 * m_y.footAt * m_area.height});
        }
        for (const PlotTick& tick : m_y.ticks) {
            const double y = atY(tick.value);
            m_pen.colour(tick.text.empty() ? kFaintGrid : kGrid);
            m_pen.line(m_area.x, y, right, y, 1);
            m_pen.colour(kInk);
            m_pen.text(m_area.x - 8, y + 4, tick.text, Align::Right);
        }
        m_pen.colour(kInk);
        m_pen.line(m_area.x, m_area.y, m_area.x, bottom, 1.2);
        m_pen.line(m_area.x, bottom, right, bottom, 1.2);
        gapAtFoot();
        m_pen.font(kTextSize);
        m_pen.colour(kInk);
        m_pen.text(m_area.x + m_area.width / 2, bottom + 44, m_plot.x.title, Align::Centre);
        m_pen.textUpwards(kMargin + 10, m_area.y + m_area.height / 2, m_plot.y.title);
    }

    /// Where the foot of an axis is cut off, of its length.
    static double gapOf(const PlotScale& scale) { return scale.aboveFoot - 0.03; }

    /// Two strokes across an axis where its foot is cut off from the rest.
    void gapAtFoot() {
        const double bottom = m_area.y + m_area.height;
        for (const double side : {-3.0, 3.0}) {
            if (m_y.hasFoot) {
                const double y = bottom - gapOf(m_y) * m_area.height + side;
                m_pen.line(m_area.x - 5, y + 3, m_area.x + 5, y - 3, 1.2);
            }
            if (m_x.hasFoot) {
                const double x = m_area.x + gapOf(m_x) * m_area.width + side;
                m_pen.line(x - 3, bottom + 5, x + 3, bottom - 5, 1.2);
            }
        }
    }

    void legend() {
        double y = m_area.y + 10;
        const double x = kPlotWidth - kMargin - m_legendWidth;
        m_pen.font(kTextSize);
        for (std::size_t i = 0; i < m_plot.series.size(); ++i) {
            const PlotSeries& series = m_plot.series[i];
            if (series.name.empty()) continue;
            const PlotLook look = lookOfSeries(i);
            m_pen.colour(look.colour);
            if (series.joined || series.stepped) m_pen.line(x, y, x + 30, y, series.stepped ? 2.5 : 1.8);
            if (series.symbols) m_pen.symbol(x + 15, y, look, false);
            m_pen.colour(kInk);
            m_pen.text(x + 38, y + 4.5, series.name);
            y += 22;
        }
    }

    std::vector<std::pair<double, double>> cornersOf(std::size_t index) const {
        const PlotSeries& series = m_plot.series[index];
        std::vector<std::pair<double, double>> corners;
        for (const PlotPoint& point : series.points) {
            const double x = atX(point.x), y = atY(index, point.y);
            if (series.stepped && !corners.empty()) corners.push_back({x, corners.back().second});
            corners.push_back({x, y});
        }
        return corners;
    }

    /// Where steps run.
    std::vector<PlotBox> stepBoxes() const {
        std::vector<PlotBox> boxes;
        for (std::size_t i = 0; i < m_plot.series.size(); ++i) {
            if (!m_plot.series[i].stepped) continue;
            const auto corners = cornersOf(i);
            for (std::size_t k = 1; k < corners.size(); ++k) {
                const auto& [x0, y0] = corners[k - 1];
                const auto& [x1, y1] = corners[k];
                boxes.push_back({std::min(x0, x1) - 2, std::min(y0, y1) - 2, std::abs(x1 - x0) + 4,
                                 std::abs(y1 - y0) + 4});
            }
        }
        return boxes;
    }

    void lines(std::size_t index) {
        const PlotSeries& series = m_plot.series[index];
        const PlotLook look = lookOfSeries(index);
        m_pen.colour(look.colour);
        const std::vector<std::pair<double, double>> corners = cornersOf(index);
        if (series.joined || series.stepped) m_pen.lines(corners, series.stepped ? 2.5 : 1.8);
        for (const PlotPoint& point : series.points) {
            const double x = atX(point.x), y = atY(index, point.y);
            if (point.xLow != point.xHigh) {
                const double left = atX(point.xLow), right = atX(point.xHigh);
                m_pen.line(left, y, right, y, 1.2);
                for (const double end : {left, right}) m_pen.line(end, y - 3, end, y + 3, 1.2);
            }
            if (point.yLow != point.yHigh) {
                const double low = atY(point.yLow), high = atY(point.yHigh);
                m_pen.line(x, low, x, high, 1.2);
                for (const double end : {low, high}) m_pen.line(x - 3, end, x + 3, end, 1.2);
            }
        }
    }

    void points(std::size_t index) {
        const PlotSeries& series = m_plot.series[index];
        const PlotLook look = lookOfSeries(index);
        if (!series.symbols) return;
        for (const bool marked : {false, true})
            for (const PlotPoint& point : series.points)
                if (point.marked == marked) m_pen.symbol(atX(point.x), atY(index, point.y), look, marked);
    }

    void labels() {
        std::vector<PlotBox> taken = stepBoxes();
        std::vector<PlotLabel> wanted;
        std::vector<std::pair<const PlotPoint*, PlotLook>> named;
        for (std::size_t i = 0; i < m_plot.series.size(); ++i)
            for (const PlotPoint& point : m_plot.series[i].points) {
                const double x = atX(point.x), y = atY(i, point.y), r = kMarkedRadius + 1;
                if (m_plot.series[i].symbols) taken.push_back({x - r, y - r, 2 * r, 2 * r});
                if (point.label.empty()) continue;
                m_pen.font(kSmallSize, point.marked);
                wanted.push_back({x, y, m_pen.widthOf(point.label), kSmallSize});
                named.push_back({&point, lookOfSeries(i)});
            }
        const std::vector<PlotBox> boxes = placeLabels(wanted, taken, m_area);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const PlotBox& box = boxes[i];
            const double nearX = std::clamp(wanted[i].x, box.x, box.x + box.width);
            const double nearY = std::clamp(wanted[i].y, box.y, box.y + box.height);
            m_pen.colour(kSoftInk);
            if (std::max(std::abs(nearX - wanted[i].x), std::abs(nearY - wanted[i].y)) > 14)
                m_pen.line(wanted[i].x, wanted[i].y, nearX, nearY, 0.7);
        }
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            m_pen.font(kSmallSize, named[i].first->marked);
            const double base = boxes[i].y + boxes[i].height - 2;
            m_pen.halo(boxes[i].x, base, named[i].first->label);
            m_pen.colour(kInk);
            m_pen.text(boxes[i].x, base, named[i].first->label);
        }
    }
};

}  // namespace

void drawPlot(PlotPen& pen, const Plot& plot, double top) {
    Sheet(pen, plot, top).draw();
}

}  // namespace gnomon
