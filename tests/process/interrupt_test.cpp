// Interrupts: they end the process with a status that says which, unless they were ignored from outside.

#include "process/interrupt.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

namespace gnomon {
namespace interrupt_test {

/// Exit status of a process that does @p work; 0 if it comes to its end.
int statusOf(const std::function<void()>& work) {
    const pid_t pid = fork();
    if (pid == 0) {
        work();
        _exit(0);
    }
    int status = 0;
    waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(ExitOnInterrupt, EndsWithTheSignalInItsStatus) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        EXPECT_EQ(statusOf([=] {
                      exitOnInterrupt();
                      raise(signal);
                  }),
                  128 + signal);
}

// A shell starts what runs in the background so; nohup does it with SIGHUP.
TEST(ExitOnInterrupt, LeavesIgnoredSignalsIgnored) {
    EXPECT_EQ(statusOf([] {
                  signal(SIGINT, SIG_IGN);
                  exitOnInterrupt();
                  raise(SIGINT);
              }),
              0);
}

TEST(InterruptsHeld, LetTheWorkEndFirst) {
    EXPECT_EQ(statusOf([] {
                  exitOnInterrupt();
                  {
                      const InterruptsHeld outer;
                      const InterruptsHeld inner;
                      raise(SIGTERM);
                  }
                  _exit(1);
              }),
              128 + SIGTERM);
    EXPECT_EQ(statusOf([] {
                  exitOnInterrupt();
                  const InterruptsHeld held;
                  raise(SIGTERM);
                  _exit(1);
              }),
              1);
}

}  // namespace interrupt_test
}  // namespace gnomon
