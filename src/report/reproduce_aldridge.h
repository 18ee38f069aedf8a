#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cost/spread.h"
#include "report/page.h"

namespace gnomon {

/// One of the two builders that Aldridge and Woods compare in section 4: the signed counter, or brute force,
/// where every edge has one triangle.
struct AldridgeRow {
    std::string builder{};  ///< "counter", "brute force"
    // As published: 262 lights on a Radeon 9500.
    double publishedFps = 0;
    std::size_t publishedEdges = 0, publishedPolygons = 0;
    // Ours.
    std::size_t edges = 0;          ///< of the casters: each once, or three per triangle
    std::size_t polygons = 0;       ///< sides and caps of the volumes of all lights
    std::vector<double> frameMs{};  ///< by repetition: volumes built and drawn, of the lights that are timed
};

struct AldridgeRun {
    std::string scene{};
    std::size_t triangles = 0;
    std::size_t crowdedEdges = 0;  ///< of three triangles or more
    int mostAtAnEdge = 0;
    std::size_t lights = 0;  ///< whose volumes are counted
    std::string where{};     ///< where they stand, in words
    int timedLights = 0, width = 0, height = 0, repeats = 0;
    std::string device{};
    std::vector<AldridgeRow> rows{};  ///< the counter, then brute force
};

/// The published figures, without ours.
std::vector<AldridgeRow> aldridgeSection4();

std::string showAldridge(const AldridgeRun& run, const Page& page);

}  // namespace gnomon
