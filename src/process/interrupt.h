#pragma once

namespace gnomon {

/// From now on SIGINT, SIGTERM and SIGHUP end this process at once, with the status 128 + signal; those that
/// are ignored stay so. Its children die with it (startChild()).
void exitOnInterrupt();

/// From now on an interrupt writes @p text to standard error as it ends this process, such as to take away a
/// line that was begun there. A child that is ended writes nothing.
/// @param text  null: nothing; else outlives the process's use of it
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
