#include "report/plot_pen.h"

#include <cairo.h>

#include <iterator>

namespace gnomon {
namespace {

constexpr double kQuarterTurn = 1.5707963267948966;
constexpr PlotColour kPlotPaper{1, 1, 1};

// Okabe and Ito 2008, Color Universal Design: told apart with any colour vision. Without the yellow, which is
// too light on white.
constexpr PlotColour kColours[] = {
    {0, 0.447, 0.698}, {0.835, 0.369, 0},     {0, 0.62, 0.451}, {0.8, 0.475, 0.655},
    {0.902, 0.624, 0}, {0.337, 0.706, 0.914}, {0, 0, 0}};
constexpr std::size_t kColourCount = std::size(kColours), kSymbolCount = 8;

}  // namespace

PlotLook plotLook(std::size_t index) {
    // Seven colours and eight symbols have no common factor.
    return {kColours[index % kColourCount], PlotSymbol(index % kSymbolCount)};
}

void PlotPen::colour(const PlotColour& c) {
    cairo_set_source_rgb(m_context, c.r, c.g, c.b);
}

void PlotPen::font(double size, bool bold) {
    cairo_select_font_face(m_context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(m_context, size);
}

double PlotPen::widthOf(const std::string& text) {
    cairo_text_extents_t extents;
    cairo_text_extents(m_context, text.c_str(), &extents);
    return extents.x_advance;
}

void PlotPen::text(double x, double y, const std::string& text, Align align) {
    const double share = align == Align::Left ? 0 : align == Align::Centre ? 0.5 : 1;
    cairo_move_to(m_context, x - share * widthOf(text), y);
    cairo_show_text(m_context, text.c_str());
}

void PlotPen::halo(double x, double y, const std::string& text) {
    cairo_move_to(m_context, x, y);
    cairo_text_path(m_context, text.c_str());
    colour(kPlotPaper);
    cairo_set_line_width(m_context, 3);
    cairo_set_line_join(m_context, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(m_context);
}

void PlotPen::textUpwards(double x, double y, const std::string& text) {
    cairo_save(m_context);
    cairo_translate(m_context, x, y);
    cairo_rotate(m_context, -kQuarterTurn);
    this->text(0, 0, text, Align::Centre);
    cairo_restore(m_context);
}

void PlotPen::line(double x0, double y0, double x1, double y1, double width) {
    lines({{x0, y0}, {x1, y1}}, width);
}

void PlotPen::lines(const std::vector<std::pair<double, double>>& corners, double width) {
    if (corners.size() < 2) return;
    outline(corners);
    cairo_set_line_width(m_context, width);
    cairo_set_line_join(m_context, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(m_context);
}

void PlotPen::symbol(double x, double y, const PlotLook& look, bool marked) {
    const double r = marked ? kMarkedRadius : kSymbolRadius;
    const auto polygon = [&](std::vector<std::pair<double, double>> corners) {
        for (auto& [u, v] : corners) u = x + r * u, v = y + r * v;
        outline(corners);
        cairo_close_path(m_context);
    };
    cairo_new_path(m_context);
    switch (look.symbol) {
        case PlotSymbol::Circle:
            cairo_arc(m_context, x, y, r, 0, 4 * kQuarterTurn);
            break;
        case PlotSymbol::Square:
            polygon({{-.9, -.9}, {.9, -.9}, {.9, .9}, {-.9, .9}});
            break;
        case PlotSymbol::Triangle:
            polygon({{0, -1.15}, {1.1, .8}, {-1.1, .8}});
            break;
        case PlotSymbol::Diamond:
            polygon({{0, -1.25}, {1.1, 0}, {0, 1.25}, {-1.1, 0}});
            break;
        case PlotSymbol::TriangleDown:
            polygon({{0, 1.15}, {1.1, -.8}, {-1.1, -.8}});
            break;
        case PlotSymbol::Cross:
            polygon({{-1, -.6},
                     {-.6, -1},
                     {0, -.4},
                     {.6, -1},
                     {1, -.6},
                     {.4, 0},
                     {1, .6},
                     {.6, 1},
                     {0, .4},
                     {-.6, 1},
                     {-1, .6},
                     {-.4, 0}});
            break;
        case PlotSymbol::Plus:
            polygon({{-.35, -1.1},
                     {.35, -1.1},
                     {.35, -.35},
                     {1.1, -.35},
                     {1.1, .35},
                     {.35, .35},
                     {.35, 1.1},
                     {-.35, 1.1},
                     {-.35, .35},
                     {-1.1, .35},
                     {-1.1, -.35},
                     {-.35, -.35}});
            break;
        case PlotSymbol::Hexagon:
            polygon({{-.55, -1}, {.55, -1}, {1.1, 0}, {.55, 1}, {-.55, 1}, {-1.1, 0}});
            break;
    }
    colour(marked ? look.colour : kPlotPaper);
    cairo_fill_preserve(m_context);
    colour(look.colour);
    cairo_set_line_width(m_context, 1.5);
    cairo_stroke(m_context);
}

void PlotPen::fill(const PlotBox& box) {
    cairo_rectangle(m_context, box.x, box.y, box.width, box.height);
    cairo_fill(m_context);
}

void PlotPen::fillAll() {
    cairo_paint(m_context);
}

void PlotPen::outline(const std::vector<std::pair<double, double>>& corners) {
    cairo_move_to(m_context, corners[0].first, corners[0].second);
    for (const auto& [x, y] : corners) cairo_line_to(m_context, x, y);
}

}  // namespace gnomon
