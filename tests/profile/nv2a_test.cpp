// The Xbox's blend unit against 39,962 results that were recorded on a console (nv2a.md).

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "profile/frame_channel.h"

namespace gnomon {
namespace {

const std::filesystem::path kRecordings = std::filesystem::path(GNOMON_SHARED) / "data/nv2a_blend.csv";

const std::map<std::string, BlendFactor> kFactors{{"0", BlendFactor::Zero},
                                                  {"1", BlendFactor::One},
                                                  {"srcRGB", BlendFactor::SrcColor},
                                                  {"1-srcRGB", BlendFactor::OneMinusSrcColor},
                                                  {"dstRGB", BlendFactor::DstColor},
                                                  {"1-dstRGB", BlendFactor::OneMinusDstColor},
                                                  {"srcA", BlendFactor::SrcAlpha},
                                                  {"1-srcA", BlendFactor::OneMinusSrcAlpha},
                                                  {"dstA", BlendFactor::DstAlpha},
                                                  {"1-dstA", BlendFactor::OneMinusDstAlpha},
                                                  {"srcAsat", BlendFactor::SrcAlphaSaturate},
                                                  {"cRGB", BlendFactor::ConstantColor},
                                                  {"1-cRGB", BlendFactor::OneMinusConstantColor},
                                                  {"cA", BlendFactor::ConstantAlpha},
                                                  {"1-cA", BlendFactor::OneMinusConstantAlpha}};

const std::map<std::string, BlendOperation> kOperations{{"ADD", BlendOperation::Add},
                                                        {"SUB", BlendOperation::Subtract},
                                                        {"REVSUB", BlendOperation::ReverseSubtract},
                                                        {"MIN", BlendOperation::Min},
                                                        {"MAX", BlendOperation::Max},
                                                        {"SADD", BlendOperation::SignedAdd},
                                                        {"SREVSUB", BlendOperation::SignedReverseSubtract}};

/// The colour format of a surface: X bits hold nothing that a blend could read.
const std::map<std::string, ColourFormat> kFormats{
    {"A8R8G8B8", {"8888", 8, 8, 8, 8}},        {"X8R8G8B8_Z", {"888", 8, 8, 8, 0}},
    {"X8R8G8B8_O", {"888", 8, 8, 8, 0}},       {"X1A7R8G8B8_Z", {"1-7-888", 8, 8, 8, 7}},
    {"X1A7R8G8B8_O", {"1-7-888", 8, 8, 8, 7}}, {"R5G6B5", {"565", 5, 6, 5, 0}},
    {"X1R5G5B5_Z", {"555", 5, 5, 5, 0}},       {"X1R5G5B5_O", {"555", 5, 5, 5, 0}}};

std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream in(line + ",");
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    return fields;
}

TEST(Nv2a, MakesEveryRecordedResult) {
    std::ifstream in(kRecordings);
    if (!in) GTEST_SKIP() << kRecordings << " is not there";
    std::string line;
    std::getline(in, line);
    std::map<std::string, std::size_t> column;
    for (const std::string& name : fieldsOf(line)) column.emplace(name, column.size());

    int rows = 0, values = 0, wrong = 0;
    std::string first;
    while (std::getline(in, line)) {
        const auto fields = fieldsOf(line);
        const auto pixel = [&](const std::string& prefix) {
            Rgba value{};
            for (std::size_t c = 0; c < 4; ++c) {
                const std::string& field = fields[column.at(prefix + std::array{"_r", "_g", "_b", "_a"}[c])];
                value[c] = field.empty() ? -1 : std::stoi(field);
            }
            return value;
        };
        const ColourFormat& format = kFormats.at(fields[column.at("format")]);
        const std::array bits{format.red, format.green, format.blue, format.alpha};
        const BlendState state{kFactors.at(fields[column.at("sfactor")]),
                               kFactors.at(fields[column.at("dfactor")]),
                               kOperations.at(fields[column.at("equation")]), pixel("const")};
        // The table shows fields of fewer bits replicated.
        Rgba codes{};
        const Rgba destination = pixel("dst"), expected = pixel("out");
        for (std::size_t c = 0; c < 4; ++c) codes[c] = bits[c] ? truncated(destination[c], bits[c]) : 0;
        const auto result =
            blendInto({.unit = BlendUnit::Nv2a, .format = format}, state, pixel("src"), codes);
        ASSERT_TRUE(result.has_value()) << line;
        ++rows;
        for (std::size_t c = 0; c < 4; ++c) {
            if (expected[c] < 0 || bits[c] == 0) continue;
            ++values;
            if (replicated((*result)[c], bits[c]) == expected[c]) continue;
            if (wrong++ == 0) first = line;
        }
    }
    EXPECT_EQ(wrong, 0) << "of " << values << ", first: " << first;
    EXPECT_EQ(rows, 39'962);
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

}  // namespace
}  // namespace gnomon
