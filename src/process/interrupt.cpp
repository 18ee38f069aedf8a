#include "process/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace gnomon {
namespace {

// A signal's handler has nothing but what is global. Blocking signals would hold this thread's only, and any
// thread may be given one.
std::atomic<int> held = 0;
std::atomic<int> waiting = 0;  ///< the signal that came meanwhile
static_assert(std::atomic<int>::is_always_lock_free);

void onInterrupt(int signal) {
    if (held == 0) _exit(128 + signal);
    waiting = signal;
}

}  // namespace

void exitOnInterrupt() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler == SIG_IGN) continue;
        struct sigaction action {};
        action.sa_handler = onInterrupt;
        action.sa_flags = SA_RESTART;
        sigaction(signal, &action, nullptr);
    }
}

InterruptsHeld::InterruptsHeld() {
    ++held;
}

InterruptsHeld::~InterruptsHeld() {
    if (--held == 0 && waiting != 0) _exit(128 + waiting);
}

}  // namespace gnomon
