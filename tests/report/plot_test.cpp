// Plots: where values and labels stand, and the files that they become.

#include "report/plot.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "image/image.h"
#include "report/plot_labels.h"
#include "report/plot_pen.h"
#include "report/plot_scale.h"

namespace gnomon {
namespace plot_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> textsOf(const PlotScale& scale) {
    std::vector<std::string> texts;
    for (const PlotTick& tick : scale.ticks)
        if (!tick.text.empty()) texts.push_back(tick.text);
    return texts;
}

TEST(PlotScale, HasRoundTicks) {
    EXPECT_THAT(textsOf(plotScale({0, 59}, false, 7)), ElementsAre("0", "10", "20", "30", "40", "50", "60"));
    EXPECT_THAT(textsOf(plotScale({-0.3, 0.3}, false, 7)),
                ElementsAre("-0.3", "-0.2", "-0.1", "0.0", "0.1", "0.2", "0.3"));
    EXPECT_THAT(textsOf(plotScale({0, 30000}, false, 3)), ElementsAre("0", "10,000", "20,000", "30,000"));
    EXPECT_THAT(textsOf(plotScale({1, 3000}, true)), ElementsAre("1", "10", "100", "1,000"));
    EXPECT_THAT(textsOf(plotScale({1, 20}, true)), ElementsAre("1", "2", "5", "10", "20"));
}

TEST(PlotScale, StartsAtZeroWhereThatIsNear) {
    EXPECT_EQ(plotScale({2, 9}, false).low, 0);
    EXPECT_GT(plotScale({8, 9}, false).low, 0);
}

TEST(PlotScale, HasRoomForAllValuesAndATickWithANumber) {
    for (const bool logarithmic : {false, true})
        for (const auto& values : std::vector<std::vector<double>>{{},
                                                                   {1},
                                                                   {0},
                                                                   {0, 0},
                                                                   {1, 1.0001},
                                                                   {0.9, 1.1},
                                                                   {0, 1e-6},
                                                                   {1, 1e9},
                                                                   {0, 5, 4321},
                                                                   {1e-7, 1e7}}) {
            SCOPED_TRACE(fmt::format("{} of {}", logarithmic, testing::PrintToString(values)));
            const PlotScale scale = plotScale(values, logarithmic);
            for (const double value : values) {
                EXPECT_GE(scale.at(value), 0);
                EXPECT_LE(scale.at(value), 1);
            }
            EXPECT_GE(textsOf(scale).size(), 2u);
            EXPECT_LE(textsOf(scale).size(), 12u);
            for (const PlotTick& tick : scale.ticks) {
                EXPECT_GE(scale.at(tick.value), -1e-6);
                EXPECT_LE(scale.at(tick.value), 1 + 1e-6);
            }
        }
}

TEST(PlotScale, SetsZeroApartWhereItIsLogarithmic) {
    const PlotScale scale = plotScale({0, 1, 100}, true, 7, "0: exact");
    EXPECT_EQ(textsOf(scale).front(), "0: exact");
    EXPECT_EQ(scale.at(0), scale.footAt);
    EXPECT_GE(scale.at(1), scale.aboveFoot);
    // Equal factors are equal lengths.
    EXPECT_NEAR(scale.at(100) - scale.at(10), scale.at(10) - scale.at(1), 1e-12);
    EXPECT_FALSE(plotScale({1, 100}, true).hasFoot);
}

TEST(PlaceLabels, KeepsThemApartFromSymbolsAndEachOther) {
    // Twelve points in a row, closer than their labels are long.
    std::vector<PlotLabel> labels;
    std::vector<PlotBox> symbols;
    for (int i = 0; i < 12; ++i) {
        labels.push_back({100.0 + 20 * i, 100, 60, 12});
        symbols.push_back({95.0 + 20 * i, 95, 10, 10});
    }
    const PlotBox within{0, 0, 500, 200};
    const std::vector<PlotBox> boxes = placeLabels(labels, symbols, within);
    ASSERT_EQ(boxes.size(), labels.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (const PlotBox& symbol : symbols) EXPECT_EQ(boxes[i].overlap(symbol), 0) << i;
        for (std::size_t k = 0; k < i; ++k) EXPECT_EQ(boxes[i].overlap(boxes[k]), 0) << i << " " << k;
        EXPECT_NEAR(boxes[i].overlap(within), 60 * 12, 1e-9) << i;
    }
}

TEST(PlaceLabels, PutsALabelThatIsAloneAtItsPointsRight) {
    const PlotBox box = placeLabels({{100, 100, 60, 12}}, {}, {0, 0, 500, 200}).front();
    EXPECT_NEAR(box.x, 109, 1e-9);
    EXPECT_NEAR(box.y + box.height / 2, 100, 1e-9);
}

TEST(PlotLook, IsAnotherForEachOfFiftySixSeries) {
    std::set<std::tuple<double, double, double, PlotSymbol>> looks;
    for (std::size_t i = 0; i < 56; ++i) {
        const PlotLook look = plotLook(i);
        looks.insert({look.colour.r, look.colour.g, look.colour.b, look.symbol});
    }
    EXPECT_EQ(looks.size(), 56u);
}

class PlotFile : public testing::Test {
  protected:
    PlotFile() {
        std::string name = std::filesystem::temp_directory_path() / "gnomon-plot-XXXXXX";
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        m_folder = name;
    }
    ~PlotFile() override { std::filesystem::remove_all(m_folder); }

    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(m_folder))
            names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

