// The Xbox's blend unit against 39,962 results that were recorded on a console (nv2a.md).

#include <gtest/gtest.h>

#include "nv2a_recordings.h"

namespace gnomon {
namespace nv2a_test {

TEST(Nv2a, MakesEveryRecordedResult) {
    const auto rows = nv2a::recordings();
    if (rows.empty()) GTEST_SKIP() << nv2a::kRecordings << " is not there";
    int values = 0, wrong = 0;
    std::string first;
    for (const nv2a::Row& row : rows) {
        const ColourFormat& format = row.format;
        const std::array bits{format.red, format.green, format.blue, format.alpha};
        // The table shows fields of fewer bits replicated.
        Rgba codes{};
        for (std::size_t c = 0; c < 4; ++c) codes[c] = bits[c] ? truncated(row.destination[c], bits[c]) : 0;
        const auto result =
            blendInto({.unit = BlendUnit::Nv2a, .format = format}, row.state, row.source, codes);
        ASSERT_TRUE(result.has_value()) << row.line;
        for (std::size_t c = 0; c < 4; ++c) {
            if (row.result[c] < 0 || bits[c] == 0) continue;
            ++values;
            if (replicated((*result)[c], bits[c]) == row.result[c]) continue;
            if (wrong++ == 0) first = row.line;
        }
    }
    EXPECT_EQ(wrong, 0) << "of " << values << ", first: " << first;
    EXPECT_EQ(rows.size(), 39'962u);
    EXPECT_GT(values, 80'000);
    RecordProperty("values", values);
}

// All products, against rounding half up in whole numbers; 255 is odd, so that no tie exists.
TEST(Nv2a, RoundsOnce) {
    for (int t = 0; t <= 130'050; ++t) {
        const int s = std::min(t / 255, 255), rest = t - s * 255;
        if (rest > 65'025) continue;
        const int g = std::min(rest, 255), d = rest / 255 == 0 ? 1 : rest / 255;
        if (d * g != rest && rest > 255) continue;
        const int sum = s * 255 + d * g;
        const auto value = blend(BlendUnit::Nv2a, {s, d, Weight::of(255), Weight::of(g)});
        EXPECT_EQ(value, std::min((sum + 127) / 255, 255));
    }
}

// nv2a.md, surface formats: white over white computes 248 (252) and stores the largest code again.
TEST(Nv2a, KeepsWhiteIn565) {
    const FrameState frame{.unit = BlendUnit::Nv2a, .format = {"565", 5, 6, 5, 0}};
    for (int alpha = 0; alpha <= 255; ++alpha) {
        const BlendState fading{BlendFactor::SrcAlpha, BlendFactor::OneMinusSrcAlpha};
        EXPECT_EQ(blendInto(frame, fading, {255, 255, 255, alpha}, {31, 63, 31, 0}), (Rgba{31, 63, 31, 0}));
    }
}

}  // namespace nv2a_test
}  // namespace gnomon
