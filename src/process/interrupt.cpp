#include "process/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstring>

namespace gnomon {
namespace {

// A signal's handler has nothing but what is global. Blocking signals would hold this thread's only, and any
// thread may be given one.
std::atomic<int> held = 0;
std::atomic<int> waiting = 0;  ///< the signal that came meanwhile
std::atomic<const char*> lastWords = nullptr;
std::atomic<pid_t> speaker = 0;  ///< the process whose words they are
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<const char*>::is_always_lock_free);

[[noreturn]] void end(int signal) {
    const char* text = lastWords;
    // A terminal that is gone takes no words, and needs none.
    if (text && speaker == getpid()) {
        [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
    }
    _exit(128 + signal);
}

void onInterrupt(int signal) {
    if (held == 0) end(signal);
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

void writeOnInterrupt(const char* text) {
    speaker = getpid();
    lastWords = text;
}

InterruptsHeld::InterruptsHeld() {
    ++held;
}

InterruptsHeld::~InterruptsHeld() {
    if (--held == 0 && waiting != 0) end(waiting);
}

}  // namespace gnomon
