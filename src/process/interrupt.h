#pragma once

namespace gnomon {

/// From now on SIGINT, SIGTERM and SIGHUP end this process at once, with the status 128 + signal; those that
/// are ignored stay so. Its children die with it (startChild()).
void exitOnInterrupt();

/// While one lives, an interrupt waits: what has begun is ended first.
class InterruptsHeld {
  public:
    InterruptsHeld();
    ~InterruptsHeld();
    InterruptsHeld(const InterruptsHeld&) = delete;
    InterruptsHeld& operator=(const InterruptsHeld&) = delete;
};

}  // namespace gnomon
