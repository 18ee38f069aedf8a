#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "report/plot_labels.h"

typedef struct _cairo cairo_t;

namespace gnomon {

struct PlotColour {
    double r = 0, g = 0, b = 0;
};

enum class PlotSymbol { Circle, Square, Triangle, Diamond, TriangleDown, Cross, Plus, Hexagon };

/// What a series is drawn with.
struct PlotLook {
    PlotColour colour{};
    PlotSymbol symbol = PlotSymbol::Circle;
};

/// Of the series number @p index: no two of the first 56 alike.
PlotLook plotLook(std::size_t index);

constexpr double kSymbolRadius = 4.2, kMarkedRadius = 6;

enum class Align { Left, Centre, Right };

/// Draws on a Cairo context in its units, y downwards.
class PlotPen {
  public:
    explicit PlotPen(cairo_t* context) : m_context(context) {}

    void colour(const PlotColour& c);
    void font(double size, bool bold = false);
    double widthOf(const std::string& text);

    /// @param x,y  of the text's left end, middle or right end, on its base line
    void text(double x, double y, const std::string& text, Align align = Align::Left);
    /// A white edge round where text() would write.
    void halo(double x, double y, const std::string& text);
    /// Upwards, its middle at (x, y).
    void textUpwards(double x, double y, const std::string& text);

    void line(double x0, double y0, double x1, double y1, double width);
    void lines(const std::vector<std::pair<double, double>>& corners, double width);
    /// @param marked  filled and larger
    void symbol(double x, double y, const PlotLook& look, bool marked);
    void fill(const PlotBox& box);
    void fillAll();

  private:
    void outline(const std::vector<std::pair<double, double>>& corners);

    cairo_t* m_context;
};

}  // namespace gnomon
