#pragma once

#include "report/plot.h"
#include "report/plot_pen.h"

namespace gnomon {

constexpr double kPlotWidth = 1000, kPlotHeight = 620;  ///< of one plot, units

/// Draws @p plot in the rectangle below (0, top).
void drawPlot(PlotPen& pen, const Plot& plot, double top);

}  // namespace gnomon
