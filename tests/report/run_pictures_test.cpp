// The pictures of a run, drawn again and packed.

#include "report/run_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "matrix/film_strip.h"
#include "matrix/lab.h"
#include "report/small_run.h"
#include "report/unpack.h"

namespace gnomon {
namespace run_pictures_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::SizeIs;

const RunPictures& drawn() {
    static const RunPictures all = drawRun(smallRun().cells, smallRun().sources, 2);
    return all;
}

Image shown(const RunPictures& run, const CellDrawing& drawing, const std::string& what) {
    for (const auto& [name, picture] : drawing.pictures)
        if (name == what) return unpacked(run.pictures, run.chunks, picture);
    return {};
}

std::size_t bytesOf(const RunPictures& run) {
    std::size_t sum = 0;
    for (const PackedChunk& chunk : run.chunks) sum += chunk.deflated.size();
    return sum;
}

TEST(ShownCells, AreTheWorstFrameOfEachElseTheFirst) {
    std::vector<Cell> cells(6);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        cells[i].profile = std::string(1, i < 3 ? 'a' : 'b');
        cells[i].frame = int(i % 3);
        cells[i].verdict = Verdict::Exact;
    }
    EXPECT_EQ(shownCells(cells), (std::vector<std::size_t>{0, 3}));
    cells[1].wrongEdge = 2, cells[2].wrongInterior = 2;
    cells[3].verdict = Verdict::Refused;
    cells[5].wrongEdge = 1;
    EXPECT_EQ(shownCells(cells), (std::vector<std::size_t>{1, 5}));
    // A leak is worse than many pixels at a boundary.
    cells[0].verdict = Verdict::Edge, cells[0].wrongEdge = 9;
    cells[1].verdict = Verdict::Wrong, cells[1].wrongInterior = 1;
    EXPECT_EQ(shownCells(cells), (std::vector<std::size_t>{1, 5}));
    for (Cell& cell : cells) cell.verdict = Verdict::Failed;
    EXPECT_TRUE(shownCells(cells).empty());
}

TEST(RunPictures, ShowEveryShownCellOnce) {
    std::multiset<std::size_t> cells;
    for (const CellDrawing& drawing : drawn().drawings)
        cells.insert(drawing.cells.begin(), drawing.cells.end());
    const auto wanted = shownCells(smallRun().cells);
    EXPECT_EQ(cells, std::multiset<std::size_t>(wanted.begin(), wanted.end()));
    EXPECT_LT(drawn().drawings.size(), wanted.size()) << "no two cells share a drawing";
}

// Against pictures that are drawn here, one cell after the other.
TEST(RunPictures, AreThoseOfTheirCells) {
    Lab lab(smallRun().request.scenes[0]);
    for (const CellDrawing& drawing : drawn().drawings) {
        for (const std::size_t index : drawing.cells) {
            const Cell& cell = smallRun().cells[index];
            const Profile& profile = smallRun().sources.profiles.at(cell.profile);
            SCOPED_TRACE(cell.id());
            const Plan plan = drawnPlan(lab, profile, cell.axes, cell.width, cell.height, cell.frame);
            std::vector<StripPicture> steps;
            Pictures pictures;
            lab.run(profile, cell.axes, cell.width, cell.height, cell.frame, &pictures,
                    stripReader(stripPasses(plan, 8), maskBufferOf(plan),
                                [&](StripPicture step) { steps.push_back(std::move(step)); }));
            EXPECT_EQ(shown(drawn(), drawing, "image"), pictures.image);
            EXPECT_EQ(shown(drawn(), drawing, "mask"), pictures.mask);
            EXPECT_EQ(shown(drawn(), drawing, "truth"), pictures.truth);
            const Image causes = shown(drawn(), drawing, "causes");
            const Image difference = shown(drawn(), drawing, "difference");
            for (std::size_t i = 0; i < pictures.causes.size(); ++i) {
                ASSERT_EQ(causes.data[i], int(pictures.causes[i]));
                ASSERT_EQ(difference.data[i], std::abs(pictures.mask.data[i] - pictures.truth.data[i]));
            }
            ASSERT_EQ(drawing.strip.size(), steps.size());
            for (std::size_t s = 0; s < steps.size(); ++s) {
                const StripFrame& frame = drawing.strip[s];
                EXPECT_EQ(frame.pass, steps[s].pass + 1);
                EXPECT_EQ(frame.title, plan.passes[steps[s].pass].label);
                EXPECT_FALSE(frame.why.empty());
                EXPECT_EQ(unpacked(drawn().pictures, drawn().chunks, frame.buffers[0].second),
                          steps[s].colour);
                if (frame.buffers.size() > 1) {
                    EXPECT_EQ(unpacked(drawn().pictures, drawn().chunks, frame.buffers[1].second),
                              steps[s].mask);
                }
            }
        }
    }
}

TEST(RunPictures, HaveTheBufferInWhichTheMaskStands) {
    std::set<std::string> buffers;
    for (const CellDrawing& drawing : drawn().drawings)
        for (const StripFrame& frame : drawing.strip)
            for (const auto& buffer : frame.buffers) buffers.insert(buffer.first);
    EXPECT_EQ(buffers, (std::set<std::string>{"alpha", "colour", "stencil"}));
}

// The default matrix has 465 drawings; a report of 5 MB has 3 MB for them beside its page.
TEST(RunPictures, LeaveRoomForTheDefaultMatrix) {
    MatrixRequest request = smallRun().request;
    request.sizes = {{}};
    request.frames = {0};
    const std::vector<Cell> cells = runMatrix(request);
    const RunPictures all = drawRun(cells, smallRun().sources, 2);
    RunPictures bare = all;
    for (CellDrawing& drawing : bare.drawings) drawing.strip.clear(), drawing.stripChunk = -1;
    bare = fitted(bare, bytesOf(all));
    EXPECT_LT(bytesOf(bare) / bare.drawings.size() * 465, 2'700'000u);
    EXPECT_LT(bytesOf(bare), bytesOf(all) / 2) << "strips take most";
}

