#pragma once

#include <cstdint>

#include "gl/surface.h"

namespace gnomon {

/// Thread CPU time in milliseconds, from an arbitrary start.
double threadCpuMs();

/// Whose time a Stopwatch takes.
enum class DrawClock : std::uint8_t {
    Thread,  ///< the thread's, on the processor: a software rasteriser draws on it (LP_NUM_THREADS=0)
    Gpu,     ///< the GPU's, by GL_TIME_ELAPSED
};

/// "thread", "gpu".
const char* name(DrawClock);

/// DrawClock::Thread where the processor draws, else DrawClock::Gpu. @pre the surface is current
DrawClock clockOf(const Surface& surface);

/// Times what is drawn on a surface.
class Stopwatch {
  public:
    explicit Stopwatch(Surface& surface) : Stopwatch(surface, clockOf(surface)) {}
    /// @pre the surface is current, here and in all calls
    Stopwatch(Surface& surface, DrawClock clock);
    ~Stopwatch();
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

    /// @pre of DrawClock::Gpu no other stopwatch runs: OpenGL has one such query at a time
    void start();
    /// Milliseconds since start(). DrawClock::Thread: of what is drawn and not finished (glFinish) some may
    /// be missing. DrawClock::Gpu: waits for what was drawn, and takes all of it.
    double stop();

  private:
    Surface& m_surface;
    const DrawClock m_clock;
    unsigned m_query = 0;  ///< DrawClock::Gpu
    double m_start = 0;    ///< DrawClock::Thread
};

}  // namespace gnomon
