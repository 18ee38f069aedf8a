#include "matrix/pool.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>

#include "process/child.h"
#include "process/message.h"

namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char kLine = 'l';

struct Worker {
    std::size_t job = 0;
    Child child{};
    MessageReader reader{};
    JobEnd end{};
    Clock::time_point deadline{};
    bool killed = false;
};

Worker start(const std::vector<Job>& jobs, std::size_t index, int seconds) {
    Worker worker{.job = index};
    worker.child = startChild([&](int socket) {
        jobs[index].work([&](const std::string& line) { sendMessage(socket, kLine, line); });
    });
    worker.deadline = Clock::now() + std::chrono::seconds(seconds);
    return worker;
}

/// Takes the messages that are whole by now.
void take(Worker& worker) {
    while (auto message = worker.reader.next()) {
        if (message->kind == kErrorMessage)
            worker.end.error = message->text;
        else
            worker.end.lines.push_back(std::move(message->text));
    }
}

JobEnd finish(Worker& worker, int seconds) {
    const std::string how = waitFor(worker.child);
    if (worker.killed)
        worker.end.error = fmt::format("timed out after {} s", seconds);
    else if (worker.end.error.empty())
        worker.end.error = how;
    return std::move(worker.end);
}

}  // namespace

void runJobs(const std::vector<Job>& jobs, int workers, int seconds,
             const std::function<void(std::size_t, JobEnd)>& ended) {
    std::vector<Worker> running;
    std::size_t next = 0;
    while (next < jobs.size() || !running.empty()) {
        while (next < jobs.size() && int(running.size()) < std::max(1, workers))
            running.push_back(start(jobs, next++, seconds));

        std::vector<pollfd> polls;
        auto deadline = running.front().deadline;
        for (const Worker& w : running) {
            polls.push_back({w.child.socket, POLLIN, 0});
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
                kill(worker.child.pid, SIGKILL);
                worker.killed = true;
            }
            if (!polls[i].revents) continue;
            if (worker.reader.read(worker.child.socket)) {
                take(worker);
                continue;
            }
            ended(worker.job, finish(worker, seconds));
            running.erase(running.begin() + std::ptrdiff_t(i));
        }
    }
}

}  // namespace gnomon
