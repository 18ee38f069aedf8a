#include "report/progress_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double kSecondsApart = 0.1;
constexpr std::size_t kShortestBar = 10, kLongestBar = 40;  ///< with its brackets, columns

/// "0:07", "12:34", "3:00:05".
std::string clockText(double seconds) {
    const auto all = static_cast<long long>(std::ceil(std::clamp(seconds, 0.0, 359'999.0)));
    const auto hours = all / 3600, minutes = all / 60 % 60;
    return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, all % 60)
                     : fmt::format("{}:{:02}", minutes, all % 60);
}

std::string barText(const Progress& progress, std::size_t columns) {
    const std::size_t inside = columns - 2;
    const std::size_t full = progress.all == 0 ? inside : progress.done * inside / progress.all;
    return fmt::format("[{}{}]", std::string(full, '#'), std::string(inside - full, '.'));
}

}  // namespace

std::string progressLine(const ProgressState& state, const std::string& unit, std::size_t columns) {
    const auto& [done, all, failures] = state.progress;
    const std::string count = fmt::format("{} of {} {}", done, all, unit);
    const std::string rate = state.perSecond > 0 ? fmt::format(", {:.1f}/s", state.perSecond) : "";
    const std::string left = state.secondsLeft ? fmt::format(", {} left", clockText(*state.secondsLeft)) : "";
    const std::string failed = fmt::format(", {} failed", failures);

    // The last column stays free: some terminals go to the next line as soon as it is filled.
    const std::size_t room = columns > 0 ? columns - 1 : 0;
    const std::string figures = fmt::format("{}{}{}{}", count, rate, left, failed);
    if (figures.size() + 1 + kShortestBar <= room) {
        const std::size_t bar = std::min(kLongestBar, room - figures.size() - 1);
        return fmt::format("{} {}", barText(state.progress, bar), figures);
    }
    for (const std::string& line :
         {figures, fmt::format("{}{}{}", count, left, failed), fmt::format("{}{}", count, failed),
          fmt::format("{}/{}{}", done, all, failed), fmt::format("{}/{}", done, all)})
        if (line.size() <= room) return line;
    return {};
}

ProgressState ProgressBar::state(const Progress& progress, double seconds) {
    if (!m_first) {
        m_first = progress;
        m_firstSeconds = seconds;
    }
    ProgressState state{.progress = progress};
    const double passed = seconds - m_firstSeconds;
    if (progress.done > m_first->done && passed > 0) {
        state.perSecond = double(progress.done - m_first->done) / passed;
        state.secondsLeft = double(progress.all - progress.done) / state.perSecond;
    }
    return state;
}

std::optional<std::string> ProgressBar::draw(const Progress& progress, double seconds, std::size_t columns) {
    const ProgressState now = state(progress, seconds);
    if (m_drawnAt && seconds - *m_drawnAt < kSecondsApart) return std::nullopt;
    m_drawnAt = seconds;
    return fmt::format("{}{}", kClearLine, progressLine(now, m_unit, columns));
}

std::string ProgressBar::clear() {
    if (!m_drawnAt) return {};
    m_drawnAt.reset();
    return kClearLine;
}

}  // namespace gnomon
