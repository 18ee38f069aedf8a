#pragma once

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utmp.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon {

/// What the program wrote to a pseudo-terminal.
struct TerminalOutcome {
    int status = -1;
    std::string text{};
};

/// How the program is run at a pseudo-terminal.
struct TerminalRun {
    unsigned short columns = 80;
    std::string term = "xterm";
    std::vector<std::pair<std::string, std::string>> environment{};  ///< beside TERM
    bool outputIsTerminal = true;                                    ///< else /dev/null; errors always are
    std::string question{}, answer{};  ///< what the terminal says when the program writes @p question
    unsigned short laterColumns = 0;   ///< resized to, as soon as anything was written; 0: not
};

/// Runs the program at a pseudo-terminal, where "\n" comes out as "\r\n".
inline TerminalOutcome runAtTerminal(const std::vector<std::string>& given, const TerminalRun& how) {
    int master = -1, slave = -1;
    winsize window{.ws_row = 25, .ws_col = how.columns, .ws_xpixel = 0, .ws_ypixel = 0};
    if (openpty(&master, &slave, nullptr, nullptr, &window) != 0)
        throw std::runtime_error("no pseudo-terminal");
    std::vector<std::string> arguments{GNOMON_PROGRAM};
    arguments.insert(arguments.end(), given.begin(), given.end());
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);

    const pid_t pid = fork();
    if (pid == 0) {
        close(master);
        setenv("TERM", how.term.c_str(), 1);
        for (const char* name : {"NO_COLOR", "COLUMNS"}) unsetenv(name);
        for (const auto& [name, value] : how.environment) setenv(name.c_str(), value.c_str(), 1);
        login_tty(slave);
        if (!how.outputIsTerminal) dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        execv(argv[0], argv.data());
        _exit(127);
    }
    close(slave);
    TerminalOutcome outcome;
    bool isAnswered = how.question.empty(), isResized = how.laterColumns == 0;
    char buffer[65536];
    for (ssize_t n; (n = read(master, buffer, sizeof buffer)) > 0 || (n < 0 && errno == EINTR);) {
        if (n > 0) outcome.text.append(buffer, std::size_t(n));
        if (!isAnswered && outcome.text.find(how.question) != std::string::npos) {
            isAnswered = true;
            if (write(master, how.answer.data(), how.answer.size()) < 0) break;
        }
        if (!isResized) {
            isResized = true;
            window.ws_col = how.laterColumns;
            ioctl(master, TIOCSWINSZ, &window);
        }
    }
    close(master);
    int status = 0;
    waitpid(pid, &status, 0);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

}  // namespace gnomon
