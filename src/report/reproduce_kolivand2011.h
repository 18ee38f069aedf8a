#pragma once

#include <string>
#include <vector>

#include "cost/spread.h"
#include "method/method.h"
#include "report/page.h"

namespace gnomon {

/// One row of Table 1 of Kolivand and Sunar 2011, and the same on this machine.
struct KolivandRow {
    std::string status{};  ///< as the paper calls it
    double published = 0;  ///< frames per second
    std::string method{};  ///< the named method whose axes these are, but for the silhouette
    Axes axes{};
    std::vector<double> buildMs{}, totalMs{};  ///< by repetition, of all frames: the host's part, and all

    Spread share{};  ///< of the frame rate without shadow: ours, in the same round
};

/// What it was measured on.
struct KolivandRun {
    std::string scene{};
    std::size_t triangles = 0;
    int width = 0, height = 0, frames = 0, repeats = 0;
    std::string device{};  ///< what drew
    std::vector<KolivandRow> rows{};
};

/// The published rows, without our figures.
std::vector<KolivandRow> kolivandTable1();

/// Fills in KolivandRow::share. @pre the first row is the one without shadow
void compareRates(std::vector<KolivandRow>& rows);

std::string showKolivand(const KolivandRun& run, const Page& page);

}  // namespace gnomon
