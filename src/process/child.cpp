#include "process/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <system_error>

#include "process/message.h"

namespace gnomon {
namespace {

constexpr char kResultMessage = 'r';

[[noreturn]] void runChild(const std::function<void(int)>& work, int socket) {
    int status = 0;
    try {
        work(socket);
    } catch (const std::exception& error) {
        std::string what = error.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        sendMessage(socket, kErrorMessage, what);
        status = 3;
    } catch (...) {
        // Nothing may unwind beyond here: the frames below are the parent's work.
        sendMessage(socket, kErrorMessage, "unknown exception");
        status = 3;
    }
    _exit(status);
}

}  // namespace

Child startChild(const std::function<void(int)>& work) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw std::system_error(errno, std::generic_category(), "socketpair");
    std::fflush(nullptr);
    const pid_t parent = getpid();
    const pid_t pid = fork();
    if (pid < 0) {
        const int why = errno;
        close(ends[0]), close(ends[1]);
        throw std::system_error(why, std::generic_category(), "fork");
    }
    if (pid == 0) {
        // A terminal sends these to all; the parent decides, and its end is the child's.
        for (const int one : {SIGINT, SIGTERM, SIGHUP}) signal(one, SIG_IGN);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(1);  // it was gone before it could be watched
        close(ends[0]);
        runChild(work, ends[1]);
    }
    close(ends[1]);
    return {pid, ends[0]};
}

std::string waitFor(Child& child) {
    close(child.socket);
    int status = 0;
    while (waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
    }
    child = {};
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        return fmt::format("{}: signal {} ({})", signal == SIGKILL ? "killed from outside" : "crashed",
                           signal, strsignal(signal));
    }
    return WEXITSTATUS(status) == 0 ? "" : fmt::format("exit {}", WEXITSTATUS(status));
}

Apart doneApart(const std::function<std::string()>& work) {
    Child child = startChild([&](int socket) {
        dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
        sendMessage(socket, kResultMessage, work());
    });
    MessageReader reader;
    const auto message = reader.wait(child.socket);
    const std::string end = waitFor(child);
    if (!message) return {.crash = end.empty() ? "exit 0" : end};
    if (message->kind == kErrorMessage) return {.thrown = message->text};
    return {.result = message->text};
}

}  // namespace gnomon
