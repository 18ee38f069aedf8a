#include "matrix/probe.h"

#include "matrix/pool.h"

namespace gnomon {

DriverFacts probe(Device device) {
    constexpr int kSeconds = 60;
    DriverFacts facts{.device = device};
    const auto ask = [device](const std::function<void(std::string)>& emit) {
        const Surface surface({}, 4, 4, {}, device);
        emit(surface.driverName());
        emit(name(clockOf(surface)));
    };
    runJobs({{name(device), ask}}, 1, kSeconds, [&](std::size_t, const JobEnd& end) {
        if (end.lines.size() == 2) {
            facts.driver = end.lines[0];
            facts.clock = end.lines[1] == name(DrawClock::Gpu) ? DrawClock::Gpu : DrawClock::Thread;
        } else {
            facts.problem = end.error;
        }
    });
    return facts;
}

}  // namespace gnomon