    std::string content(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream(m_folder / name, std::ios::binary).rdbuf();
        return text.str();
    }

    std::filesystem::path m_folder{};
};

Plot somePlot() {
    Plot plot{.title = "error < time & \"more\"",
              .subtitle = "in plain words",
              .x = {.title = "time", .logarithmic = true},
              .y = {.title = "error", .logarithmic = true, .foot = "0: exact"}};
    plot.series.push_back(
        {.name = "frontier", .points = {{1, 100}, {2, 0}}, .stepped = true, .symbols = false});
    plot.series.push_back(
        {.name = "method",
         .points = {{.x = 1, .y = 100, .label = "a", .marked = true, .xLow = 0.9, .xHigh = 1.2},
                    {.x = 2, .y = 0, .label = "b"}}});
    return plot;
}

/// Whether each element of an XML text is closed, in order, and no "&" or "<" stands by itself.
bool isWellFormed(const std::string& xml) {
    std::vector<std::string> open;
    int roots = 0;
    for (std::size_t at = 0; at < xml.size(); ++at) {
        if (xml[at] == '&') {
            const std::size_t end = xml.find(';', at);
            const std::string entity = end == std::string::npos ? "" : xml.substr(at, end - at + 1);
            if (entity != "&lt;" && entity != "&gt;" && entity != "&amp;" && entity != "&quot;") return false;
        }
        if (xml[at] == '>') return false;
        if (xml[at] != '<') continue;
        const std::size_t end = xml.find('>', at);
        if (end == std::string::npos) return false;
        const std::string tag = xml.substr(at + 1, end - at - 1);
        at = end;
        if (tag.starts_with("?") || tag.starts_with("!")) continue;
        if (std::count(tag.begin(), tag.end(), '"') % 2 != 0 || tag.find('<') != std::string::npos)
            return false;
        const std::string name = tag.substr(0, tag.find_first_of(" \n/", 1));
        if (tag.starts_with("/")) {
            if (open.empty() || open.back() != tag.substr(1)) return false;
            open.pop_back();
        } else {
            if (open.empty() && ++roots > 1) return false;
            if (!tag.ends_with("/")) open.push_back(name);
        }
    }
    return open.empty() && roots == 1;
}

TEST(IsWellFormed, KnowsWhatIsNot) {
    EXPECT_TRUE(isWellFormed("<?xml?><a b=\"c\"><d/>&lt;</a>"));
    for (const char* bad : {"<a>", "<a></b>", "<a/><a/>", "<a>&</a>", "<a", "<a b=\"></a>", ""})
        EXPECT_FALSE(isWellFormed(bad)) << bad;
}

