// Child processes: what comes back of them, how their end is told, and that none outlives its parent.

#include "process/child.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

#include "process/die_of.h"
#include "process/message.h"

namespace gnomon {
namespace child_test {

using testing::StartsWith;

TEST(Message, ComesWholeWhateverItHolds) {
    const std::string large(3'000'000, 'x'), odd("a\0b\nc", 5);
    Child child = startChild([&](int socket) {
        for (const std::string& text : {large, odd, std::string()}) sendMessage(socket, 'm', text);
    });
    MessageReader reader;
    for (const std::string& text : {large, odd, std::string()}) {
        const auto message = reader.wait(child.socket);
        ASSERT_TRUE(message);
        EXPECT_EQ(message->kind, 'm');
        EXPECT_EQ(message->text, text);
    }
    EXPECT_FALSE(reader.wait(child.socket));
    EXPECT_EQ(waitFor(child), "");
}

TEST(Message, ToNobodyIsToldApart) {
    Child child = startChild([](int) {});
    MessageReader reader;
    EXPECT_FALSE(reader.wait(child.socket));
    EXPECT_FALSE(sendMessage(child.socket, 'm', "text")) << "and no signal";
    waitFor(child);
}

TEST(DoneApart, BringsTheResultBack) {
    const Apart done = doneApart([] { return std::string("result"); });
    EXPECT_EQ(done.result, "result");
    EXPECT_EQ(done.thrown + done.crash, "");
}

TEST(DoneApart, TellsWhatWasThrownInOneLine) {
    const Apart done = doneApart([]() -> std::string { throw std::runtime_error("no\nfile"); });
    EXPECT_EQ(done.thrown, "no file");
    EXPECT_EQ(done.result + done.crash, "");
}

TEST(DoneApart, OutlivesACrashAndNamesIt) {
    const auto crashOf = [](int signal) {
        return doneApart([=] {
                   dieOf(signal);
                   return std::string();
               })
            .crash;
    };
    EXPECT_EQ(crashOf(SIGABRT), "crashed: signal 6 (Aborted)");
    EXPECT_THAT(crashOf(SIGSEGV), StartsWith("crashed: signal 11"));
    EXPECT_THAT(crashOf(SIGKILL), StartsWith("killed from outside: signal 9"));
    EXPECT_EQ(doneApart([]() -> std::string { _exit(7); }).crash, "exit 7");
    EXPECT_EQ(doneApart([]() -> std::string { _exit(0); }).crash, "exit 0");
}

// A terminal's interrupt goes to all processes: it is the parent that must end.
TEST(StartChild, LeavesInterruptsToItsParent) {
    const Apart done = doneApart([] {
        for (const int one : {SIGINT, SIGTERM, SIGHUP}) raise(one);
        return std::string("lives");
    });
    EXPECT_EQ(done.result, "lives");
}

// The write end of a pipe is held by a process and its child alone: it ends when both are gone.
TEST(StartChild, DiesWithItsParent) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t parent = fork();
    if (parent == 0) {
        close(ends[0]);
        startChild([&](int) {
            if (write(ends[1], "c", 1) != 1) _exit(1);
            for (;;) pause();
        });
        for (;;) pause();
    }
    close(ends[1]);
    char byte = 0;
    ASSERT_EQ(read(ends[0], &byte, 1), 1);
    kill(parent, SIGKILL);
    EXPECT_EQ(read(ends[0], &byte, 1), 0) << "or this waits for ever";
    waitpid(parent, nullptr, 0);
    close(ends[0]);
}

}  // namespace child_test
}  // namespace gnomon
