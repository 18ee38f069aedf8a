#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gnomon {

/// One piece of work that a process of its own does: it sends lines, which come back in order.
struct Job {
    std::string name{};                                                        ///< for messages
    std::function<void(const std::function<void(std::string)>& emit)> work{};  ///< runs in a child process
};

/// How a job ended besides its lines.
struct JobEnd {
    std::vector<std::string> lines{};
    std::string
        error{};  ///< empty, or "crashed: signal 11", "timed out after 600 s", "exit 3", what it threw
};

/// Runs @p jobs in up to @p workers forked processes at a time, so that a crash costs one job only.
/// Each job has a process of its own. workers.h is for many small pieces.
///
/// @param seconds  wall-clock limit of one job
/// @param ended    called in this process as each job ends, in any order
void runJobs(const std::vector<Job>& jobs, int workers, int seconds,
             const std::function<void(std::size_t job, JobEnd)>& ended);

}  // namespace gnomon
