#include "matrix/workers.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <map>
#include <system_error>
#include <vector>

#include "process/child.h"
#include "process/message.h"

namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;
using Make = std::function<std::unique_ptr<StepWorker>(Whereabouts&)>;
using Ended = std::function<void(std::size_t, std::size_t, StepEnd)>;

constexpr char kTask = 't', kReady = 'b', kStep = 's';
constexpr int kStopsUntilAvoided = 2;
constexpr std::chrono::milliseconds kMemoryPeriod(20);  ///< between two looks at a worker's memory

/// What a worker is told to do: a task, from one of its steps on.
struct Order {
    std::size_t task = 0, first = 0, end = 0;
    std::array<char, 256> avoided{};  ///< StepWorker::avoid(), ends in 0; "": nothing
};

/// The life of a worker's process.
void serve(int socket, Whereabouts& whereabouts, const Make& make) {
    const std::unique_ptr<StepWorker> worker = make(whereabouts);
    MessageReader reader;
    while (const auto message = reader.wait(socket)) {
        Order order;
        std::memcpy(&order, message->text.data(), sizeof order);
        whereabouts.tell("");
        worker->avoid(order.avoided.data());
        worker->begin(order.task);
        bool isHeard = sendMessage(socket, kReady, "");
        for (std::size_t step = order.first; step < order.end && isHeard; ++step) {
            whereabouts.tell("");
            isHeard = sendMessage(socket, kStep, worker->step(order.task, step));
        }
    }
}

/// Resident memory of a process that is its own, in megabytes; 0 if it is gone.
std::size_t megabytesOf(pid_t pid) {
    std::size_t all = 0, resident = 0, shared = 0;
    std::ifstream(fmt::format("/proc/{}/statm", pid)) >> all >> resident >> shared;
    return (resident - shared) * std::size_t(sysconf(_SC_PAGESIZE)) >> 20;
}

/// A worker's process, or the next one's place.
class Seat {
  public:
    Seat(const StepLimits& limits, const Make& make, const Ended& ended)
        : m_limits(limits), m_make(make), m_ended(ended) {}
    ~Seat() {
        if (m_child.pid < 0) return;
        kill(m_child.pid, SIGKILL);
        waitFor(m_child);
    }
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;

    bool isBusy() const { return m_order.first < m_order.end; }
    int socket() const { return m_child.socket; }

    void take(std::size_t task, std::size_t steps) {
        m_order = {task, 0, steps};
        m_failedStarts = 0;
        m_stops.clear();
        if (isBusy()) send();
    }

    /// When its limits must be looked at next.
    Clock::time_point nextLook() const {
        if (!m_stopped.empty()) return Clock::time_point::max();
        return m_limits.megabytes ? std::min(m_deadline, Clock::now() + kMemoryPeriod) : m_deadline;
    }

    /// Takes what the worker has sent.
    void read() {
        const bool lives = m_reader.read(m_child.socket);
        while (auto message = m_reader.next()) {
            if (message->kind == kErrorMessage) {
                m_thrown = message->text;
                continue;
            }
            restartClock();
            m_isReady = true;
            if (message->kind == kReady) continue;
            ++m_done;
            endStep({.result = std::move(message->text)});
        }
        if (!lives) end();
    }

    /// Stops a worker that is beyond its limits.
    void look() {
        if (!isBusy() || !m_stopped.empty()) return;
        if (m_limits.megabytes) {
            const std::size_t megabytes = megabytesOf(m_child.pid);
            if (megabytes > m_limits.megabytes) {
                m_isTooLarge = true;
                stop(fmt::format("took {} MB of memory, more than {}", megabytes, m_limits.megabytes));
            }
        }
        if (Clock::now() >= m_deadline) stop(fmt::format("timed out after {} s", m_limits.seconds));
    }

