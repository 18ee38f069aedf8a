#include "gl/stopwatch.h"

#include <ctime>

namespace gnomon {

double threadCpuMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

const char* name(Clock clock) {
    return clock == Clock::Gpu ? "gpu" : "thread";
}

Clock clockOf(const Surface& surface) {
    return surface.isSoftware() ? Clock::Thread : Clock::Gpu;
}

Stopwatch::Stopwatch(Surface& surface, Clock clock) : m_surface(surface), m_clock(clock) {
    if (m_clock == Clock::Gpu) m_surface.driver().GenQueries(1, &m_query);
}

Stopwatch::~Stopwatch() {
    if (m_clock == Clock::Gpu) m_surface.driver().DeleteQueries(1, &m_query);
}

void Stopwatch::start() {
    if (m_clock == Clock::Gpu) return m_surface.driver().BeginQuery(GL_TIME_ELAPSED, m_query);
    m_start = threadCpuMs();
}

double Stopwatch::stop() {
    if (m_clock == Clock::Thread) return threadCpuMs() - m_start;
    const GlTable& gl = m_surface.driver();
    gl.EndQuery(GL_TIME_ELAPSED);
    GLuint64 nanoseconds = 0;
    gl.GetQueryObjectui64v(m_query, GL_QUERY_RESULT, &nanoseconds);
    return double(nanoseconds) * 1e-6;
}

}  // namespace gnomon
