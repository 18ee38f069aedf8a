#include "matrix/pool.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;

struct Worker {
    std::size_t job = 0;
    pid_t pid = -1;
    int pipe = -1;
    std::string text{};
    std::size_t told = 0;  ///< characters of the lines that were handed on as they arrived
    Clock::time_point deadline{};
    bool killed = false;
};

void writeAll(int file, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t n = write(file, text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) _exit(1);
        done += std::size_t(n);
    }
}

/// A line that can't be one of a job's: how a child says why it gives up.
constexpr char kErrorMark = '\x01';

[[noreturn]] void child(const Job& job, int pipe) {
    int status = 0;
    try {
        job.work([&](const std::string& line) { writeAll(pipe, line + "\n"); });
    } catch (const std::exception& error) {
        std::string what = error.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        writeAll(pipe, kErrorMark + what + "\n");
        status = 3;
    } catch (...) {
        // Nothing may unwind beyond here: the frames below are the parent's work.
        writeAll(pipe, std::string(1, kErrorMark) + "unknown exception\n");
        status = 3;
    }
    _exit(status);
}

Worker start(const std::vector<Job>& jobs, std::size_t index, int seconds) {
    int ends[2];
    if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    std::fflush(nullptr);
    const pid_t pid = fork();
    if (pid < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (pid == 0) {
        close(ends[0]);
        child(jobs[index], ends[1]);
    }
    close(ends[1]);
    Worker worker;
    worker.job = index;
    worker.pid = pid;
    worker.pipe = ends[0];
    worker.deadline = Clock::now() + std::chrono::seconds(seconds);
    return worker;
}

/// Hands on the lines that are complete by now.
void tell(Worker& worker, const std::function<void(std::size_t, const std::string&)>& arrived) {
    for (std::size_t end; (end = worker.text.find('\n', worker.told)) != std::string::npos;
         worker.told = end + 1)
        if (worker.text[worker.told] != kErrorMark)
            arrived(worker.job, worker.text.substr(worker.told, end - worker.told));
}

JobEnd finish(Worker& worker, int seconds) {
    close(worker.pipe);
    int status = 0;
    while (waitpid(worker.pid, &status, 0) < 0 && errno == EINTR) {
    }
    JobEnd end;
    std::size_t at = 0;
    for (std::size_t line; (line = worker.text.find('\n', at)) != std::string::npos; at = line + 1) {
        std::string text = worker.text.substr(at, line - at);
        if (!text.empty() && text[0] == kErrorMark)
            end.error = text.substr(1);
        else
            end.lines.push_back(std::move(text));
    }
    if (worker.killed)
        end.error = fmt::format("timed out after {} s", seconds);
    else if (WIFSIGNALED(status))
        end.error = fmt::format("crashed: signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
    else if (WEXITSTATUS(status) != 0 && end.error.empty())
        end.error = fmt::format("exit {}", WEXITSTATUS(status));
    return end;
}

}  // namespace

void runJobs(const std::vector<Job>& jobs, int workers, int seconds,
             const std::function<void(std::size_t, JobEnd)>& ended,
             const std::function<void(std::size_t, const std::string&)>& arrived) {
    std::vector<Worker> running;
    std::size_t next = 0;
    while (next < jobs.size() || !running.empty()) {
        while (next < jobs.size() && int(running.size()) < std::max(1, workers))
            running.push_back(start(jobs, next++, seconds));

        std::vector<pollfd> polls;
        auto deadline = running.front().deadline;
        for (const Worker& w : running) {
            polls.push_back({w.pipe, POLLIN, 0});
            if (!w.killed) deadline = std::min(deadline, w.deadline);
        }
        const auto wait =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (poll(polls.data(), polls.size(), int(std::clamp<long long>(wait, 0, 60'000))) < 0 &&
            errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "poll");

        // Backwards, so that ended workers can be taken out.
        for (std::size_t i = running.size(); i-- > 0;) {
            Worker& worker = running[i];
            if (!worker.killed && Clock::now() >= worker.deadline) {
                kill(worker.pid, SIGKILL);
                worker.killed = true;
            }
            if (!polls[i].revents) continue;
            char buffer[65536];
            const ssize_t n = read(worker.pipe, buffer, sizeof buffer);
            if (n < 0 && errno == EINTR) continue;
            if (n > 0) {
                worker.text.append(buffer, std::size_t(n));
                if (arrived) tell(worker, arrived);
                continue;
            }
            ended(worker.job, finish(worker, seconds));
            running.erase(running.begin() + std::ptrdiff_t(i));
        }
    }
}

}  // namespace gnomon
