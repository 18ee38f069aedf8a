#pragma once

namespace gnomon {

/// From now on SIGINT, SIGTERM and SIGHUP end this process at once, with the status 128 + signal; those that
/// are ignored stay so. Its children die with it (startChild()).
void exitOnInterrupt();

/// What an interrupt writes to standard error as it ends this process, but none of its children: a line that
/// was begun there is taken away. Nothing where it is null.
/// @param text  is not copied
void writeOnInterrupt(const char* text);

/// While one lives, an interrupt waits: what has begun is ended first.
class InterruptsHeld {
  public:
    InterruptsHeld();
    ~InterruptsHeld();
    InterruptsHeld(const InterruptsHeld&) = delete;
    InterruptsHeld& operator=(const InterruptsHeld&) = delete;
};

}  // namespace gnomon
