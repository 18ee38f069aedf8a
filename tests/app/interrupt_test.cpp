// A run that is interrupted, and one that loses a worker: what is left of them.

#include <signal.h>

#include <nlohmann/json.hpp>

#include "program.h"
#include "running.h"

namespace gnomon {
namespace interrupt_test {

using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

class Interrupted : public ProgramTest {};

// Long enough that no machine is through before its workers are seen.
const std::vector<std::string> kLongRun{"matrix", "--jobs", "2", "--frames", "0-59"};

TEST_F(Interrupted, RunEndsWithAllItsWorkersAndLeavesNothing) {
    for (const int signal : {SIGTERM, SIGINT}) {
        std::vector<std::string> arguments = kLongRun;
        arguments.insert(arguments.end(), {"--report", pathOf("page.html")});
        const Running run(arguments);
        ASSERT_THAT(run.workers(2), SizeIs(2));
        run.interrupt(signal);
        EXPECT_EQ(run.output(), "") << "or this waits for a worker that is left";
        EXPECT_EQ(run.status(), 128 + signal);
        EXPECT_THAT(leftBehind(), IsEmpty());
    }
}

TEST_F(Interrupted, WorkersDieWithARunThatIsKilled) {
    const Running run(kLongRun);
    ASSERT_THAT(run.workers(2), SizeIs(2));
    run.interrupt(SIGKILL);
    EXPECT_EQ(run.output(), "");
    EXPECT_EQ(run.status(), -SIGKILL);
}

// A user, or the system for want of memory, kills one worker: it costs a cell, or nothing while it makes a
// frame ready.
TEST_F(Interrupted, KilledWorkerCostsOneCellAtMost) {
    const Running run(
        {"matrix", "boxes", "--jobs", "2", "--frames", "0,30", "--profile", "ideal,tnt", "--format", "json"});
    const auto workers = run.workers(2);
    ASSERT_THAT(workers, SizeIs(2));
    kill(workers.back(), SIGKILL);
    std::size_t failed = 0;
    const auto cells = nlohmann::json::parse(run.output());
    for (const auto& cell : cells) {
        if (cell["verdict"] != "failed") continue;
        ++failed;
        EXPECT_THAT(std::string(cell["error"]), StartsWith("killed from outside: signal 9"));
    }
    EXPECT_EQ(cells.size(), 84u);
    EXPECT_LE(failed, 1u);
    EXPECT_EQ(run.status(), failed ? 3 : 0);
}

}  // namespace interrupt_test
}  // namespace gnomon
