// Worker processes: what comes back of jobs that end well, and of those that don't.

#include "matrix/pool.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <stdexcept>

#include "process/die_of.h"

namespace gnomon {
namespace pool_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

using Emit = std::function<void(std::string)>;

/// Far beyond what any job here takes; only a fault reaches it.
constexpr int kLongEnough = 60;

/// Runs @p works, which must all end exactly once.
std::vector<JobEnd> endsOf(const std::vector<std::function<void(const Emit&)>>& works, int workers = 2,
                           int seconds = kLongEnough) {
    std::vector<Job> jobs;
    for (const auto& work : works) jobs.push_back({"job", work});
    std::vector<JobEnd> ends(jobs.size());
    std::map<std::size_t, int> times;
    runJobs(jobs, workers, seconds, [&](std::size_t job, JobEnd end) {
        ends.at(job) = std::move(end);
        ++times[job];
    });
    for (std::size_t i = 0; i < jobs.size(); ++i) EXPECT_EQ(times[i], 1) << "ends of job " << i;
    return ends;
}

JobEnd endOf(const std::function<void(const Emit&)>& work, int seconds = kLongEnough) {
    return endsOf({work}, 1, seconds).front();
}

TEST(RunJobs, BringsLinesBackInOrder) {
    const JobEnd end = endOf([](const Emit& emit) {
        for (const char* line : {"one", "", "three\nof two"}) emit(line);
    });
    EXPECT_THAT(end.lines, ElementsAre("one", "", "three\nof two"));
    EXPECT_THAT(end.error, IsEmpty());
}

TEST(RunJobs, DoesNothingWithoutJobs) {
    EXPECT_THAT(endsOf({}), IsEmpty());
}

TEST(RunJobs, GivesEachJobAProcessOfItsOwn) {
    const auto pid = [](const Emit& emit) { emit(fmt::format("{}", getpid())); };
    const auto ends = endsOf({pid, pid}, 1);
    EXPECT_NE(ends[0].lines, ends[1].lines);
    EXPECT_NE(ends[0].lines.front(), fmt::format("{}", getpid()));
}

TEST(RunJobs, EndsManyJobsWithFewWorkers) {
    std::vector<std::function<void(const Emit&)>> works;
    for (int i = 0; i < 100; ++i) works.push_back([i](const Emit& emit) { emit(fmt::format("job {}", i)); });
    for (const int workers : {0, 1, 3, 200}) {
        const auto ends = endsOf(works, workers);
        for (int i = 0; i < 100; ++i)
            ASSERT_THAT(ends[std::size_t(i)].lines, ElementsAre(fmt::format("job {}", i)))
                << workers << " workers";
    }
}

// A pipe holds 64 KiB, so the parent must read while the child writes.
TEST(RunJobs, TakesMoreOutputThanAPipeHolds) {
    const std::string longLine(3'000'000, 'x');
    const auto ends = endsOf({[&](const Emit& emit) { emit(longLine); },
                              [](const Emit& emit) {
                                  for (int i = 0; i < 50'000; ++i) emit(fmt::format("line {}", i));
                              }});
    EXPECT_THAT(ends[0].lines, ElementsAre(longLine));
    ASSERT_THAT(ends[1].lines, SizeIs(50'000));
    EXPECT_EQ(ends[1].lines.back(), "line 49999");
}

TEST(RunJobs, SaysInOneLineWhatAJobThrew) {
    const JobEnd end = endOf([](const Emit& emit) {
        emit("before");
        throw std::runtime_error("no\nmemory");
    });
    EXPECT_THAT(end.lines, ElementsAre("before"));
    EXPECT_EQ(end.error, "no memory");
}

TEST(RunJobs, NamesTheSignalThatEndedAJob) {
    EXPECT_THAT(endOf([](const Emit&) { dieOf(SIGSEGV); }).error, StartsWith("crashed: signal 11"));
    EXPECT_THAT(endOf([](const Emit&) { dieOf(SIGABRT); }).error, StartsWith("crashed: signal 6"));
    EXPECT_THAT(endOf([](const Emit&) { raise(SIGKILL); }).error,
                StartsWith("killed from outside: signal 9"));
}

// It must not unwind into the parent's frames, which the child has a copy of.
TEST(RunJobs, StopsAnUnknownExceptionInTheChild) {
    EXPECT_EQ(endOf([](const Emit&) { throw 1; }).error, "unknown exception");
}

TEST(RunJobs, GivesTheStatusOfAJobThatExits) {
    EXPECT_EQ(endOf([](const Emit&) { _exit(7); }).error, "exit 7");
}

TEST(RunJobs, StopsAJobAtItsTimeLimit) {
    const JobEnd end = endOf(
        [](const Emit& emit) {
            emit("before");
            pause();
        },
        1);
    EXPECT_EQ(end.error, "timed out after 1 s");
    EXPECT_THAT(end.lines, ElementsAre("before"));
}

TEST(RunJobs, LosesOnlyTheJobThatFails) {
    const auto good = [](const Emit& emit) { emit("good"); };
    const auto ends = endsOf({good, [](const Emit&) { dieOf(SIGSEGV); }, good, [](const Emit&) { pause(); },
                              [](const Emit&) { throw std::runtime_error("what"); }, good},
                             2, 1);
    for (const std::size_t i : {0u, 2u, 5u}) {
        EXPECT_THAT(ends[i].lines, ElementsAre("good"));
        EXPECT_THAT(ends[i].error, IsEmpty());
    }
    EXPECT_THAT(ends[1].error, HasSubstr("signal 11"));
    EXPECT_THAT(ends[3].error, HasSubstr("timed out"));
    EXPECT_EQ(ends[4].error, "what");
}

}  // namespace pool_test
}  // namespace gnomon
