// Faults planted in the workers of a run: each costs its own cell, says what it was and in which pass, and
// leaves all others as they are.

#include <dlfcn.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstring>

#include "matrix/cell_json.h"
#include "matrix/check.h"
#include "matrix/lab.h"
#include "matrix/run.h"
#include "process/die_of.h"
#include "scenes.h"

namespace gnomon {
namespace worker_faults_test {

using testing::MatchesRegex;
using testing::StartsWith;

/// Two frames, three methods, two chips: 12 small cells in two groups.
MatrixRequest smallRequest() {
    MatrixRequest request;
    request.profiles = {chip("voodoo2"), chip("ideal")};
    request.methods = {method("roettger-screen"), method("none"), method("heidmann")};
    request.scenes = {shippedScene("boxes")};
    request.sizes = {{48, 32}};
    request.frames = {0, 15};
    return request;
}

const std::string kFaulty = "ideal/heidmann/boxes/48x32/0";  ///< neither first nor last

/// Runs the request with @p fault in each stage of the cell kFaulty that @p isStage picks, and holds all
/// other cells to a run without it.
/// @return what that cell says
std::string errorWith(MatrixRequest request, const std::function<bool(const std::string&)>& isStage,
                      const std::function<void()>& fault) {
    const std::vector<Cell> good = runMatrix(request);
    request.atStage = [&](const std::string& cell, const std::string& stage) {
        if (cell == kFaulty && isStage(stage)) fault();
    };
    std::string error;
    for (const int jobs : {1, 2}) {
        request.jobs = jobs;
        const std::vector<Cell> cells = runMatrix(request);
        EXPECT_EQ(cells.size(), good.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
            EXPECT_EQ(cells[i].id(), good[i].id());
            if (cells[i].id() == kFaulty) {
                EXPECT_EQ(cells[i].verdict, Verdict::Failed);
                EXPECT_EQ(cells[i].question(), good[i].question());
                error = cells[i].error;
            } else {
                EXPECT_EQ(withoutTimes(cells[i]), withoutTimes(good[i])) << jobs << " jobs";
            }
        }
    }
    return error;
}

bool isFirst(const std::string& stage) {
    return stage.empty();
}
bool isThirdPass(const std::string& stage) {
    return stage.starts_with("pass 3 of ");
}
void hang() {
    for (;;) pause();
}

TEST(WorkerFaults, CrashBeforeAnyPassCostsItsCell) {
    EXPECT_EQ(errorWith(smallRequest(), isFirst, [] { dieOf(SIGSEGV); }),
              "crashed: signal 11 (Segmentation fault)");
}

TEST(WorkerFaults, CrashInTheDriverNamesThePass) {
    EXPECT_THAT(errorWith(smallRequest(), isThirdPass, [] { dieOf(SIGSEGV); }),
                MatchesRegex("crashed: signal 11 \\(Segmentation fault\\) in pass 3 of [0-9]+: .+"));
}

TEST(WorkerFaults, AbortInThePredictionNamesIt) {
    const auto isPrediction = [](const std::string& stage) { return stage == "the prediction"; };
    EXPECT_EQ(errorWith(smallRequest(), isPrediction, [] { dieOf(SIGABRT); }),
              "crashed: signal 6 (Aborted) in the prediction");
}

TEST(WorkerFaults, KillFromOutsideCostsItsCell) {
    EXPECT_THAT(errorWith(smallRequest(), isThirdPass, [] { kill(getpid(), SIGKILL); }),
                StartsWith("killed from outside: signal 9 (Killed) in pass 3 of "));
}

TEST(WorkerFaults, EndlessLoopIsStoppedAtItsLimit) {
    MatrixRequest request = smallRequest();
    request.limits.seconds = 5;  // many times what any of these cells takes
    EXPECT_THAT(errorWith(request, isThirdPass, hang), StartsWith("timed out after 5 s in pass 3 of "));
}

TEST(WorkerFaults, MemoryEaterIsStoppedAtItsLimit) {
    MatrixRequest request = smallRequest();
    request.limits.megabytes = 1500;
    const auto eat = [] {
        for (;;) {
            constexpr std::size_t kSize = 20 << 20;
            void* memory = mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
            if (memory != MAP_FAILED) std::memset(memory, 1, kSize);
        }
    };
    EXPECT_THAT(errorWith(request, isThirdPass, eat),
                MatchesRegex("took [0-9]+ MB of memory, more than 1500 in pass 3 of .*"));
}

TEST(WorkerFaults, ExceptionThatNobodyExpectsCostsItsCell) {
    EXPECT_EQ(errorWith(smallRequest(), isFirst, [] { throw 7; }), "unknown exception");
}

// A driver that does something else at the second time, behind the capability layer's back: it clears the
// picture in the middle of a cell. Only that cell is flaky.
TEST(WorkerFaults, CellThatComesOutOtherwiseTheSecondTimeIsFlaky) {
    using Clear = void (*)(unsigned);
    const auto clear = reinterpret_cast<Clear>(dlsym(RTLD_DEFAULT, "glClear"));
    if (!clear) GTEST_SKIP() << "OpenGL is not linked to here";
    MatrixRequest request = smallRequest();
    std::vector<std::vector<Cell>> runs{runMatrix(request)};
    request.atStage = [&](const std::string& cell, const std::string& stage) {
        constexpr unsigned kColourBuffer = 0x4000;
        if (cell == kFaulty && isThirdPass(stage)) clear(kColourBuffer);
    };
    runs.push_back(runMatrix(request));
    const CheckResult result = checkCells({}, runs, false);
    for (const CheckedCell& cell : result.cells)
        EXPECT_EQ(cell.what == CheckClass::Flaky, cell.cell.id() == kFaulty)
            << cell.place << ": " << cell.found;
}

// What the cells of a frame share is waited for twice, and not once for each of them. Other frames are as
// ever.
TEST(WorkerFaults, HangInTheTruthOfAFrameCostsTwoTimeOuts) {
    MatrixRequest request = smallRequest();
    request.jobs = 1;
    const std::vector<Cell> good = runMatrix(request);
    request.limits.seconds = 3;
    request.atStage = [](const std::string& cell, const std::string& stage) {
        if (cell.ends_with("/0") && stage == kTruthStage) hang();
    };
    int timeOuts = 0, others = 0;
    const std::vector<Cell> cells = runMatrix(request);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string& error = cells[i].error;
        timeOuts += error == "timed out after 3 s in truth";
        others += error == "not drawn: two cells of this frame were stopped in its truth";
        if (error.empty()) {
            EXPECT_EQ(withoutTimes(cells[i]), withoutTimes(good[i]));
        }
        EXPECT_EQ(!error.empty(), cells[i].frame == 0 && good[i].verdict != Verdict::Refused)
            << cells[i].id();
    }
    EXPECT_EQ(timeOuts, 2);
    EXPECT_GT(others, 0);
}

// With a limit of no time at all nothing is made ready in time.
TEST(WorkerFaults, NoTimeFailsEveryCell) {
    MatrixRequest request = smallRequest();
    request.limits.seconds = 0;
    for (const Cell& cell : runMatrix(request)) {
        EXPECT_EQ(cell.verdict, Verdict::Failed);
        EXPECT_THAT(cell.error, StartsWith("timed out after 0 s"));
    }
}

}  // namespace worker_faults_test
}  // namespace gnomon
