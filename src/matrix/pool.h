#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gnomon {

/// One piece of work that a worker process does: it prints lines, which come back in order.
struct Job {
    std::string name{};                                                        ///< for messages
    std::function<void(const std::function<void(std::string)>& emit)> work{};  ///< runs in a child process
};

/// How a job ended besides its lines.
struct JobEnd {
    std::vector<std::string> lines{};
    std::string error{};  ///< empty, or "crashed: signal 11", "timed out after 600 s", "exit 3: what"
};

/// Runs @p jobs in up to @p workers forked processes at a time, so that a crash costs one job only.
/// Each job has a process of its own.
///
/// @param seconds  wall-clock limit of one job
/// @param ended    called in this process as each job ends, in any order
/// @param arrived  called in this process for each line as it comes in, in the job's order; before @p ended
void runJobs(const std::vector<Job>& jobs, int workers, int seconds,
             const std::function<void(std::size_t job, JobEnd)>& ended,
             const std::function<void(std::size_t job, const std::string& line)>& arrived = {});

}  // namespace gnomon
