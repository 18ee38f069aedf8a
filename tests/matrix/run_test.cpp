// Runs over many cells: which, in what order, and the same whatever the number of processes.

#include "matrix/run.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "matrix/cell_json.h"
#include "matrix/lab.h"
#include "scenes.h"

namespace gnomon {
namespace run_test {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

Scene sceneOfFrames(std::size_t frames) {
    Scene scene;
    scene.frames.resize(frames);
    return scene;
}

TEST(FramesOf, TakesTwelveATwelfthOfThePathApart) {
    EXPECT_THAT(framesOf({}, sceneOfFrames(60)), ElementsAre(0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55));
    EXPECT_THAT(framesOf({}, sceneOfFrames(13)), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
}

TEST(FramesOf, TakesAFrameOfAShortPathOnce) {
    EXPECT_THAT(framesOf({}, sceneOfFrames(1)), ElementsAre(0));
    EXPECT_THAT(framesOf({}, sceneOfFrames(2)), ElementsAre(0, 1));
}

TEST(FramesOf, SortsTheRequestAndLeavesOutWhatIsBeyondThePath) {
    MatrixRequest request;
    request.frames = {5, 3, 60, 5, 59};
    EXPECT_THAT(framesOf(request, sceneOfFrames(60)), ElementsAre(3, 5, 59));
    EXPECT_THAT(framesOf(request, sceneOfFrames(2)), IsEmpty());
}

/// Two scenes, two sizes, two frames, three methods, two chips: 48 small cells, some refused, some wrong.
MatrixRequest smallRequest() {
    MatrixRequest request;
    request.profiles = {chip("voodoo2"), chip("ideal")};
    request.methods = {method("roettger-screen"), method("none"), method("heidmann")};
    request.scenes = {shippedScene("roettger"), shippedScene("boxes")};
    request.sizes = {{48, 32}, {32, 48}};
    request.frames = {15, 2};
    return request;
}

std::vector<std::string> idsOf(const std::vector<Cell>& cells) {
    std::vector<std::string> ids;
    for (const Cell& cell : cells) ids.push_back(cell.id());
    return ids;
}

TEST(RunMatrix, OrdersCellsByTheRequestWhateverEndsFirst) {
    MatrixRequest request = smallRequest();
    std::vector<std::string> expected;
    for (const char* scene : {"roettger", "boxes"})
        for (const char* size : {"48x32", "32x48"})
            for (const int frame : {2, 15})
                for (const char* id : {"roettger-screen", "none", "heidmann"})
                    for (const char* profile : {"voodoo2", "ideal"})
                        expected.push_back(fmt::format("{}/{}/{}/{}/{}", profile, id, scene, size, frame));
    for (const int jobs : {1, 2, 7}) {
        request.jobs = jobs;
        EXPECT_EQ(idsOf(runMatrix(request)), expected) << jobs << " jobs";
    }
}

TEST(RunMatrix, GivesTheSameCellsWithOneProcessTwoAndNone) {
    MatrixRequest request = smallRequest();
    const std::vector<Cell> one = runMatrix(request);
    request.jobs = 2;
    const std::vector<Cell> two = runMatrix(request);
    ASSERT_EQ(one.size(), two.size());
    std::map<std::string, std::unique_ptr<Lab>> labs;
    for (const Scene& scene : request.scenes) labs[scene.id] = std::make_unique<Lab>(scene);
    int drawn = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(withoutTimes(one[i]), withoutTimes(two[i]));
        const Cell& c = one[i];
        Cell here = labs[c.scene]->run(chip(c.profile), c.axes, c.width, c.height, c.frame);
        here.chosen = c.chosen;  // runMatrix() alone compares a chip's methods
        EXPECT_EQ(withoutTimes(here), withoutTimes(c));
        drawn += c.verdict != Verdict::Refused;
        EXPECT_EQ(c.digest.size(), c.verdict == Verdict::Refused ? 0u : 16u) << c.id();
    }
    EXPECT_EQ(drawn, 40) << "all but heidmann on the Voodoo 2";
}

TEST(RunMatrix, MarksThePathOfEachChip) {
    std::vector<std::string> chosen;
    MatrixRequest request = smallRequest();
    request.sizes = {{48, 32}}, request.frames = {0};
    request.scenes.resize(1);
    for (const Cell& cell : runMatrix(request))
        if (cell.chosen) chosen.push_back(cell.profile + " " + cell.method);
    EXPECT_THAT(chosen, ElementsAre("voodoo2 roettger-screen", "ideal heidmann"));
}

TEST(RunMatrix, ReportsProgressFromTheStartToTheLastCell) {
    MatrixRequest request = smallRequest();
    request.scenes.resize(1), request.sizes.resize(1);
    std::vector<Progress> seen, expected;
    runMatrix(request, [&](const Progress& progress) { seen.push_back(progress); });
    for (std::size_t done = 0; done <= 12; ++done) expected.push_back({.done = done, .all = 12});
    EXPECT_EQ(seen, expected);
}

/// A scene that crashes whoever draws it: a triangle of vertices that are far from its memory.
Scene crashingScene() {
    Scene scene = shippedScene("roettger");
    scene.id = "broken";
    scene.objects.back().mesh.triangles.push_back(glm::uvec3(0xfffffff0u));
    return scene;
}

TEST(RunMatrix, FailsAllCellsOfAFrameThatCantBeMadeReadyAndNoOthers) {
    MatrixRequest request = smallRequest();
    request.scenes = {shippedScene("roettger"), crashingScene(), shippedScene("boxes")};
    request.sizes.resize(1), request.frames = {0}, request.jobs = 2;
    Progress last;
    const std::vector<Cell> cells = runMatrix(request, [&](const Progress& progress) { last = progress; });
    ASSERT_EQ(cells.size(), 18u);
    EXPECT_EQ(last, (Progress{.done = 18, .all = 18, .failures = 6}));
    for (const Cell& cell : cells) {
        EXPECT_EQ(cell.verdict == Verdict::Failed, cell.scene == "broken") << cell.id();
        if (cell.scene == "broken") {
            EXPECT_THAT(cell.error, Not(IsEmpty()));
        }
    }
}

// The cells of one group are drawn by one worker; one that can't be drawn is a failure of its own.
TEST(RunMatrix, FailsOneCellOfAGroupAlone) {
    Profile odd = chip("ideal");
    odd.id = "odd";
    odd.colourFormats = {{"10-10-10", 10, 10, 10, 0}};
    MatrixRequest request = smallRequest();
    request.profiles = {chip("ideal"), odd, chip("tnt")};
    request.scenes.resize(1), request.sizes.resize(1), request.frames = {0};
    for (const Cell& cell : runMatrix(request)) {
        EXPECT_EQ(cell.verdict == Verdict::Failed, cell.profile == "odd") << cell.id();
        if (cell.profile == "odd") {
            EXPECT_EQ(cell.error, "no buffer of 10, 10, 10 and 0 bits");
        }
    }
}

}  // namespace run_test
}  // namespace gnomon
