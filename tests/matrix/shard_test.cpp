// Which cells a shard draws: all shards together have each once, whoever asks gets the same, and what took
// long before is shared out.

#include "matrix/shard.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

#include "matrix/cell_list.h"
#include "scenes.h"

namespace gnomon {
namespace shard_test {

using testing::IsEmpty;

/// A request that nothing is drawn of: scenes of @p frames frames without anything in them.
MatrixRequest requestOf(const std::vector<int>& frames, int profiles, int methods) {
    MatrixRequest request;
    for (std::size_t s = 0; s < frames.size(); ++s) {
        Scene scene;
        scene.id = fmt::format("scene{}", s);
        scene.frames.resize(std::size_t(frames[s]));
        request.scenes.push_back(scene);
    }
    for (int p = 0; p < profiles; ++p) {
        Profile profile;
        profile.id = fmt::format("chip{}", p);
        request.profiles.push_back(profile);
    }
    for (int m = 0; m < methods; ++m) request.methods.push_back(namedMethods()[std::size_t(m)].axes);
    request.sizes = {{320, 240}};
    request.frames.resize(60);
    std::iota(request.frames.begin(), request.frames.end(), 0);
    return request;
}

/// The shard of each cell; each cell must be in one.
std::vector<int> shardsOf(const CellList& list, int count, const PastCosts& past = {}) {
    std::vector<int> shards(list.count(), 0);
    for (int index = 1; index <= count; ++index) {
        std::size_t before = 0;
        bool isFirst = true;
        for (const std::size_t place : placesOf(list, {index, count}, past)) {
            EXPECT_TRUE(isFirst || place > before) << "ascending";
            EXPECT_EQ(shards[place], 0) << "in two shards: " << place;
            shards[place] = index;
            before = place, isFirst = false;
        }
    }
    EXPECT_EQ(std::count(shards.begin(), shards.end(), 0), 0) << count << " shards";
    return shards;
}

TEST(Shards, AreDisjointAndComplete) {
    std::mt19937 random(7);
    const auto from = [&](int least, int most) { return std::uniform_int_distribution(least, most)(random); };
    for (int i = 0; i < 100; ++i) {
        std::vector<int> frames(std::size_t(from(1, 3)));
        for (int& f : frames) f = from(1, 7);
        const MatrixRequest request = requestOf(frames, from(1, 9), from(1, 4));
        shardsOf(CellList(request), from(1, 12));
    }
}

TEST(Shards, OneIsAll) {
    const MatrixRequest request = requestOf({3}, 2, 2);
    const auto places = placesOf(CellList(request), {});
    ASSERT_EQ(places.size(), 12u);
    EXPECT_EQ(places.back(), 11u);
}

TEST(Shards, AreEmptyWhereThereIsNothingLeftForThem) {
    const MatrixRequest request = requestOf({1}, 2, 3);
    EXPECT_THAT(placesOf(CellList(request), {3, 5}), IsEmpty());
}

TEST(Shards, AreAlikeWithoutAPast) {
    const MatrixRequest request = requestOf({12, 12}, 5, 3);
    const auto shards = shardsOf(CellList(request), 4);
    for (int index = 1; index <= 4; ++index)
        EXPECT_EQ(std::count(shards.begin(), shards.end(), index), 24 * 15 / 4) << index;
}

// A frame's truth is found once for all of its cells that one worker draws.
TEST(Shards, LeaveFramesWholeWhereThereAreMany) {
    const MatrixRequest request = requestOf({40}, 3, 2);
    const CellList list(request);
    const auto shards = shardsOf(list, 10);
    for (std::size_t place = 0; place < list.count(); ++place)
        EXPECT_EQ(shards[place], shards[place / list.perGroup() * list.perGroup()]);
}

/// Seconds of each shard, by @p past.
std::vector<double> loadsOf(const CellList& list, int count, const PastCosts& past) {
    std::vector<double> loads(static_cast<std::size_t>(count));
    const auto shards = shardsOf(list, count, past);
    for (std::size_t place = 0; place < list.count(); ++place) {
        const CellGroup& group = list.groupOf(place);
        const std::string& profile = list.choiceOf(place).profile.id;
        const double seconds =
            past.at({group.scene->id, group.size.width, group.size.height, group.frame, profile});
        loads[std::size_t(shards[place] - 1)] += seconds / double(list.request().methods.size());
    }
    return loads;
}

PastCosts randomPast(const CellList& list) {
    std::mt19937 random(11);
    PastCosts past;
    for (const CellGroup& group : list.groups())
        for (const Profile& profile : list.request().profiles)
            past[{group.scene->id, group.size.width, group.size.height, group.frame, profile.id}] =
                std::exponential_distribution(0.1)(random);
    return past;
}

// Graham 1969: the longest first is at most 4/3 - 1/(3 m) of the best, which is no less than the mean.
TEST(Shards, AreBalancedByPastCost) {
    const MatrixRequest request = requestOf({30, 30}, 4, 2);
    const CellList list(request);
    const PastCosts past = randomPast(list);
    for (const int count : {2, 3, 4, 7}) {
        const auto loads = loadsOf(list, count, past);
        const double mean = std::accumulate(loads.begin(), loads.end(), 0.0) / count;
        EXPECT_LE(*std::max_element(loads.begin(), loads.end()), mean * (4.0 / 3 - 1.0 / (3 * count)));
    }
}

TEST(Shards, AreOtherOnesByAnotherPast) {
    const MatrixRequest request = requestOf({30, 30}, 4, 2);
    const CellList list(request);
    EXPECT_NE(shardsOf(list, 3, randomPast(list)), shardsOf(list, 3));
}

// What was never drawn costs what its scene costs on the mean.
TEST(Shards, GuessWhatThePastDoesNotKnow) {
    const MatrixRequest request = requestOf({20, 20}, 1, 1);
    const CellList list(request);
    PastCosts past;
    past[{"scene0", 320, 240, 0, "chip0"}] = 10;
    past[{"scene1", 320, 240, 0, "chip0"}] = 1;
    const auto shards = shardsOf(list, 2, past);
    std::vector<int> expensive(2), cheap(2);
    for (std::size_t place = 0; place < 40; ++place)
        ++(place < 20 ? expensive : cheap)[std::size_t(shards[place] - 1)];
    EXPECT_EQ(expensive[0], 10);
    EXPECT_EQ(cheap[0], 10);
}

}  // namespace shard_test
}  // namespace gnomon
