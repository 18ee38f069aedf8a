#include "report/plot_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gnomon {
namespace {

/// "12,000", "0.25": no more digits than @p step calls for.
std::string tickText(double value, double step) {
    const int digits = std::clamp(int(std::ceil(-std::log10(step) - 1e-9)), 0, 12);
    const std::string plain = fmt::format("{:.{}f}", value == 0 ? 0.0 : value, digits);
    const std::size_t point = std::min(plain.find('.'), plain.size());
    std::string text;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        if (i < point && i > 0 && (point - i) % 3 == 0 && plain[i - 1] != '-') text += ',';
        text += plain[i];
    }
    return text;
}

/// 1, 2 or 5 times a power of ten, so that @p length has at most about @p ticks of them.
double roundStep(double length, int ticks) {
    const double least = length / ticks;
    const double power = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least * (1 - 1e-9)) return factor * power;
    return 10 * power;
}

void addSteps(PlotScale& scale, double step) {
    const auto first = std::llround(std::ceil(scale.low / step - 1e-6));
    const auto last = std::llround(std::floor(scale.high / step + 1e-6));
    for (auto i = first; i <= last; ++i)
        scale.ticks.push_back({double(i) * step, tickText(double(i) * step, step)});
}

PlotScale linearScale(double low, double high, int ticks, bool isWhole) {
    if (low == high) low -= low == 0 ? 0 : 0.1 * std::abs(low), high += high == 0 ? 1 : 0.1 * std::abs(high);
    // Where 0 is not far, lengths are honest from there.
    if (low > 0 && low <= high / 2) low = 0;
    const double step = std::max(roundStep(high - low, ticks), isWhole ? 1.0 : 0.0);
    PlotScale scale{.low = std::floor(low / step + 1e-6) * step,
                    .high = std::ceil(high / step - 1e-6) * step};
    addSteps(scale, step);
    return scale;
}

/// Ticks at decades, at 1, 2 and 5, or at round steps, by how much there is to see.
void addLogTicks(PlotScale& scale, int ticks) {
    const double decades = std::log10(scale.high / scale.low);
    if (decades < 0.7) return addSteps(scale, roundStep(scale.high - scale.low, ticks));
    const int stride = std::max(1, int(std::ceil(decades / ticks)));
    const auto first = int(std::floor(std::log10(scale.low))), last = int(std::ceil(std::log10(scale.high)));
    for (int power = first; power <= last; ++power) {
        for (int factor = 1; factor <= 9; ++factor) {
            const double unit = std::pow(10, power), value = factor * unit;
            if (value < scale.low * (1 - 1e-9) || value > scale.high * (1 + 1e-9)) continue;
            const bool isNamed = decades < 2.5 ? factor == 1 || factor == 2 || factor == 5
                                               : factor == 1 && power % stride == 0;
            if (isNamed || stride == 1) scale.ticks.push_back({value, isNamed ? tickText(value, unit) : ""});
        }
    }
}

PlotScale logScale(const std::vector<double>& values, int ticks, const std::string& foot) {
    PlotScale scale{.logarithmic = true};
    double low = 0, high = 0;
    for (const double value : values) {
        assert(value >= 0);
        scale.hasFoot = scale.hasFoot || value == 0;
        if (value == 0) continue;
        low = low == 0 ? value : std::min(low, value), high = std::max(high, value);
    }
    if (high == 0) low = 1, high = 10;
    if (high < 1.5 * low) low /= 1.25, high *= 1.25;
    const double room = std::pow(high / low, 0.05);
    scale.low = low / room, scale.high = high * room;
    if (scale.hasFoot) scale.ticks.push_back({0, foot});
    addLogTicks(scale, ticks);
    return scale;
}

}  // namespace

double PlotScale::at(double value) const {
    if (!logarithmic) return (value - low) / (high - low);
    if (value == 0) return footAt;
    const double start = hasFoot ? aboveFoot : 0;
    return start + (1 - start) * std::log(value / low) / std::log(high / low);
}

PlotScale plotScale(const std::vector<double>& values, bool logarithmic, int ticks, const std::string& foot,
                    bool isWhole) {
    if (logarithmic) return logScale(values, ticks, foot);
    if (values.empty()) return linearScale(0, 1, ticks, isWhole);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return linearScale(*low, *high, ticks, isWhole);
}

}  // namespace gnomon
