#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon {

/// The program while it runs. Its standard output is a pipe that its workers hold, too.
class Running {
  public:
    explicit Running(std::vector<std::string> arguments) {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
        m_pid = fork();
        if (m_pid == 0) {
            dup2(ends[1], STDOUT_FILENO);
            arguments.insert(arguments.begin(), GNOMON_PROGRAM);
            std::vector<char*> argv;
            for (std::string& argument : arguments) argv.push_back(argument.data());
            argv.push_back(nullptr);
            execv(argv[0], argv.data());
            _exit(127);
        }
        close(ends[1]);
        m_out = ends[0];
    }
    ~Running() { close(m_out); }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    /// Its workers, as soon as there are @p count; none if it ends before.
    std::vector<pid_t> workers(std::size_t count) const {
        for (;;) {
            std::ifstream list(fmt::format("/proc/{0}/task/{0}/children", m_pid));
            std::vector<pid_t> pids;
            for (pid_t pid = 0; list >> pid;) pids.push_back(pid);
            if (pids.size() >= count) return pids;
            // What it writes, it writes at its end.
            pollfd end{m_out, POLLIN, 0};
            if (poll(&end, 1, 1) != 0) return {};
        }
    }

    void interrupt(int signal) const { kill(m_pid, signal); }

    /// All that it has written; waits until it and its workers are gone.
    std::string output() const {
        std::string text;
        char buffer[65536];
        for (ssize_t n; (n = read(m_out, buffer, sizeof buffer)) > 0;) text.append(buffer, std::size_t(n));
        return text;
    }

    /// @pre output() has come back
    int status() const {
        int status = 0;
        waitpid(m_pid, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

  private:
    pid_t m_pid = -1;
    int m_out = -1;
};

}  // namespace gnomon
