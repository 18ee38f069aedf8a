// Workers that live on from task to task: what they bring back, and what a step costs that ends one of them.

#include "matrix/workers.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "process/die_of.h"

namespace gnomon {
namespace workers_test {

using testing::EndsWith;
using testing::IsEmpty;

/// Far beyond what any step here takes; only a fault reaches it.
constexpr double kLongEnough = 60;

using Step = std::function<std::string(std::size_t task, std::size_t step)>;
using Begin = std::function<void(std::size_t task)>;

class Acting : public StepWorker {
  public:
    Acting(Begin begin, Step step, Whereabouts& whereabouts)
        : m_begin(std::move(begin)), m_step(std::move(step)), m_whereabouts(whereabouts) {}
    void begin(std::size_t task) override {
        m_whereabouts.tell("its set-up");
        if (m_begin) m_begin(task);
    }
    std::string step(std::size_t task, std::size_t step) override {
        m_whereabouts.tell(fmt::format("part {}", step));
        return m_step(task, step);
    }

  private:
    Begin m_begin;
    Step m_step;
    Whereabouts& m_whereabouts;
};

/// By task, its steps; all must end exactly once, in order.
using Ends = std::map<std::size_t, std::vector<StepEnd>>;

Ends endsOf(const std::vector<std::size_t>& steps, const Step& step, int workers = 2,
            StepLimits limits = {kLongEnough}, const Begin& begin = {}) {
    Ends ends;
    runSteps(
        steps, workers, limits,
        [&](Whereabouts& whereabouts) { return std::make_unique<Acting>(begin, step, whereabouts); },
        [&](std::size_t task, std::size_t index, StepEnd end) {
            EXPECT_EQ(index, ends[task].size()) << "task " << task;
            ends[task].push_back(std::move(end));
        });
    for (std::size_t i = 0; i < steps.size(); ++i) {
        EXPECT_EQ(ends[i].size(), steps[i]) << "task " << i;
    }
    return ends;
}

std::string named(std::size_t task, std::size_t step) {
    return fmt::format("{}.{}", task, step);
}

/// The ids of the processes that did the steps.
std::string processId(std::size_t, std::size_t) {
    return fmt::format("{}", getpid());
}

/// All steps but @p failing of one task of six are done, and that one has an error.
std::string onlyErrorOf(const Ends& ends, std::size_t failing) {
    const auto& steps = ends.at(0);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        EXPECT_EQ(steps[i].error.empty(), i != failing) << i << ": " << steps[i].error;
        EXPECT_EQ(steps[i].result, i == failing ? "" : named(0, i));
    }
    return steps[failing].error;
}

TEST(RunSteps, BringsEveryResultBackWhateverTheNumberOfWorkers) {
    const std::vector<std::size_t> steps{3, 0, 100, 1, 0, 7};
    for (const int workers : {0, 1, 2, 9})
        for (const auto& [task, ends] : endsOf(steps, named, workers))
            for (std::size_t i = 0; i < ends.size(); ++i) {
                EXPECT_EQ(ends[i].result, named(task, i));
                EXPECT_EQ(ends[i].error, "");
            }
    EXPECT_THAT(endsOf({}, named), IsEmpty());
}

TEST(RunSteps, KeepsItsProcessesFromTaskToTask) {
    std::set<std::string> ids;
    for (const auto& [task, ends] : endsOf({4, 4, 4, 4}, processId, 2))
        for (const StepEnd& end : ends) ids.insert(end.result);
    EXPECT_LE(ids.size(), 2u);
    EXPECT_FALSE(ids.contains(processId(0, 0)));
}

TEST(RunSteps, LosesOnlyTheStepThatCrashes) {
    const auto crash = [](std::size_t task, std::size_t step) {
        if (step == 3) dieOf(SIGSEGV);
        return named(task, step);
    };
    EXPECT_EQ(onlyErrorOf(endsOf({6}, crash), 3), "crashed: signal 11 (Segmentation fault) in part 3");
}

TEST(RunSteps, LosesOnlyTheStepWhoseWorkerIsKilled) {
    const auto die = [](std::size_t task, std::size_t step) {
        if (step == 0) kill(getpid(), SIGKILL);
        return named(task, step);
    };
    EXPECT_EQ(onlyErrorOf(endsOf({6}, die), 0), "killed from outside: signal 9 (Killed) in part 0");
}

TEST(RunSteps, LosesOnlyTheStepThatNeverEnds) {
    const auto hang = [](std::size_t task, std::size_t step) {
        while (step == 5) pause();
        return named(task, step);
    };
    EXPECT_EQ(onlyErrorOf(endsOf({6}, hang, 1, {0.5}), 5), "timed out after 0.5 s in part 5");
}

TEST(RunSteps, LosesOnlyTheStepThatThrowsOrExits) {
    const auto fault = [](std::size_t task, std::size_t step) -> std::string {
        if (task == 0 && step == 2) throw std::runtime_error("what\nit was");
        if (task == 0 && step == 4) _exit(0);
        if (task == 1 && step == 0) throw 1;
        return named(task, step);
    };
    const Ends ends = endsOf({6, 6}, fault);
    EXPECT_EQ(ends.at(0)[2].error, "what it was");
    EXPECT_EQ(ends.at(0)[4].error, "ended by itself in part 4");
    EXPECT_EQ(ends.at(1)[0].error, "unknown exception");
    int good = 0;
    for (const auto& [task, steps] : ends)
        for (const StepEnd& end : steps) good += end.error.empty();
    EXPECT_EQ(good, 9);
}

/// Takes @p megabytes and keeps them.
void eat(std::size_t megabytes) {
    const std::size_t size = megabytes << 20;
    void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory != MAP_FAILED) std::memset(memory, 1, size);
}

