#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gnomon {

enum class Bar { AtMost, AtLeast, None };

/// What one round of a row gave.
struct Measured {
    double figure = 0;            ///< what is held to the bar
    double ours = 0, beside = 0;  ///< its two sides, where SpeedRow::sides names their unit
};

/// Measures once: both sides of a ratio, in turn, so that they share the machine's moods.
using Round = std::function<Measured()>;

/// How much a round does: Smoke is there to see that it runs, and its figures say nothing.
enum class Load { Full, Smoke };

/// One figure that is held to a bar: a row of the table.
struct SpeedRow {
    std::string name{};  ///< of the benchmark: "Layer/StateCall"
    std::string what{};  ///< for people: "the layer's part of a state call"
    Bar bar = Bar::AtMost;
    double target = 0;
    std::string unit{};   ///< of target and figure: "x", "ns", "%", "M/s"
    std::string sides{};  ///< unit of Measured::ours and beside: "ms"; empty: they aren't printed
    /// Builds what the rounds share; each row is prepared once, and its first round is not counted.
    std::function<Round(Load)> prepare{};
};

// The subjects, one file each; main.cpp runs their rows in this order.
std::vector<SpeedRow> maskPassRows();
std::vector<SpeedRow> halfRows();
std::vector<SpeedRow> vertexBufferRows();
std::vector<SpeedRow> layerRows();
std::vector<SpeedRow> workerRows();
std::vector<SpeedRow> truthRows();
std::vector<SpeedRow> judgeRows();

}  // namespace gnomon