TEST_F(PlotFile, OfSvgIsWellFormedAndNamesWhatItShows) {
    savePlots({somePlot()}, m_folder / "a.svg");
    const std::string svg = content("a.svg");
    EXPECT_TRUE(isWellFormed(svg));
    EXPECT_THAT(svg, HasSubstr("<svg "));
    EXPECT_THAT(svg, HasSubstr("<title>error &lt; time &amp; \"more\"</title>"));
    EXPECT_THAT(svg, HasSubstr(": in plain words</desc>"));
}

TEST_F(PlotFile, OfPngHasThePlotsOneBelowTheOther) {
    savePlots({somePlot()}, m_folder / "one.png");
    savePlots({somePlot(), somePlot()}, m_folder / "two.png");
    const Image one = readImage(m_folder / "one.png"), two = readImage(m_folder / "two.png");
    EXPECT_EQ(one.width, 1500);
    EXPECT_EQ(one.height, 930);
    EXPECT_EQ(one.channels, 3);
    EXPECT_EQ(two.height, 2 * one.height);
    // The upper half is the plot itself, and so is the lower.
    const auto half = std::ptrdiff_t(one.data.size());
    EXPECT_TRUE(std::equal(one.data.begin(), one.data.end(), two.data.begin()));
    EXPECT_FALSE(std::all_of(two.data.begin() + half, two.data.end(), [](auto byte) { return byte == 255; }));
}

/// Pixels of @p image with exactly this colour.
long pixelsOf(const Image& image, int r, int g, int b) {
    long count = 0;
    for (std::size_t i = 0; i < image.data.size(); i += 3)
        count += image.data[i] == r && image.data[i + 1] == g && image.data[i + 2] == b;
    return count;
}

TEST_F(PlotFile, ShowsAMarkedPointFilledAndAnotherOpen) {
    Plot plot = somePlot();
    plot.series.erase(plot.series.begin());
    plot.series[0].points = {{.x = 1, .y = 1}, {.x = 10, .y = 10}};
    savePlots({plot}, m_folder / "open.png");
    plot.series[0].points[0].marked = true;
    savePlots({plot}, m_folder / "marked.png");
    // The first colour, 0, 0.447, 0.698, as it fills a circle of radius 9 pixels but not a ring.
    const long open = pixelsOf(readImage(m_folder / "open.png"), 0, 114, 178);
    const long marked = pixelsOf(readImage(m_folder / "marked.png"), 0, 114, 178);
    EXPECT_GT(open, 0);
    EXPECT_GT(marked, open + 100);
}

TEST_F(PlotFile, IsTheSameEachTime) {
    for (const char* name : {"a.svg", "b.svg"}) savePlots({somePlot()}, m_folder / name);
    EXPECT_TRUE(content("a.svg") == content("b.svg"));
}

TEST_F(PlotFile, MayShowNothing) {
    savePlots({Plot{.title = "empty", .y = {.logarithmic = true}}}, m_folder / "empty.svg");
    EXPECT_TRUE(isWellFormed(content("empty.svg")));
}

std::string errorOf(const std::filesystem::path& file) {
    try {
        savePlots({somePlot()}, file);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "no error";
}

TEST_F(PlotFile, OfAnotherKindIsRefused) {
    const auto file = m_folder / "a.pdf";
    EXPECT_EQ(errorOf(file), file.string() + ": a plot's name ends in .svg or .png");
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(PlotFile, AppearsWholeOrNotAtAll) {
    for (const char* ending : {".svg", ".png"}) {
        const std::string fine = fmt::format("a{}", ending), name = fmt::format("folder{}", ending);
        EXPECT_THAT(errorOf(m_folder / "missing" / fine), HasSubstr(fmt::format("missing/{}: ", fine)));
        // What can't be replaced stays, and nothing else is left.
        std::filesystem::create_directories(m_folder / name / "inside");
        EXPECT_THAT(errorOf(m_folder / name), HasSubstr(name + ": "));
        EXPECT_THAT(files(), ElementsAre(name));
        std::filesystem::remove_all(m_folder / name);

        savePlots({somePlot()}, m_folder / fine);
        EXPECT_THAT(files(), ElementsAre(fine));
        std::filesystem::remove(m_folder / fine);
    }
}

}  // namespace plot_test
}  // namespace gnomon
