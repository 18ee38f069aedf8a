#include "report/plot.h"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <cassert>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "image/image.h"
#include "image/whole_file.h"
#include "report/plot_sheet.h"

// Texts are drawn as outlines, so an SVG needs no fonts; its title and description name what it shows.

namespace gnomon {
namespace {

constexpr double kPixelsPerUnit = 1.5;

struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, Destroy>;
using Cairo = std::unique_ptr<cairo_t, Destroy>;

void check(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
}

void drawAll(cairo_surface_t* surface, const std::vector<Plot>& plots, double scale) {
    const Cairo context(cairo_create(surface));
    cairo_scale(context.get(), scale, scale);
    PlotPen pen(context.get());
    pen.colour({1, 1, 1});
    pen.fillAll();
    for (std::size_t i = 0; i < plots.size(); ++i) drawPlot(pen, plots[i], double(i) * kPlotHeight);
    check(cairo_status(context.get()));
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        const std::string as = c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
        out += as;
    }
    return out;
}

std::string svgOf(const std::vector<Plot>& plots) {
    std::string text;
    const auto append = [](void* to, const unsigned char* bytes, unsigned size) {
        static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), size);
        return CAIRO_STATUS_SUCCESS;
    };
    const double height = kPlotHeight * double(plots.size());
    const CairoSurface surface(cairo_svg_surface_create_for_stream(append, &text, kPlotWidth, height));
    drawAll(surface.get(), plots, 1);
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()));

    std::string about;
    for (const Plot& plot : plots) {
        about += fmt::format("{}{}", about.empty() ? "" : "; ", escaped(plot.title));
        if (!plot.subtitle.empty()) about += fmt::format(": {}", escaped(plot.subtitle));
    }
    // Cairo numbers all surfaces that a process has had.
    const std::string numbered = "<g id=\"surface";
    if (const std::size_t at = text.find(numbered); at != std::string::npos)
        text.replace(at, text.find('>', at) - at, "<g id=\"plots\"");
    const std::size_t root = text.find('>', text.find("<svg")) + 1;
    return text.insert(root,
                       fmt::format("\n<title>{}</title>\n<desc>{}</desc>", escaped(plots[0].title), about));
}

Image pictureOf(const std::vector<Plot>& plots) {
    const int width = int(kPlotWidth * kPixelsPerUnit),
              height = int(kPlotHeight * kPixelsPerUnit * double(plots.size()));
    const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
    check(cairo_surface_status(surface.get()));
    drawAll(surface.get(), plots, kPixelsPerUnit);
    cairo_surface_flush(surface.get());
    Image image{.width = width, .height = height, .channels = 3};
    const unsigned char* bytes = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            // One word per pixel, in the machine's byte order.
            const auto word = reinterpret_cast<const std::uint32_t*>(bytes + std::ptrdiff_t(y) * stride)[x];
            for (const int shift : {16, 8, 0}) image.data.push_back(std::uint8_t(word >> shift));
        }
    return image;
}

}  // namespace

void savePlots(const std::vector<Plot>& plots, const std::filesystem::path& file) {
    assert(!plots.empty());
    if (file.extension() == ".png") return writeImage(file, pictureOf(plots));
    if (file.extension() != ".svg")
        throw std::runtime_error(fmt::format("{}: a plot's name ends in .svg or .png", file.string()));
    writeWhole(file, [&](const std::filesystem::path& temporary) {
        std::ofstream stream(temporary, std::ios::binary);
        stream << svgOf(plots);
        if (!stream.flush()) throw std::runtime_error(std::generic_category().message(errno));
    });
}

}  // namespace gnomon
