#include "gl/stopwatch.h"

#include <ctime>

namespace gnomon {

double threadCpuMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

Stopwatch::Stopwatch(Surface&) {}

void Stopwatch::start() {
    m_start = threadCpuMs();
}

double Stopwatch::stop() {
    return threadCpuMs() - m_start;
}

}  // namespace gnomon
