#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "profile/frame_channel.h"

namespace gnomon::nv2a {

// The blend results that were recorded on an Xbox (nv2a.md), row by row.

inline const std::filesystem::path kRecordings = std::filesystem::path(GNOMON_SHARED) / "data/nv2a_blend.csv";

inline const std::map<std::string, BlendFactor> kFactors{{"0", BlendFactor::Zero},
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

inline const std::map<std::string, BlendOperation> kOperations{
    {"ADD", BlendOperation::Add},
    {"SUB", BlendOperation::Subtract},
    {"REVSUB", BlendOperation::ReverseSubtract},
    {"MIN", BlendOperation::Min},
    {"MAX", BlendOperation::Max},
    {"SADD", BlendOperation::SignedAdd},
    {"SREVSUB", BlendOperation::SignedReverseSubtract}};

/// The colour format of a surface: X bits hold nothing that a blend could read.
inline const std::map<std::string, ColourFormat> kFormats{
    {"A8R8G8B8", {"8888", 8, 8, 8, 8}},        {"X8R8G8B8_Z", {"888", 8, 8, 8, 0}},
    {"X8R8G8B8_O", {"888", 8, 8, 8, 0}},       {"X1A7R8G8B8_Z", {"1-7-888", 8, 8, 8, 7}},
    {"X1A7R8G8B8_O", {"1-7-888", 8, 8, 8, 7}}, {"R5G6B5", {"565", 5, 6, 5, 0}},
    {"X1R5G5B5_Z", {"555", 5, 5, 5, 0}},       {"X1R5G5B5_O", {"555", 5, 5, 5, 0}}};

inline std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream in(line + ",");
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    return fields;
}

/// One recorded result; a channel that isn't shown is -1.
struct Row {
    std::string line{};
    ColourFormat format{};
    BlendState state{};
    Rgba source{}, destination{}, result{};  ///< 8 bits; of formats with fewer, replicated
};

/// All rows; empty if the file isn't there.
inline std::vector<Row> recordings() {
    std::ifstream in(kRecordings);
    std::string line;
    std::getline(in, line);
    std::map<std::string, std::size_t> column;
    for (const std::string& name : fieldsOf(line)) column.emplace(name, column.size());
    std::vector<Row> rows;
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
        rows.push_back({line,
                        kFormats.at(fields[column.at("format")]),
                        {kFactors.at(fields[column.at("sfactor")]), kFactors.at(fields[column.at("dfactor")]),
                         kOperations.at(fields[column.at("equation")]), pixel("const")},
                        pixel("src"),
                        pixel("dst"),
                        pixel("out")});
    }
    return rows;
}

}  // namespace gnomon::nv2a
