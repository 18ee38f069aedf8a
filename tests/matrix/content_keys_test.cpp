// The digests by which a kept result is taken for that of today: each thing that a result depends on changes
// them, and nothing else.

#include "matrix/content_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "scenes.h"

namespace gnomon {
namespace content_keys_test {

const RunMaker kMaker{"1", "g++", "llvmpipe", "a processor", 5};

MatrixRequest smallRequest() {
    MatrixRequest request;
    request.profiles = {chip("voodoo2"), chip("ideal")};
    request.methods = {method("carmack"), method("none")};
    request.scenes = {shippedScene("boxes"), shippedScene("knot")};
    request.sizes = {{48, 32}};
    request.frames = {0, 30};
    request.fidelities = {{Fidelity::Gl}, {Fidelity::Chip}};
    return request;
}

std::vector<std::uint64_t> keysOf(const MatrixRequest& request, const RunMaker& maker = kMaker) {
    const CellList list(request);
    const ContentKeys keys(list, maker);
    std::vector<std::uint64_t> all;
    for (std::size_t place = 0; place < list.count(); ++place) all.push_back(keys.of(place));
    return all;
}

/// The ids of cells whose keys @p change changes, with their fidelities.
std::set<std::string> changedBy(const std::function<void(MatrixRequest&, RunMaker&)>& change) {
    const MatrixRequest before = smallRequest();
    MatrixRequest after = before;
    RunMaker maker = kMaker;
    change(after, maker);
    const auto old = keysOf(before), now = keysOf(after, maker);
    const CellList list(before);
    std::set<std::string> changed;
    for (std::size_t place = 0; place < old.size(); ++place)
        if (old[place] != now[place])
            changed.insert(list.blank(place).id() + " " + list.blank(place).fidelity);
    return changed;
}

/// Those ids that have @p part in them.
std::set<std::string> idsWith(const std::string& part) {
    const MatrixRequest request = smallRequest();
    const CellList list(request);
    std::set<std::string> ids;
    for (std::size_t place = 0; place < list.count(); ++place)
        if (const std::string id = list.blank(place).id() + " " + list.blank(place).fidelity;
            id.find(part) != std::string::npos)
            ids.insert(id);
    return ids;
}

TEST(ContentKeys, AreDifferentForAllCellsOfARun) {
    const auto keys = keysOf(smallRequest());
    EXPECT_EQ(std::set(keys.begin(), keys.end()).size(), keys.size());
}

TEST(ContentKeys, ChangeWithTheProgramAndItsDriver) {
    const auto all = idsWith("");
    EXPECT_EQ(changedBy([](MatrixRequest&, RunMaker& m) { m.program = 6; }), all);
    EXPECT_EQ(changedBy([](MatrixRequest&, RunMaker& m) { m.driver = "softpipe"; }), all);
    EXPECT_EQ(changedBy([](MatrixRequest&, RunMaker& m) { m.version = "2"; }), all);
}

TEST(ContentKeys, DoNotChangeWithWhereAndHowFast) {
    EXPECT_TRUE(changedBy([](MatrixRequest& r, RunMaker& m) {
                    m.processor = "another", r.jobs = 9, r.limits.seconds = 1, r.shard = {1, 2};
                }).empty());
}

TEST(ContentKeys, ChangeWithAnyPartOfTheScene) {
    const auto boxes = idsWith("/boxes/");
    const auto sceneChange = [](const std::function<void(Scene&)>& change) {
        return changedBy([&](MatrixRequest& r, RunMaker&) { change(r.scenes[0]); });
    };
    EXPECT_EQ(sceneChange([](Scene& s) { s.objects[0].mesh.positions[0].x += 1e-6f; }), boxes);
    EXPECT_EQ(sceneChange([](Scene& s) {
                  std::swap(s.objects[0].mesh.triangles[0].x, s.objects[0].mesh.triangles[0].y);
              }),
              boxes);
    EXPECT_EQ(sceneChange([](Scene& s) { s.objects[0].colour.y /= 2; }), boxes);
    EXPECT_EQ(sceneChange([](Scene& s) { s.objects[0].casts = !s.objects[0].casts; }), boxes);
    EXPECT_EQ(sceneChange([](Scene& s) { s.objects[0].twoSided = !s.objects[0].twoSided; }), boxes);
    EXPECT_EQ(sceneChange([](Scene& s) { s.objects.pop_back(); }), boxes);
    EXPECT_EQ(sceneChange([](Scene& s) { s.lights[0].position.w = 0; }), boxes);
    EXPECT_EQ(sceneChange([](Scene& s) { s.lights[0].colour.x = 0.5f; }), boxes);
    EXPECT_EQ(sceneChange([](Scene& s) { s.ambient += 0.1f; }), boxes);
    EXPECT_EQ(sceneChange([](Scene& s) { s.background.z += 0.1f; }), boxes);
    EXPECT_EQ(sceneChange([](Scene& s) { s.dropped.flat.push_back({}); }), boxes);
}

TEST(ContentKeys, ChangeWithTheCameraOfTheirFrameOnly) {
    EXPECT_EQ(changedBy([](MatrixRequest& r, RunMaker&) { r.scenes[0].frames[30].eye.x += 0.1f; }),
              idsWith("/boxes/48x32/30 "));
    EXPECT_EQ(changedBy([](MatrixRequest& r, RunMaker&) { r.scenes[0].frames[30].nearPlane *= 2; }),
              idsWith("/boxes/48x32/30 "));
    EXPECT_TRUE(
        changedBy([](MatrixRequest& r, RunMaker&) { r.scenes[0].frames[31].fovDegrees = 20; }).empty());
}

TEST(ContentKeys, ChangeWithAFactOfTheChipAndItsSource) {
    EXPECT_EQ(changedBy([](MatrixRequest& r, RunMaker&) { r.profiles[0].facts[0].value += "x"; }),
              idsWith("voodoo2/"));
    EXPECT_EQ(changedBy([](MatrixRequest& r, RunMaker&) { r.profiles[0].facts.back().source += "x"; }),
              idsWith("voodoo2/"));
}

TEST(ContentKeys, ChangeWithTheMethodAndHowItIsDrawn) {
    EXPECT_EQ(changedBy([](MatrixRequest& r, RunMaker&) { r.methods[0].offset = 0.1f; }),
              idsWith("/carmack/"));
    EXPECT_EQ(changedBy([](MatrixRequest& r, RunMaker&) { r.methods[0].shade = Shade::Black; }),
              idsWith("/carmack/"));
    EXPECT_EQ(changedBy([](MatrixRequest& r, RunMaker&) { r.fidelities[1].dithers = true; }),
              idsWith(" chip"));
    EXPECT_EQ(changedBy([](MatrixRequest& r, RunMaker&) { r.effects = Effects::none(); }), idsWith(""));
    EXPECT_EQ(changedBy([](MatrixRequest& r, RunMaker&) { r.sizes[0].width = 49; }), idsWith(""));
}

// So that a run takes from another what both have.
TEST(ContentKeys, DoNotDependOnTheRestOfTheRun) {
    MatrixRequest few = smallRequest();
    few.profiles.erase(few.profiles.begin());
    few.scenes.erase(few.scenes.begin());
    few.methods.erase(few.methods.begin());
    const auto all = keysOf(smallRequest());
    const std::set<std::uint64_t> known(all.begin(), all.end());
    for (const std::uint64_t key : keysOf(few)) EXPECT_TRUE(known.contains(key));
}

}  // namespace content_keys_test
}  // namespace gnomon
