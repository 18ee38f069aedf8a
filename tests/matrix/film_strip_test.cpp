// The buffers after every pass.

#include "matrix/film_strip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"

namespace gnomon {
namespace film_strip_test {

constexpr int kWidth = 40, kHeight = 30;

/// The strip of @p id on @p profile, and the picture at the end.
struct Strip {
    Plan plan{};
    std::vector<StripPicture> pictures{};
    Pictures end{};
};

Strip stripOf(const std::string& id, const Profile& profile, std::size_t mostVolumes = 1000) {
    Lab lab(shippedScene("boxes"));
    Strip strip{.plan = drawnPlan(lab, profile, method(id), kWidth, kHeight, 0)};
    lab.run(profile, method(id), kWidth, kHeight, 0, &strip.end,
            stripReader(stripPasses(strip.plan, mostVolumes), maskBufferOf(strip.plan),
                        [&](StripPicture picture) { strip.pictures.push_back(std::move(picture)); }));
    return strip;
}

TEST(FilmStrip, HasEveryPassAndEndsWithTheImage) {
    for (const char* id : {"carmack", "roettger-alpha", "roettger-screen", "roettger-half", "none"}) {
        const Strip strip = stripOf(id, chip("ideal"));
        ASSERT_EQ(strip.pictures.size(), strip.plan.passes.size()) << id;
        for (std::size_t i = 0; i < strip.pictures.size(); ++i) EXPECT_EQ(strip.pictures[i].pass, i) << id;
        EXPECT_EQ(strip.pictures.back().colour, strip.end.image) << id;
    }
}

TEST(FilmStrip, ShowsTheMaskWhereItStands) {
    for (const auto& [id, buffer] : {std::pair("carmack", MaskBuffer::Stencil),
                                     {"roettger-alpha", MaskBuffer::Alpha},
                                     {"roettger-screen", MaskBuffer::None},
                                     {"none", MaskBuffer::None}}) {
        const Strip strip = stripOf(id, chip("ideal"));
        EXPECT_EQ(maskBufferOf(strip.plan), buffer) << id;
        for (const StripPicture& picture : strip.pictures)
            EXPECT_EQ(picture.mask.data.size(),
                      buffer == MaskBuffer::None ? 0u : std::size_t(kWidth) * kHeight)
                << id;
    }
}

// Carmack's count is 0 where the mask is lit, and not 0 in shadow, once all volumes are drawn.
TEST(FilmStrip, HoldsTheCountsThemselves) {
    const Strip strip = stripOf("carmack", chip("ideal"));
    const std::size_t after = strip.plan.masks.front().after;
    const Image& counts = strip.pictures[after - 1].mask;
    for (std::size_t i = 0; i < counts.data.size(); ++i)
        ASSERT_EQ(counts.data[i] != 0, bool(strip.end.masks[0][i])) << i;
}

TEST(FilmStrip, LeavesOutVolumesBeyondThoseAskedFor) {
    const Strip strip = stripOf("roettger-screen", chip("ideal"), 2);
    std::size_t volumes = 0, others = 0;
    for (const StripPicture& picture : strip.pictures)
        ++(strip.plan.passes[picture.pass].kind == PassKind::Volume ? volumes : others);
    EXPECT_EQ(volumes, 2u);
    const auto counts = countPasses(strip.plan);
    EXPECT_GT(counts.volume, 2);
    EXPECT_EQ(others, strip.plan.passes.size() - std::size_t(counts.volume));
}

TEST(FilmStrip, IsOfThePlanThatTheLabDraws) {
    Lab lab(shippedScene("boxes"));
    const Plan full = drawnPlan(lab, chip("ideal"), method("carmack"), kWidth, kHeight, 0);
    lab.simulate(Effects::none());
    const Plan least = drawnPlan(lab, chip("ideal"), method("carmack"), kWidth, kHeight, 0);
    EXPECT_TRUE(full.windows.empty());
    EXPECT_FALSE(least.windows.empty());
}

}  // namespace film_strip_test
}  // namespace gnomon
