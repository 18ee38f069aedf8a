// Table 2 of Roettger, Irion and Ertl 2002: the published figures, the fit of the unknowns, the orders.

#include "report/reproduce_roettger2002_table2.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon {
namespace reproduce_roettger2002_table2_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// As printed; the last of the row of 1024 is in the text of section 5.
TEST(RoettgerTable2, HasThePublishedFigures) {
    std::vector<std::string> cells;
    for (const Table2Cell& cell : roettgerTable2())
        cells.push_back(fmt::format("{} {} {}", cell.size, name(cell.column), cell.published));
    EXPECT_THAT(cells, ElementsAre("256 screen 40.8", "256 alpha 42.4", "256 stencil 42.4", "256 half 39.1",
                                   "256 no shadows 90.4", "512 screen 29.9", "512 alpha 33.6",
                                   "512 stencil 29.1", "512 half 30.5", "512 no shadows 89.2",
                                   "1024 screen 9.3", "1024 alpha 10.2", "1024 stencil 8.9", "1024 half 15.7",
                                   "1024 quarter 23.6", "1024 no shadows 44.6"));
}

PassCost pass(PassKind kind, double fillMs, double triangleMs = 0) {
    return {.kind = kind, .fillMs = fillMs, .triangleMs = triangleMs};
}

/// A frame whose passes take times that grow with the pixels, in milliseconds at 1024x1024: a clear of 3, a
/// scene of 5 or two, volumes of 0.6 to 2, a rectangle of 3.
FrameCost frameOf(Column column, int size) {
    const double share = double(size) * size / (1024.0 * 1024);
    const double mask = column == Column::Half ? 0.25 : column == Column::Quarter ? 1 / 16.0 : 1;
    FrameCost frame;
    frame.passes = {pass(PassKind::Clear, 3 * share), pass(PassKind::Scene, 5 * share)};
    if (column == Column::None) return frame;
    if (column != Column::Alpha && column != Column::Stencil)
        frame.passes.push_back(pass(PassKind::Scene, 5 * share * mask));
    frame.passes.push_back(
        pass(PassKind::Volume, (column == Column::Stencil ? 0.6 : 2) * share * mask, 0.001));
    frame.passes.push_back(pass(PassKind::Rectangle, 3 * share * mask));
    return frame;
}

/// Cells whose published rates are those of the model with @p unknowns.
std::vector<Table2Cell> cellsFor(const Unknowns& unknowns) {
    std::vector<Table2Cell> cells = roettgerTable2();
    for (Table2Cell& cell : cells) {
        cell.frames = {frameOf(cell.column, cell.size), frameOf(cell.column, cell.size)};
        cell.published = 1000 / modelMs(cell, unknowns);
    }
    return cells;
}

TEST(ModelMs, IsTheSlowerOfHostAndChipOrTheirSum) {
    Table2Cell cell{.column = Column::Screen, .size = 1024};
    cell.frames = {{.passes = {pass(PassKind::Clear, 1), pass(PassKind::Scene, 2),
                               pass(PassKind::Volume, 3, 10), pass(PassKind::Scene, 2)}}};
    EXPECT_DOUBLE_EQ(modelMs(cell, {}), 1 + 2 + 10 + 2);
    EXPECT_DOUBLE_EQ(modelMs(cell, {.volumes = 5, .scene = 2}), 1 + 4 + 15 + 4) << "triangles are as many";
    EXPECT_DOUBLE_EQ(modelMs(cell, {.hostMs = 20}), 20);
    EXPECT_DOUBLE_EQ(modelMs(cell, {.hostMs = 20, .takesTurns = true}), 35);
    EXPECT_DOUBLE_EQ(modelMs(cell, {.hostMs = 20, .hostVolumesMs = 3, .hostSceneMs = 4}), 27);
    cell.column = Column::None;
    EXPECT_DOUBLE_EQ(modelMs(cell, {.hostMs = 20, .hostVolumesMs = 3}), 20) << "there are no volumes";
}

TEST(FromUnshadowed, HasHostAndSceneOfTheUnshadowedFrames) {
    for (const bool takesTurns : {false, true}) {
        const auto cells = cellsFor({.scene = 3, .hostMs = 7, .takesTurns = takesTurns});
        const Unknowns u = fromUnshadowed(cells, takesTurns);
        EXPECT_NEAR(u.scene, 3, 1e-6) << "1e-6: halved a hundred times from 100";
        EXPECT_NEAR(u.hostMs, 7, 1e-6);
        EXPECT_EQ(u.takesTurns, takesTurns);
    }
}

TEST(FitTable2, FindsTheNumbersThatTheTimesWereMadeWith) {
    const Unknowns one{.volumes = 17, .scene = 2, .hostMs = 9};
    Unknowns two = one, three = one;
    two.hostVolumesMs = 12;
    three.hostVolumesMs = 12, three.hostSceneMs = 2.5;
    const auto expectFound = [](FreeNumbers numbers, const Unknowns& wanted) {
        const Table2Fit fit = fitTable2(cellsFor(wanted), numbers, wanted.takesTurns);
        // The last of six rounds steps by 40 ms / 8^5 / 16, and by 1e-5 in the logarithm.
        EXPECT_NEAR(fit.unknowns.volumes, wanted.volumes, 0.02);
        EXPECT_NEAR(fit.unknowns.hostVolumesMs, wanted.hostVolumesMs, 0.02);
        EXPECT_NEAR(fit.unknowns.hostSceneMs, wanted.hostSceneMs, 0.02);
        EXPECT_LT(fit.rms, 1e-3);
    };
    expectFound(FreeNumbers::Volumes, one);
    expectFound(FreeNumbers::AndHost, two);
    expectFound(FreeNumbers::AndScene, three);
    two.takesTurns = true;
    expectFound(FreeNumbers::AndHost, two);
}

