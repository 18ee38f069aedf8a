#pragma once

#include <string>
#include <vector>

namespace gnomon {

struct PlotTick {
    double value = 0;
    std::string text{};  ///< empty: a line of the grid without a number
};

/// What of the values along an axis stands where.
struct PlotScale {
    double low = 0, high = 1;  ///< its ends; of a logarithmic axis without the foot
    bool logarithmic = false;
    bool hasFoot = false;  ///< logarithmic, and there are zeros: they stand apart below the rest
    double footAt = 0.035, aboveFoot = 0.1;  ///< where zeros stand, of its length, and where the rest begins
    std::vector<PlotTick> ticks{};

    /// 0 at the axis' start, 1 at its end.
    double at(double value) const;
};

/// An axis on which @p values have room, with round ticks, about @p ticks of them with a number.
/// @param foot     the text of the tick at 0
/// @param isWhole  no tick between two whole numbers, if it is linear
/// @pre values are finite; logarithmic: not negative
PlotScale plotScale(const std::vector<double>& values, bool logarithmic, int ticks = 7,
                    const std::string& foot = "0", bool isWhole = false);

}  // namespace gnomon
