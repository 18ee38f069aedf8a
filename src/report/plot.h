#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// A point of a plot, in the units of its axes.
struct PlotPoint {
    double x = 0, y = 0;
    std::string label{};         ///< written beside it; empty: none
    bool marked = false;         ///< drawn larger and filled: it is on the frontier
    double xLow = 0, xHigh = 0;  ///< ends of a bar through it, where they differ
    double yLow = 0, yHigh = 0;
};

/// Points of one kind: of one colour and one symbol, named in the legend.
struct PlotSeries {
    std::string name{};
    std::vector<PlotPoint> points{};
    bool joined = false;   ///< by a line, in their order
    bool stepped = false;  ///< by a grey line that goes right first and then down, as a frontier does
    bool symbols = true;
    /// Which colour and symbol; series that say nothing take those of their place.
    std::optional<std::size_t> look{};
};

struct PlotAxis {
    std::string title{};
    bool logarithmic = false;  ///< its values are positive; 0 stands at the axis' foot, marked as 0
    std::string foot = "0";    ///< what is written there
    bool isWhole = false;      ///< linear: counted in whole numbers, no tick between two
    /// Points at 0 stand in a strip, each series on a line of its own, so that many have room: for the upward
    /// axis only.
    bool spreadsFoot = false;
};

struct Plot {
    std::string title{}, subtitle{};
    PlotAxis x{}, y{};
    std::vector<PlotSeries> series{};
};

/// Draws @p plots one below the other and writes them: SVG or PNG, by the ending of @p file. Each is 1000
/// units wide and 620 high; a PNG has 1.5 pixels per unit.
/// @pre the numbers are finite, and those of logarithmic axes not negative; there is a plot
/// @throws std::runtime_error  "file: what", for another ending or if it can't be written; then no file is
/// left
void savePlots(const std::vector<Plot>& plots, const std::filesystem::path& file);

}  // namespace gnomon
