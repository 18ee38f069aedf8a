// Interrupts: they end the process with a status that says which, unless they were ignored from outside.

#include "process/interrupt.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <string>

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

/// What is written to standard error by a process that is interrupted after @p work.
std::string wordsOf(const std::function<void()>& work) {
    int ends[2];
    if (pipe(ends) != 0) return "no pipe";
    const int status = statusOf([&] {
        dup2(ends[1], STDERR_FILENO);
        exitOnInterrupt();
        work();
        raise(SIGINT);
    });
    EXPECT_EQ(status, 128 + SIGINT);
    close(ends[1]);
    char text[16];
    const ssize_t size = read(ends[0], text, sizeof text);
    close(ends[0]);
    return {text, std::size_t(std::max<ssize_t>(size, 0))};
}

TEST(WriteOnInterrupt, IsDoneByTheProcessThatAskedForIt) {
    EXPECT_EQ(wordsOf([] {}), "");
    EXPECT_EQ(wordsOf([] { writeOnInterrupt("gone"); }), "gone");
    EXPECT_EQ(wordsOf([] { writeOnInterrupt("gone"), writeOnInterrupt(nullptr); }), "");
    // Not by its child too.
    EXPECT_EQ(wordsOf([] {
                  writeOnInterrupt("gone");
                  EXPECT_EQ(statusOf([] { raise(SIGINT); }), 128 + SIGINT);
              }),
              "gone");
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