/// What this process holds, and a worker begins with: under a sanitizer hundreds, where tests came before.
std::size_t ownMegabytes() {
    std::size_t all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * std::size_t(sysconf(_SC_PAGESIZE)) >> 20;
}

constexpr std::size_t kMegabytes = 600;  ///< far above what a worker of one test holds

TEST(RunSteps, LosesOnlyTheStepThatEatsMemory) {
    const auto glutton = [](std::size_t task, std::size_t step) {
        while (step == 4) eat(20);
        return named(task, step);
    };
    const std::string error = onlyErrorOf(endsOf({6}, glutton, 1, {kLongEnough, kMegabytes}), 4);
    EXPECT_THAT(error, testing::MatchesRegex("took [0-9]+ MB of memory, more than 600 in part 4"));
}

// What a worker has kept of earlier steps is not held against the next: it gets a worker of its own. The
// worker waits there, as one that goes on would be through before anybody has looked.
TEST(RunSteps, HoldsNoStepToWhatEarlierOnesHaveKept) {
    const auto hoarder = [kept = std::size_t(0)](std::size_t task, std::size_t step) mutable {
        eat(400);
        kept += 400;
        while (kept > kMegabytes) pause();
        return named(task, step);
    };
    const Ends ends = endsOf({4}, hoarder, 1, {kLongEnough, ownMegabytes() + kMegabytes});
    for (const StepEnd& end : ends.at(0)) EXPECT_EQ(end.error, "");
}

TEST(RunSteps, HoldsNobodyToAMemoryLimitThatIsNotSet) {
    const auto eats = [](std::size_t task, std::size_t step) {
        eat(50);
        return named(task, step);
    };
    const Ends ends = endsOf({3}, eats, 1);
    for (const StepEnd& end : ends.at(0)) EXPECT_EQ(end.error, "");
}

// What the steps share can't be made ready: no step can be done, and one process more tells that it is so.
TEST(RunSteps, TriesTheSetUpOfATaskTwice) {
    const auto crash = [](std::size_t task) {
        if (task == 0) dieOf(SIGABRT);
    };
    const Ends ends = endsOf({3, 2}, named, 1, {kLongEnough}, crash);
    for (const StepEnd& end : ends.at(0)) EXPECT_EQ(end.error, "crashed: signal 6 (Aborted) in its set-up");
    for (const StepEnd& end : ends.at(1)) EXPECT_EQ(end.error, "");
}

TEST(RunSteps, SurvivesASetUpThatIsKilledOnce) {
    void* shared = mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(shared, MAP_FAILED);
    int& starts = *static_cast<int*>(shared);
    const auto killed = [&](std::size_t) {
        if (++starts == 1) kill(getpid(), SIGKILL);
    };
    const Ends ends = endsOf({3}, named, 1, {kLongEnough}, killed);
    for (const StepEnd& end : ends.at(0)) EXPECT_EQ(end.error, "");
    EXPECT_EQ(starts, 2);
    munmap(shared, sizeof(int));
}

// The set-up is made anew for what is left after a crash.
TEST(RunSteps, BeginsATaskAgainInANewWorker) {
    std::string ready;
    const auto begin = [&](std::size_t task) { ready = fmt::format("ready {}", task); };
    const auto step = [&](std::size_t, std::size_t index) {
        if (index == 1) dieOf(SIGSEGV);
        return ready;
    };
    const Ends ends = endsOf({3}, step, 1, {kLongEnough}, begin);
    EXPECT_EQ(ends.at(0)[2].result, "ready 0");
}

// Each step ends its worker: as slow as it gets, and nothing is lost.
TEST(RunSteps, ReplacesAWorkerForEveryStepIfItMust) {
    const auto crash = [](std::size_t task, std::size_t step) {
        dieOf(SIGSEGV);
        return named(task, step);
    };
    const Ends ends = endsOf({40, 40}, crash);
    for (const auto& [task, steps] : ends)
        for (std::size_t i = 0; i < steps.size(); ++i)
            EXPECT_THAT(steps[i].error, EndsWith(fmt::format("in part {}", i)));
}

TEST(Whereabouts, CutsWhatIsTooLong) {
    Whereabouts whereabouts;
    EXPECT_EQ(whereabouts.text(), "");
    whereabouts.tell(std::string(1000, 'x'));
    EXPECT_EQ(whereabouts.text(), std::string(255, 'x'));
    whereabouts.tell("short");
    EXPECT_EQ(whereabouts.text(), "short");
}

}  // namespace workers_test
}  // namespace gnomon