TEST(FitTable2, ReportsResidualsAndTheWorstOfThem) {
    auto cells = cellsFor({.volumes = 17, .scene = 2, .hostMs = 9});
    cells[13].published *= 2;  // half at 1024
    const Table2Fit fit = fitTable2(cells, FreeNumbers::Volumes);
    EXPECT_EQ(fit.worst, 13u);
    EXPECT_GT(fit.residuals[13], 0.4) << "the model's time is up to twice the published one";
    EXPECT_GT(fit.rms, 0.1);
    double squares = 0;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells[i].column != Column::None) squares += fit.residuals[i] * fit.residuals[i];
    EXPECT_NEAR(fit.rms, std::sqrt(squares / 13), 1e-12);
}

TEST(OrderLine, IsAsPublishedIfTheFasterTakesLess) {
    EXPECT_TRUE((OrderLine{.fasterMs = 1, .slowerMs = 2}.isAsPublished()));
    EXPECT_FALSE((OrderLine{.fasterMs = 2, .slowerMs = 1}.isAsPublished()));
    EXPECT_FALSE((OrderLine{.fasterMs = 1, .slowerMs = 1}.isAsPublished()));
    EXPECT_TRUE((OrderLine{.mayBeEqual = true, .fasterMs = 1, .slowerMs = 1}.isAsPublished()));
    EXPECT_FALSE((OrderLine{.mayBeEqual = true, .fasterMs = 2, .slowerMs = 1}.isAsPublished()));
}

TEST(OrderLines, NameTheTermsThatMakeTheDifference) {
    const Unknowns unknowns{.volumes = 10};
    const auto lines = orderLines(cellsFor(unknowns), unknowns);
    const auto line = [&](int size, Column faster, Column slower) {
        for (const OrderLine& l : lines)
            if (l.size == size && l.faster == faster && l.slower == slower) return l;
        ADD_FAILURE() << size;
        return OrderLine{};
    };
    // Screen draws a second scene of 5 ms.
    const OrderLine screen = line(1024, Column::Alpha, Column::Screen);
    EXPECT_TRUE(screen.isAsPublished());
    EXPECT_DOUBLE_EQ(screen.slowerMs - screen.fasterMs, 5);
    EXPECT_EQ(screen.reason, "on the chip 31.00 and 36.00 ms: scene +5.00");
    const OrderLine stencil = line(1024, Column::Alpha, Column::Stencil);
    EXPECT_FALSE(stencil.isAsPublished());
    EXPECT_THAT(stencil.reason, HasSubstr("volumes -14.00"));
    const Unknowns waiting{.volumes = 10, .hostMs = 50};
    for (const OrderLine& l : orderLines(cellsFor(waiting), waiting))
        EXPECT_THAT(l.reason, HasSubstr("both wait for the host, 50.00 and 50.00 ms"));
    EXPECT_EQ(lines.size(), 13u);
}

TEST(StencilFactor, BringsTheStencilColumnToItsPublishedPlace) {
    const Unknowns unknowns{.volumes = 10};
    auto cells = cellsFor(unknowns);
    EXPECT_NEAR(stencilFactor(cells, unknowns), 1, 1e-9) << "it is there";
    cells[12].published = 1000 / (cells[12].publishedMs() + 6);  // of 6 ms of volumes
    EXPECT_NEAR(stencilFactor(cells, unknowns), 2, 1e-9);
}

TEST(Table2Text, SaysOfEachOrderWhetherItIsAsPublished) {
    Table2 table{.cells = cellsFor({.volumes = 17, .scene = 2, .hostMs = 9}), .rates = {"fill 350 Mpixel/s"}};
    const std::string text = table2Text(table);
    EXPECT_THAT(text, AllOf(HasSubstr("1024x1024: screen < alpha "), HasSubstr("  as published"),
                            HasSubstr("  NOT as published"), HasSubstr("(fill 350 Mpixel/s)"),
                            HasSubstr("Not comparable: "), HasSubstr("\nComparable: ")));
    EXPECT_THAT(text, testing::Not(HasSubstr("this machine")));
    table.measured.assign(table.cells.size(), 2.5);
    EXPECT_THAT(table2Text(table), AllOf(HasSubstr("this machine"), HasSubstr("2.50")));
    const auto json = table2Json(table);
    EXPECT_EQ(json["cells"].size(), 16u);
    EXPECT_EQ(json["fits"].size(), 5u);
    EXPECT_EQ(json["fits"][1]["orders"].size(), 13u);
    EXPECT_NEAR(json["fits"][1]["volume_fragments"].get<double>(), 17, 0.02);
}

}  // namespace reproduce_roettger2002_table2_test
}  // namespace gnomon
