#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cost/spread.h"
#include "report/page.h"
#include "report/plot.h"

namespace gnomon {

/// One line of Figure 4 of Usta et al. 2019: a method along a camera path.
struct UstaLine {
    std::string method{};          ///< the id: "heidmann"
    std::string called{};          ///< as the paper calls it: "Z-Pass"
    bool byShader = false;         ///< its volumes are made by the geometry shader of AtomicZP
    std::vector<double> ms{};      ///< by frame: median time of making the mask
    std::vector<double> ratios{};  ///< by frame: to Z-pass whose volumes are made the same way, in the same
                                   ///< rounds: the median
    int wrong = 0;                 ///< untied pixels, of all frames
    int framesWrong = 0;           ///< that have any
};

struct UstaScene {
    std::string scene{};
    std::size_t triangles = 0;
    std::vector<UstaLine> lines{};
};

struct UstaRun {
    int width = 0, height = 0, frames = 0, repeats = 0;
    std::string device{};
    std::vector<UstaScene> scenes{};
};

std::string showUsta(const UstaRun& run, const Page& page);

/// For each scene a plot of the volumes that the host makes, and one of the shader's; a line for each method.
std::vector<Plot> ustaPlots(const UstaRun& run);

}  // namespace gnomon