TEST(RunPictures, AreTheSameWhoeverDrawsThem) {
    const RunPictures again = drawRun(smallRun().cells, smallRun().sources, 1);
    ASSERT_EQ(again.chunks.size(), drawn().chunks.size());
    for (std::size_t i = 0; i < again.chunks.size(); ++i)
        EXPECT_EQ(again.chunks[i].deflated, drawn().chunks[i].deflated);
}

TEST(RunPictures, MarkTheCellThatComesOutOtherwise) {
    std::vector<Cell> cells = smallRun().cells;
    const std::size_t index = shownCells(cells).back();
    cells[index].digest = "0123456789abcdef";
    ++cells[index].wrongEdge;
    const RunPictures all = drawRun(cells, smallRun().sources, 2);
    EXPECT_EQ(shownCells(cells).back(), index);
    EXPECT_THAT(faultsOf(all), ElementsAre(Pair(index,
                                                "drawn again, it differs from the run in digest, "
                                                "wrong.edge")));
    EXPECT_TRUE(faultsOf(drawn()).empty());
    EXPECT_THAT(faultsOf(fitted(all, 0)), SizeIs(1)) << "what differs is said without its pictures too";
}

// The pictures are the same, what the run says of them is not.
TEST(RunPictures, MarkTheCellThatIsJudgedOtherwise) {
    std::vector<Cell> cells = smallRun().cells;
    const std::size_t index = shownCells(cells).back();
    cells[index].wrongInterior += 40;
    cells[index].causes["mask clamps"] += 40;
    const RunPictures all = drawRun(cells, smallRun().sources, 2);
    EXPECT_THAT(faultsOf(all), ElementsAre(Pair(index, testing::EndsWith(" in causes, wrong.interior"))));
}

TEST(RunPictures, SayWhichCellIsRefusedNow) {
    RunSources sources = smallRun().sources;
    sources.profiles.at("tnt") = sources.profiles.at("ps1");
    const RunPictures all = drawRun(smallRun().cells, sources, 2);
    const auto faults = faultsOf(all);
    ASSERT_FALSE(faults.empty());
    bool isRefused = false;
    for (const auto& [cell, what] : faults) {
        EXPECT_EQ(smallRun().cells[cell].profile, "tnt");
        isRefused = isRefused || what.find("drawn again: it is refused: the chip lacks") == 0;
    }
    EXPECT_TRUE(isRefused);
}

TEST(RunPictures, HaveThePassesOfWhatIsRefused) {
    const std::vector<Cell>& cells = smallRun().cells;
    const std::vector<std::size_t> refused = refusedCells(cells);
    ASSERT_FALSE(refused.empty());
    Lab lab(smallRun().request.scenes[0]);
    EXPECT_EQ(drawn().refusedPlans.size(), refused.size());
    for (const std::size_t i : refused) {
        const Cell& cell = cells[i];
        EXPECT_EQ(cell.frame, 0) << "of two frames the first";
        const Plan plan = lab.plan(smallRun().sources.profiles.at(cell.profile), cell.axes, cell.width,
                                   cell.height, cell.frame);
        EXPECT_THAT(drawn().refusedPlans.at(i), HasSubstr(plan.passes.back().label)) << cell.id();
    }
}

// Strips of drawings that show nothing new go first, then all strips, then drawings; what is kept decodes to
// the same pictures.
TEST(FittedPictures, KeepWhatIsNewestAndStillDecode) {
    const std::size_t all = bytesOf(drawn());
    std::size_t before = drawn().drawings.size() + 1;
    for (const double share : {1.0, 0.8, 0.5, 0.2, 0.0}) {
        const auto limit = std::size_t(share * double(all));
        const RunPictures kept = fitted(drawn(), limit);
        EXPECT_LE(bytesOf(kept), limit);
        EXPECT_LE(kept.drawings.size(), before);
        before = kept.drawings.size();
        int mostNews = 0, leastLeftOut = 9;
        for (const CellDrawing& drawing : kept.drawings) {
            const auto same =
                std::find_if(drawn().drawings.begin(), drawn().drawings.end(),
                             [&](const CellDrawing& other) { return other.cells == drawing.cells; });
            for (const char* what : {"image", "mask", "truth", "causes", "difference"})
                EXPECT_EQ(shown(kept, drawing, what), shown(drawn(), *same, what)) << what;
            for (std::size_t s = 0; s < drawing.strip.size(); ++s)
                EXPECT_EQ(unpacked(kept.pictures, kept.chunks, drawing.strip[s].buffers[0].second),
                          unpacked(drawn().pictures, drawn().chunks, same->strip[s].buffers[0].second));
            (drawing.strip.empty() ? leastLeftOut : mostNews) = drawing.strip.empty()
                                                                    ? std::min(leastLeftOut, drawing.news)
                                                                    : std::max(mostNews, drawing.news);
        }
        EXPECT_LE(mostNews, leastLeftOut) << "a strip that shows less new was kept";
    }
    EXPECT_EQ(fitted(drawn(), all).drawings.size(), drawn().drawings.size());
    EXPECT_TRUE(fitted(drawn(), 0).drawings.empty());
    EXPECT_TRUE(fitted(drawn(), 0).pictures.empty());
}

}  // namespace run_pictures_test
}  // namespace gnomon
