#include "report/plot_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {

double PlotBox::overlap(const PlotBox& other) const {
    const double across = std::min(x + width, other.x + other.width) - std::max(x, other.x);
    const double down = std::min(y + height, other.y + other.height) - std::max(y, other.y);
    return across > 0 && down > 0 ? across * down : 0;
}

std::vector<PlotBox> placeLabels(const std::vector<PlotLabel>& labels, std::vector<PlotBox> obstacles,
                                 const PlotBox& within) {
    constexpr double kPi = 3.14159265358979;
    constexpr int kDirections = 16;
    std::vector<PlotBox> placed;
    for (const PlotLabel& label : labels) {
        PlotBox best;
        double least = std::numeric_limits<double>::infinity();
        const auto consider = [&](double distance, int direction) {
            const double angle = 2 * kPi * direction / kDirections;
            const double right = std::cos(angle), down = std::sin(angle);
            // The box' near side or corner lies on the circle.
            const PlotBox box{label.x + right * distance + (right - 1) / 2 * label.width,
                              label.y + down * distance + (down - 1) / 2 * label.height, label.width,
                              label.height};
            double bad = box.width * box.height - box.overlap(within);
            for (const PlotBox& other : obstacles) bad += box.overlap(other);
            if (bad < least) least = bad, best = box;
        };
        for (double distance = 9; distance < 100 && least > 0; distance += 8)
            for (int direction = 0; direction < kDirections; ++direction) {
                // Right first, then the two sides in turn.
                const int turn = direction % 2 ? -(direction + 1) / 2 : direction / 2;
                if (least > 0) consider(distance, turn);
            }
        placed.push_back(best);
        obstacles.push_back(best);
    }
    return placed;
}

}  // namespace gnomon
