#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "matrix/whereabouts.h"

namespace gnomon {

/// What one step may take.
struct StepLimits {
    double seconds = 900;       ///< wall clock, of a step and of what its task makes ready
    std::size_t megabytes = 0;  ///< of its worker's own resident memory (2^20 bytes); 0: no limit
};

/// What a worker process does: tasks of several steps, one after the other.
class StepWorker {
  public:
    virtual ~StepWorker() = default;
    /// Two steps of the task that begins next were stopped at @p where (Whereabouts): whoever comes there
    /// again may throw instead, if it is what the task's steps share.
    virtual void avoid(const std::string& where) { (void)where; }
    /// Makes ready what the steps of @p task share.
    virtual void begin(std::size_t task) = 0;
    /// @return what goes to the parent
    virtual std::string step(std::size_t task, std::size_t step) = 0;
};

/// How a step ended.
struct StepEnd {
    std::string result{};
    double seconds = 0;   ///< wall clock, of a task's first step with what was made ready for it
    std::string error{};  ///< "", or "crashed: signal 11 (Segmentation fault) in pass 3 of 7: fronts"
};

/// Does all steps of all tasks in @p workers processes, which live on from task to task. A step that crashes,
/// throws, or goes beyond @p limits costs that step only: its worker is replaced, and the new one goes on
/// with the next step. What fails before a task's first step is tried twice, and then costs the rest of the
/// task. A worker that has kept too much of earlier steps is replaced before the step is held to the memory
/// limit.
///
/// @param steps  of each task
/// @param make   called once in each worker's process
/// @param ended  called in this process as each step ends: the steps of a task in their order, tasks in any
void runSteps(std::span<const std::size_t> steps, int workers, const StepLimits& limits,
              const std::function<std::unique_ptr<StepWorker>(Whereabouts&)>& make,
              const std::function<void(std::size_t task, std::size_t step, StepEnd)>& ended);

}  // namespace gnomon