  private:
    void restartClock() {
        m_deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(m_limits.seconds));
    }

    void send() {
        if (m_child.pid < 0) {
            m_child = startChild([this](int socket) { serve(socket, m_whereabouts, m_make); });
            m_reader = {};
            m_done = 0;
        }
        m_isReady = m_isTooLarge = false;
        m_stepBegan = Clock::now();
        m_stopped.clear(), m_thrown.clear();
        restartClock();
        // One that is gone by now is met as the end of its socket.
        sendMessage(m_child.socket, kTask, {reinterpret_cast<const char*>(&m_order), sizeof m_order});
    }

    void stop(std::string why) {
        m_stopped = std::move(why);
        m_stoppedAt = m_order.first;
        kill(m_child.pid, SIGKILL);
    }

    void endStep(StepEnd end) {
        const auto now = Clock::now();
        end.seconds = std::chrono::duration<double>(now - m_stepBegan).count();
        m_stepBegan = now;
        m_ended(m_order.task, m_order.first++, std::move(end));
    }

    /// The process is gone: its step fails, and another goes on.
    void end() {
        const std::string how = waitFor(m_child);
        if (!isBusy()) return;
        const bool wasJustDone = !m_stopped.empty() && m_stoppedAt != m_order.first;
        const bool hadKeptMuch = m_isTooLarge && m_done > 0;
        if (!wasJustDone && !hadKeptMuch) fail(how);
        if (isBusy()) send();
    }

    void fail(const std::string& how) {
        std::string error = !m_stopped.empty() ? m_stopped : !m_thrown.empty() ? m_thrown : how;
        if (error.empty()) error = "ended by itself";
        const std::string where = m_whereabouts.text();
        if (!where.empty() && m_thrown.empty()) error += fmt::format(" in {}", where);
        if (!m_stopped.empty() && ++m_stops[where] == kStopsUntilAvoided)
            where.copy(m_order.avoided.data(), m_order.avoided.size() - 1);
        if (m_isReady) return endStep({.error = error});
        // A kill from outside hits once; what ends every process is told of every step.
        if (m_failedStarts++ == 0) return;
        while (isBusy()) endStep({.error = error});
    }

    StepLimits m_limits;
    const Make& m_make;
    const Ended& m_ended;
    Whereabouts m_whereabouts{};
    Child m_child{};
    MessageReader m_reader{};
    Order m_order{};                       ///< what is left to do
    std::size_t m_done = 0;                ///< steps of this process
    bool m_isReady = false;                ///< begin() is behind it
    int m_failedStarts = 0;                ///< of this task
    std::map<std::string, int> m_stops{};  ///< of this task, by where
    Clock::time_point m_deadline{}, m_stepBegan{};
    std::string m_stopped{};  ///< why we have killed it
    std::size_t m_stoppedAt = 0;
    bool m_isTooLarge = false;
    std::string m_thrown{};
};

}  // namespace

void runSteps(std::span<const std::size_t> steps, int workers, const StepLimits& limits, const Make& make,
              const Ended& ended) {
    std::vector<std::unique_ptr<Seat>> seats;
    for (int i = 0; i < std::max(1, workers); ++i)
        seats.push_back(std::make_unique<Seat>(limits, make, ended));
    std::size_t next = 0;
    for (;;) {
        std::vector<pollfd> polls;
        std::vector<Seat*> busy;
        auto wake = Clock::time_point::max();
        for (const auto& seat : seats) {
            while (!seat->isBusy() && next < steps.size()) {
                seat->take(next, steps[next]);
                ++next;
            }
            if (!seat->isBusy()) continue;
            polls.push_back({seat->socket(), POLLIN, 0});
            busy.push_back(seat.get());
            wake = std::min(wake, seat->nextLook());
        }
        if (busy.empty()) return;
        const auto now = Clock::now();
        const long long wait = wake <= now ? 0
                                           : std::chrono::ceil<std::chrono::milliseconds>(
                                                 std::min(wake - now, Clock::duration(60'000'000'000)))
                                                 .count();
        if (poll(polls.data(), polls.size(), int(wait)) < 0 && errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "poll");
        for (std::size_t i = 0; i < busy.size(); ++i) {
            if (polls[i].revents) busy[i]->read();
            busy[i]->look();
        }
    }
}

}  // namespace gnomon
