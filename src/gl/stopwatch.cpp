#include "gl/stopwatch.h"

#include <ctime>

namespace gnomon {

double threadCpuMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

const char* name(DrawClock clock) {
    return clock == DrawClock::Gpu ? "gpu" : "thread";
}

DrawClock clockOf(const Surface& surface) {
    return surface.isSoftware() ? DrawClock::Thread : DrawClock::Gpu;
}

Stopwatch::Stopwatch(Surface& surface, DrawClock clock) : m_surface(surface), m_clock(clock) {
    if (m_clock == DrawClock::Gpu) m_surface.driver().GenQueries(1, &m_query);
}

Stopwatch::~Stopwatch() {
    if (m_clock == DrawClock::Gpu) m_surface.driver().DeleteQueries(1, &m_query);
}

void Stopwatch::start() {
    if (m_clock == DrawClock::Gpu) return m_surface.driver().BeginQuery(GL_TIME_ELAPSED, m_query);
    m_start = threadCpuMs();
}

double Stopwatch::stop() {
    if (m_clock == DrawClock::Thread) return threadCpuMs() - m_start;
    const GlTable& gl = m_surface.driver();
    gl.EndQuery(GL_TIME_ELAPSED);
    GLuint64 nanoseconds = 0;
    gl.GetQueryObjectui64v(m_query, GL_QUERY_RESULT, &nanoseconds);
    return double(nanoseconds) * 1e-6;
}

}  // namespace gnomon
