#pragma once

#include "gl/surface.h"

namespace gnomon {

/// Thread CPU time in milliseconds, from an arbitrary start.
double threadCpuMs();

/// Times what is drawn on a surface: by the CPU time of the thread, on which llvmpipe draws too.
class Stopwatch {
  public:
    explicit Stopwatch(Surface& surface);
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

    void start();
    /// Milliseconds since start(); of what is drawn and not finished (glFinish) some may be missing.
    double stop();

  private:
    double m_start = 0;
};

}  // namespace gnomon
