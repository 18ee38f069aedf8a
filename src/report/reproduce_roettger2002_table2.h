#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cost/model.h"
#include "report/page.h"

namespace gnomon {

/// The columns of Table 2 of Roettger et al. 2002, and the quarter-size mask of section 5's text.
enum class Column { Screen, Alpha, Stencil, Half, Quarter, None };
constexpr int kColumns = 6;

/// One frame rate of the paper, and what the model has of the same method on our scene.
struct Table2Cell {
    Column column = Column::None;
    int size = 0;                     ///< of the square window, pixels
    double published = 0;             ///< frames per second
    std::string method{};             ///< our method id
    std::vector<FrameCost> frames{};  ///< of the camera path; the host's part is not in them

    double publishedMs() const { return 1000 / published; }
};

/// All frame rates that the paper prints for GeForce 2 MX, without ours: rows by size, columns as printed.
std::vector<Table2Cell> roettgerTable2();

/// "screen", "half", "no shadows"
const std::string& name(Column);

/// What the model does not know of the paper's scene and machine.
struct Unknowns {
    double volumes = 1;        ///< times as many volume fragments as our scene has
    double scene = 1;          ///< times as many scene fragments
    double hostMs = 0;         ///< of a frame without shadows
    double hostVolumesMs = 0;  ///< that shadows add to it
    double hostSceneMs = 0;    ///< that each further pass of the scene adds
    bool takesTurns = false;   ///< host and chip wait for each other, instead of working side by side
};

/// The model's milliseconds for @p cell, on average over its frames.
double modelMs(const Table2Cell& cell, const Unknowns& unknowns);

/// The unknowns for which the model has the published time of the unshadowed frame at 256x256 (the host) and
/// at 1024x1024 (the scene's fragments); the others are 0 or 1.
/// @pre the cells have frames
Unknowns fromUnshadowed(const std::vector<Table2Cell>& cells, bool takesTurns = false);

/// Which unknowns a fit is free in, besides the volume fragments.
enum class FreeNumbers { Volumes, AndHost, AndScene };

struct Table2Fit {
    Unknowns unknowns{};
    std::vector<double> residuals{};  ///< by cell: ln(model's time / published time)
    double rms = 0;                   ///< of the cells with shadows
    std::size_t worst = 0;            ///< of them, index of the cell
};

/// Least squares of the logarithms of the times of the cells with shadows.
Table2Fit fitTable2(const std::vector<Table2Cell>& cells, FreeNumbers numbers, bool takesTurns = false);

/// An order of two columns in one row that the paper prints.
struct OrderLine {
    int size = 0;
    Column faster = Column::None, slower = Column::None;
    bool mayBeEqual = false;            ///< they are equal in the paper
    double fasterMs = 0, slowerMs = 0;  ///< the model's
    std::string reason{};               ///< in the model's terms

    bool isAsPublished() const;
};

/// The orders that the paper's text claims: screen < alpha >= stencil, the half-size mask ahead of all
/// full-size ones at 1024x1024 and behind them at 256x256, the quarter-size mask ahead of it.
std::vector<OrderLine> orderLines(const std::vector<Table2Cell>& cells, const Unknowns& unknowns);

/// How many times as long the volumes of the stencil column would have to take at 1024x1024 for the model to
/// have its published time over alpha's.
double stencilFactor(const std::vector<Table2Cell>& cells, const Unknowns& unknowns);

/// Table 2 and what our figures in it stand on.
struct Table2 {
    std::vector<Table2Cell> cells{};
    std::vector<std::string> rates{};  ///< of the chip, as modelRates() has them
    /// By cell: time on this machine, over that of the unshadowed frame in the same round; may be empty.
    std::vector<double> measured{};
};

/// Published frame rates beside the model's, the fits, their residuals, the orders, and what is comparable.
std::string table2Text(const Table2& table, std::size_t width = kPageColumns);
std::string table2Csv(const Table2& table);
nlohmann::ordered_json table2Json(const Table2& table);

}  // namespace gnomon
